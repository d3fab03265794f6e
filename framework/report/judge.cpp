#include "framework/report/judge.h"

#include <algorithm>
#include <map>

namespace dvrlab {
namespace {

std::string text_of(double x) {
  const nlohmann::json n = json_number(x);
  return n.is_string() ? n.get<std::string>() : n.dump();
}

void conclude(CaseRecord& r, const Expectation& e, std::optional<double> value, Verdict verdict,
              const std::string& reason) {
  r.expectations.push_back({e.text, value, verdict, reason});
  if (verdict == Verdict::fail) r.judge(Verdict::fail, "expected " + e.text + "; " + reason);
}

std::string why_no_value(const CaseRecord& r, const Expectation& e) {
  if (!r.ran) return "the case has no image: " + (r.reason.empty() ? "it did not run" : r.reason);
  return "'" + e.metric + "' was not measured against " + e.against;
}

void judge_bound(CaseRecord& r, const Expectation& e) {
  const std::optional<double> value = r.value(e.metric, e.against);
  if (!value) return conclude(r, e, value, Verdict::not_supported, why_no_value(r, e));
  const bool good =
      (!e.at_least || *value >= *e.at_least) && (!e.at_most || *value <= *e.at_most);  // NaN is never good
  conclude(r, e, value, good ? Verdict::pass : Verdict::fail, "found " + text_of(*value));
}

/// What must not differ between cases that are put in order: every axis but the one that orders them.
std::string group_of(const CaseRecord& r, const Expectation& e) {
  std::string group;
  for (const AxisChoice& c : r.plan->choices) {
    if (c.key != e.order_by) group += c.key + "=" + c.label + ",";
  }
  return group;
}

void judge_order(std::vector<CaseRecord*>& group, const Expectation& e) {
  std::vector<std::pair<double, CaseRecord*>> ordered;
  for (CaseRecord* r : group) {
    const nlohmann::json* by = value_at(r->plan->resolved.config, e.order_by);
    if (!r->value(e.metric, e.against)) {
      conclude(*r, e, std::nullopt, Verdict::not_supported, why_no_value(*r, e));
    } else if (by == nullptr || !by->is_number()) {
      conclude(*r, e, std::nullopt, Verdict::not_supported, "the case has no number at " + e.order_by);
    } else {
      ordered.emplace_back(by->get<double>(), r);
    }
  }
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  bool good = ordered.size() > 1;
  std::string found;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    const double value = *ordered[i].second->value(e.metric, e.against);
    found += (i == 0 ? "found " : ", ") + text_of(value) + " at " + text_of(ordered[i].first);
    if (i == 0) continue;
    const double before = *ordered[i - 1].second->value(e.metric, e.against);
    good = good && (e.increasing ? value > before : value < before);
  }
  if (ordered.size() == 1)
    return conclude(*ordered[0].second, e, std::nullopt, Verdict::not_supported,
                    "an order needs two cases, there is one");
  for (const auto& [by, r] : ordered) conclude(*r, e, std::nullopt, good ? Verdict::pass : Verdict::fail, found);
}

}  // namespace

void judge_expectations(const Experiment& experiment, std::vector<CaseRecord>& records) {
  for (const Expectation& e : experiment.expectations) {
    std::map<std::string, std::vector<CaseRecord*>> groups;
    for (CaseRecord& r : records) {
      if (!r.plan->reference_name.empty() || !applies(e, r.plan->resolved.config)) continue;
      if (e.order_by.empty()) {
        judge_bound(r, e);
      } else {
        groups[group_of(r, e)].push_back(&r);
      }
    }
    for (auto& [name, group] : groups) judge_order(group, e);
  }
}

}  // namespace dvrlab
