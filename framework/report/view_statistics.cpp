#include "framework/report/view_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "framework/config/axes.h"
#include "framework/config/views.h"

namespace dvrlab {
namespace {

bool is_place(const std::string& value) { return value.ends_with(".x") || value.ends_with(".y"); }

/// True if `a` is the worse of two values; NaN is the worst of all.
bool is_worse(double a, double b, bool higher) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && !std::isnan(b);
  return higher ? a < b : a > b;
}

/// The axis of the key, with all that is zipped to it; else the axes of the sections that the key lies in.
std::vector<std::size_t> axes_of(const PlannedCase& c, const std::string& key) {
  std::vector<std::size_t> axes;
  for (const AxisChoice& choice : c.choices) {
    if (choice.key == key) return {choice.axis};
    if (lies_in(key, choice.key)) axes.push_back(choice.axis);
  }
  return axes;
}

std::vector<AxisChoice> choices_without(const PlannedCase& c, const std::string& key) {
  const std::vector<std::size_t> axes = axes_of(c, key);
  std::vector<AxisChoice> others;
  for (const AxisChoice& choice : c.choices) {
    if (std::find(axes.begin(), axes.end(), choice.axis) == axes.end()) others.push_back(choice);
  }
  return others;
}

const AxisChoice* view_of(const PlannedCase& c) {
  const auto found =
      std::find_if(c.choices.begin(), c.choices.end(), [](const AxisChoice& choice) { return choice.key == view_key; });
  return found == c.choices.end() ? nullptr : &*found;
}

struct Group {
  std::vector<const CaseRecord*> records;
};

/// The values of one metric against one reference that any of the views has, in their order.
struct Values {
  std::string against, metric;
  bool higher, headline;
};

std::vector<Values> values_of(const Group& group) {
  std::vector<Values> all;
  for (const CaseRecord* r : group.records) {
    for (const Measure& m : r->measures) {
      for (std::size_t k = 0; k < m.values.size(); ++k) {
        const std::string& name = m.values[k].first;
        const bool known = std::any_of(all.begin(), all.end(),
                                       [&](const Values& v) { return v.against == m.against && v.metric == name; });
        if (!known && !is_place(name)) all.push_back({m.against, name, m.higher_is_better, k == 0});
      }
    }
  }
  return all;
}

ViewRow row_of(const Group& group, const Values& v) {
  ViewRow row;
  row.choices = choices_without(*group.records.front()->plan, view_key);
  row.against = v.against;
  row.metric = v.metric;
  row.headline = v.headline;
  row.planned = group.records.size();
  std::vector<double> values;
  std::vector<std::string> views;
  for (const CaseRecord* r : group.records) {
    const std::optional<double> value = r->value(v.metric, v.against);
    if (!value) continue;
    values.push_back(*value);
    views.push_back(view_of(*r->plan)->label);
  }
  row.views = values.size();
  row.statistic = view_statistic(values, v.higher);
  row.worst_view = views[row.statistic.worst_at];
  return row;
}

}  // namespace

ViewStatistic view_statistic(const std::vector<double>& values, bool higher) {
  const double perfect = higher ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  ViewStatistic s;
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (is_worse(values[i], values[s.worst_at], higher)) s.worst_at = i;
    if (values[i] == perfect) {
      ++s.perfect;
    } else {
      sum += values[i];
    }
  }
  s.worst = values.at(s.worst_at);
  s.mean = s.perfect == values.size() ? perfect : sum / static_cast<double>(values.size() - s.perfect);
  return s;
}

std::string group_without(const PlannedCase& c, const std::string& key) {
  std::string text;
  for (const AxisChoice& choice : choices_without(c, key)) text += choice.key + "=" + choice.label + ",";
  return text;
}

std::vector<ViewRow> view_rows(const std::vector<CaseRecord>& records) {
  std::vector<Group> groups;
  std::map<std::string, std::size_t> known;
  for (const CaseRecord& r : records) {
    if (!r.plan->reference_name.empty() || view_of(*r.plan) == nullptr) continue;
    const auto [at, is_new] = known.emplace(group_without(*r.plan, view_key), groups.size());
    if (is_new) groups.emplace_back();
    groups[at->second].records.push_back(&r);
  }
  std::vector<ViewRow> rows;
  for (const Group& group : groups) {
    for (const Values& v : values_of(group)) rows.push_back(row_of(group, v));
  }
  return rows;
}

}  // namespace dvrlab
