#include "framework/report/judge.h"

#include <algorithm>
#include <cmath>
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

/// A member of a series that has a value.
struct Point {
  double x, y;
  const Judged* judged;
};

bool in_order(const std::vector<Point>& points, bool increasing) {
  return std::adjacent_find(points.begin(), points.end(), [&](const Point& a, const Point& b) {
           return increasing ? !(b.y > a.y) : !(b.y < a.y);
         }) == points.end();
}

/// The largest distance from the line of least squares in x^power, as a part of the range of y.
double off_the_line(const std::vector<Point>& points, double power) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0, worst = 0;
  const double n = static_cast<double>(points.size());
  const auto x_of = [&](const Point& p) { return std::pow(p.x, power); };
  for (const Point& p : points) {
    sx += x_of(p) / n;
    sy += p.y / n;
  }
  for (const Point& p : points) {
    sxx += (x_of(p) - sx) * (x_of(p) - sx);
    sxy += (x_of(p) - sx) * (p.y - sy);
  }
  const double slope = sxy / sxx;
  for (const Point& p : points) worst = std::max(worst, std::abs(p.y - sy - slope * (x_of(p) - sx)));
  const auto [lo, hi] =
      std::minmax_element(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.y < b.y; });
  return worst / (hi->y - lo->y);
}

void judge_series(const std::vector<const Judged*>& group, const Expectation& e) {
  const Expectation::Series& s = e.series;
  std::vector<Point> points;
  std::string incomplete;  // why some member has no value: nothing can be said of the whole
  for (const Judged* j : group) {
    const std::optional<double> x = series_place(s, j->records.front()->plan->resolved.config);
    if (!x && !s.values.empty()) continue;  // the list says which cases are meant
    if (!j->value) {
      conclude(*j, e, std::nullopt, Verdict::not_supported, j->why_none);
      incomplete = j->why_none;
    } else if (!x) {
      conclude(*j, e, std::nullopt, Verdict::not_supported, "the case has no number at " + s.key);
    } else {
      points.push_back({*x, *j->value, j});
    }
  }
  std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
  const std::size_t least = s.affine ? 3 : 2;
  std::string found;
  for (const Point& p : points)
    found += (found.empty() ? "found " : ", ") + text_of(p.y) + " at " +
             (s.values.empty() ? text_of(p.x) : s.values[static_cast<std::size_t>(p.x)].dump());
  bool good = points.size() >= least;
  if (good && s.affine) {
    const double off = off_the_line(points, s.power);
    found += "; off the line by " + text_of(off) + " of the range";
    good = off <= s.within;  // NaN is never good
  } else if (good) {
    good = in_order(points, s.increasing);
  }
  for (const Point& p : points) {
    if (!incomplete.empty()) {
      conclude(*p.judged, e, std::nullopt, Verdict::not_supported,
               "another case of the series has no value: " + incomplete);
    } else if (points.size() < least) {
      conclude(*p.judged, e, std::nullopt, Verdict::not_supported,
               (s.affine ? "a line needs three cases, there are " : "an order needs two cases, there are ") +
                   std::to_string(points.size()));
    } else {
      conclude(*p.judged, e, std::nullopt, good ? Verdict::pass : Verdict::fail, found);
    }
  }
}

/// What must not differ between the members of a series: every axis but the one that it follows.
std::string series_group(const Judged& j, const Expectation& e) {
  PlannedCase c;
  c.choices = j.records.front()->plan->choices;
  if (e.over == Expectation::Over::views) std::erase_if(c.choices, [](const auto& x) { return x.key == view_key; });
  return group_without(c, e.series.key);
}

}  // namespace

void judge_expectations(const Experiment& experiment, std::vector<CaseRecord>& records) {
  for (const Expectation& e : experiment.expectations) {
    const std::vector<Judged> all = judged_by(e, records);
    std::map<std::string, std::vector<const Judged*>> groups;
    for (const Judged& j : all) {
      if (e.series.key.empty()) {
        judge_bound(j, e);
      } else {
        groups[series_group(j, e)].push_back(&j);
      }
    }
    for (const auto& [name, group] : groups) judge_series(group, e);
  }
}

}  // namespace dvrlab
