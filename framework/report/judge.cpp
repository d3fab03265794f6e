#include "framework/report/judge.h"

#include <algorithm>
#include <map>

#include "framework/config/views.h"
#include "framework/report/view_statistics.h"

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

/// What is held to the bound: one case, or all views that differ in nothing else.
struct Judged {
  std::vector<CaseRecord*> records;
  std::optional<double> value;
  std::string why_none;
  std::string found;  // "found 41.2", with the view
};

void conclude(const Judged& j, const Expectation& e, std::optional<double> value, Verdict verdict,
              const std::string& reason) {
  for (CaseRecord* r : j.records) conclude(*r, e, value, verdict, reason);
}

std::string why_no_value(const CaseRecord& r, const Expectation& e) {
  if (!r.ran) return "the case has no image: " + (r.reason.empty() ? "it did not run" : r.reason);
  return "'" + e.metric + "' was not measured against " + e.against;
}

Judged one_case(CaseRecord& r, const Expectation& e) {
  Judged j{{&r}, r.value(e.metric, e.against), "", ""};
  if (!j.value) j.why_none = why_no_value(r, e);
  if (j.value) j.found = "found " + text_of(*j.value);
  return j;
}

bool higher_is_better(const CaseRecord& r, const Expectation& e) {
  return std::any_of(r.measures.begin(), r.measures.end(), [&](const Measure& m) {
    return m.against == e.against && m.higher_is_better && m.metric == e.metric.substr(0, e.metric.find('.'));
  });
}

/// A view without the value leaves nothing that could be said of all of them.
Judged all_views(const std::vector<CaseRecord*>& views, const Expectation& e) {
  Judged j{views, {}, "", ""};
  std::vector<double> values;
  for (const CaseRecord* r : views) {
    const std::optional<double> value = r->value(e.metric, e.against);
    if (value) values.push_back(*value);
    if (!value && j.why_none.empty()) j.why_none = r->plan->id + ": " + why_no_value(*r, e);
  }
  if (values.size() < views.size()) {
    j.why_none = std::to_string(views.size() - values.size()) + " of " + std::to_string(views.size()) +
                 " views have no value; " + j.why_none;
    return j;
  }
  const ViewStatistic s = view_statistic(values, higher_is_better(*views.front(), e));
  const bool mean = e.take == Expectation::Take::mean;
  j.value = mean ? s.mean : s.worst;
  j.found = "found " + text_of(*j.value) + (mean ? "" : " (" + views[s.worst_at]->plan->id + ")");
  return j;
}

/// The records that the expectation means, one by one or by their views.
std::vector<Judged> judged_by(const Expectation& e, std::vector<CaseRecord>& records) {
  std::vector<Judged> all;
  std::vector<std::vector<CaseRecord*>> groups;
  std::map<std::string, std::size_t> known;
  for (CaseRecord& r : records) {
    if (!r.plan->reference_name.empty() || !applies(e, r.plan->resolved.config)) continue;
    if (e.against == "variant" && r.ran && !r.variant) continue;  // the variant that the others are compared with
    if (e.over == Expectation::Over::cases) {
      all.push_back(one_case(r, e));
      continue;
    }
    const auto [at, is_new] = known.emplace(group_without(*r.plan, view_key), groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].push_back(&r);
  }
  for (const auto& views : groups) all.push_back(all_views(views, e));
  return all;
}

void judge_bound(const Judged& j, const Expectation& e) {
  if (!j.value) return conclude(j, e, j.value, Verdict::not_supported, j.why_none);
  const bool good =
      (!e.at_least || *j.value >= *e.at_least) && (!e.at_most || *j.value <= *e.at_most);  // NaN is never good
  conclude(j, e, j.value, good ? Verdict::pass : Verdict::fail, j.found);
}

void judge_order(const std::vector<const Judged*>& group, const Expectation& e) {
  std::vector<std::pair<double, const Judged*>> ordered;
  for (const Judged* j : group) {
    const nlohmann::json* by = value_at(j->records.front()->plan->resolved.config, e.order_by);
    if (!j->value) {
      conclude(*j, e, std::nullopt, Verdict::not_supported, j->why_none);
    } else if (by == nullptr || !by->is_number()) {
      conclude(*j, e, std::nullopt, Verdict::not_supported, "the case has no number at " + e.order_by);
    } else {
      ordered.emplace_back(by->get<double>(), j);
    }
  }
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  bool good = ordered.size() > 1;
  std::string found;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    const double value = *ordered[i].second->value;
    found += (i == 0 ? "found " : ", ") + text_of(value) + " at " + text_of(ordered[i].first);
    if (i == 0) continue;
    const double before = *ordered[i - 1].second->value;
    good = good && (e.increasing ? value > before : value < before);
  }
  if (ordered.size() == 1)
    return conclude(*ordered[0].second, e, std::nullopt, Verdict::not_supported,
                    "an order needs two cases, there is one");
  for (const auto& [by, j] : ordered) conclude(*j, e, std::nullopt, good ? Verdict::pass : Verdict::fail, found);
}

/// What must not differ between those that are put in order: every axis but the one that orders them.
std::string order_group(const Judged& j, const Expectation& e) {
  PlannedCase c;
  c.choices = j.records.front()->plan->choices;
  if (e.over == Expectation::Over::views) std::erase_if(c.choices, [](const auto& x) { return x.key == view_key; });
  return group_without(c, e.order_by);
}

}  // namespace

void judge_expectations(const Experiment& experiment, std::vector<CaseRecord>& records) {
  for (const Expectation& e : experiment.expectations) {
    const std::vector<Judged> all = judged_by(e, records);
    std::map<std::string, std::vector<const Judged*>> groups;
    for (const Judged& j : all) {
      if (e.order_by.empty()) {
        judge_bound(j, e);
      } else {
        groups[order_group(j, e)].push_back(&j);
      }
    }
    for (const auto& [name, group] : groups) judge_order(group, e);
  }
}

}  // namespace dvrlab
