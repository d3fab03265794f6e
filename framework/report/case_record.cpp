#include "framework/report/case_record.h"

#include <algorithm>
#include <cmath>

namespace dvrlab {
namespace {

/// Linear between the sorted values.
double quantile(const std::vector<double>& sorted, double q) {
  const double at = q * static_cast<double>(sorted.size() - 1);
  const std::size_t below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (sorted[above] - sorted[below]) * (at - static_cast<double>(below));
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return quantile(values, 0.5);
}

}  // namespace

const char* verdict_text(Verdict v) {
  switch (v) {
    case Verdict::pass:
      return "pass";
    case Verdict::fail:
      return "fail";
    case Verdict::not_supported:
      return "not supported";
    case Verdict::error:
      return "error";
  }
  return "";
}

Verdict worse(Verdict a, Verdict b) {
  const auto rank = [](Verdict v) {
    return v == Verdict::error ? 3 : v == Verdict::fail ? 2 : v == Verdict::not_supported ? 1 : 0;
  };
  return rank(a) >= rank(b) ? a : b;
}

std::vector<PhaseStatistics> phase_statistics(const std::vector<std::vector<PhaseTime>>& repeats) {
  std::vector<std::string> phases;
  for (const auto& repeat : repeats) {
    for (const PhaseTime& t : repeat) {
      if (std::find(phases.begin(), phases.end(), t.phase) == phases.end()) phases.push_back(t.phase);
    }
  }
  std::vector<PhaseStatistics> statistics;
  for (const std::string& phase : phases) {
    std::vector<double> wall, cpu;
    for (const auto& repeat : repeats) {
      for (const PhaseTime& t : repeat) {
        if (t.phase != phase) continue;
        wall.push_back(t.seconds);
        cpu.push_back(t.cpu_seconds);
      }
    }
    std::sort(wall.begin(), wall.end());
    const bool measured = std::all_of(cpu.begin(), cpu.end(), [](double s) { return s >= 0; });
    statistics.push_back(
        {phase, quantile(wall, 0.5), quantile(wall, 0.75) - quantile(wall, 0.25), measured ? median(cpu) : -1.0});
  }
  return statistics;
}

void CaseRecord::judge(Verdict v, const std::string& why) {
  if (worse(verdict, v) == verdict) return;
  verdict = v;
  reason = why.substr(0, why.find_last_not_of(" \n") + 1);
}

std::optional<double> CaseRecord::seconds(const std::string& phase) const {
  for (const PhaseStatistics& t : times) {
    if (t.phase == phase) return t.median;
  }
  return std::nullopt;
}

std::optional<double> CaseRecord::value(const std::string& metric, const std::string& against) const {
  for (const Measure& m : measures) {
    if (m.against != against) continue;
    for (const auto& [name, x] : m.values) {
      if (name == metric) return x;
    }
  }
  return std::nullopt;
}

nlohmann::json json_number(double x) {
  if (std::isfinite(x)) return x;
  return std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf";
}

}  // namespace dvrlab
