// Everything that is known about one case once it is through: what case.json and results.csv are written from.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/experiment.h"
#include "framework/interfaces/backend.h"

namespace dvrlab {

enum class Verdict { pass, fail, not_supported, error };
const char* verdict_text(Verdict v);
/// The one that counts when both are true of a case: error, fail, not supported, pass.
Verdict worse(Verdict a, Verdict b);

/// Wall time of a phase over the repeats, in seconds. `cpu_median` < 0: not measured.
struct PhaseStatistics {
  std::string phase;
  double median, interquartile_range, cpu_median;
};

/// Phases in the order of their first appearance.
std::vector<PhaseStatistics> phase_statistics(const std::vector<std::vector<PhaseTime>>& repeats);

struct Measure {
  std::string against, metric;
  std::vector<std::pair<std::string, double>> values;
  bool higher_is_better = false;
};

/// The bit-for-bit comparison with the first variant that has an image.
struct VariantCheck {
  std::string first;  // id of that case
  double max_abs = 0;
  std::uint64_t different = 0;  // floats whose bits differ
};

struct ExpectationResult {
  std::string text;             // "psnr against truth >= 40"
  std::optional<double> value;  // nothing for an order
  Verdict verdict;
  std::string reason;
};

struct CaseRecord {
  const PlannedCase* plan = nullptr;
  bool ran = false;  // has an image
  Verdict verdict = Verdict::pass;
  std::string reason;

  nlohmann::json scene = nlohmann::json::object();
  DeviceInfo device;
  std::vector<std::pair<std::string, double>> memory;  // part -> bytes, as stated before they were allocated
  FrameCounters counters;
  std::vector<PhaseStatistics> times;
  std::vector<Measure> measures;
  std::optional<VariantCheck> variant;
  std::vector<ExpectationResult> expectations;

  /// Lowers the verdict and keeps the first reason for it.
  void judge(Verdict v, const std::string& why);
  /// Median of a phase in seconds, nothing when it was not timed.
  std::optional<double> seconds(const std::string& phase) const;
  /// A metric's value, nothing when it was not measured.
  std::optional<double> value(const std::string& metric, const std::string& against) const;
};

/// The seven sections of case.json, in the order of the stages.
nlohmann::ordered_json case_json(const CaseRecord& record);

/// A number as JSON; what JSON cannot say becomes the text "inf", "-inf" or "nan".
nlohmann::json json_number(double x);

}  // namespace dvrlab
