#include <algorithm>

#include "framework/config/check_value.h"
#include "framework/config/experiment.h"
#include "framework/config/views.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

constexpr std::size_t most_values = 10;  // that a message lists

void name_in(const char* what, const std::string& name, const std::vector<std::string>& legal, const std::string& where,
             Problems& problems) {
  if (std::find(legal.begin(), legal.end(), name) != legal.end()) return;
  problems.add(where + "there is no " + what + " '" + name + "'" + did_you_mean(name, legal) +
               (legal.empty() ? "; there is none" : "; there are: " + join_words(legal)));
}

/// The deepest section of the config that the path leads to, and the keys in it.
void add_unknown_key(const nlohmann::json& config, const std::string& path, const std::string& where,
                     Problems& problems) {
  const nlohmann::json* section = &config;
  std::string missing;
  for (const std::string& step : split_path(path)) {
    missing = step;
    const nlohmann::json* next = value_at(*section, step);
    if (next == nullptr) break;
    section = next;
  }
  std::vector<std::string> legal;
  if (section->is_object()) {
    for (const auto& [key, value] : section->items()) legal.push_back(key);
  }
  problems.add(where + ": no case has this key: '" + missing + "'" + did_you_mean(missing, legal) +
               (legal.empty() ? "" : "; there are: " + join_words(legal)));
}

/// True when every key of `where` is in some case, and its value too. The other keys are said.
bool check_where(const Experiment& experiment, const Expectation& e, const ConfigTree& tree, const std::string& path,
                 Problems& problems) {
  bool good = true;
  for (const auto& [key, wanted] : e.where) {
    const std::string where = tree.where_key(child_path(path, key));
    std::vector<nlohmann::json> values;
    const nlohmann::json* config = nullptr;
    for (const PlannedCase& c : experiment.cases) {
      if (!c.reference_name.empty()) continue;
      config = &c.resolved.config;
      const nlohmann::json* found = value_at(*config, key);
      if (found != nullptr && std::find(values.begin(), values.end(), *found) == values.end()) values.push_back(*found);
    }
    if (std::find(values.begin(), values.end(), wanted) != values.end()) continue;
    good = false;
    if (values.empty()) {
      if (config != nullptr) add_unknown_key(*config, key, where, problems);
      continue;
    }
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < std::min(values.size(), most_values); ++i) texts.push_back(short_text(values[i]));
    if (values.size() > most_values) texts.emplace_back("...");
    problems.add(where + ": found " + short_text(wanted) + ", which no case has; the values are " + join_words(texts));
  }
  return good;
}

/// What an expectation may name.
struct Names {
  std::vector<std::string> metrics, references;
  bool known = true;  // every metric is one
};

Names names_of(const PlannedCase& c) {
  Names names;
  for (const Section& m : c.resolved.metrics) {
    names.metrics.push_back(m.type);
    names.known = names.known && m.plugin != nullptr;
  }
  for (const auto& [name, index] : c.references) names.references.push_back(name);
  return names;
}

std::string metric_of(const Expectation& e) { return e.metric.substr(0, e.metric.find('.')); }

void check_one(const Experiment& experiment, const Expectation& e, const std::string& where, Problems& problems) {
  Names names;
  bool applied = false, ordered = false, viewed = false, varied = false;
  for (std::size_t k = 0; k < experiment.cases.size(); ++k) {
    const PlannedCase& c = experiment.cases[k];
    if (!c.reference_name.empty() || !applies(e, c.resolved.config)) continue;
    if (!applied) names = names_of(c);
    applied = true;
    varied = varied || c.first_variant != k;
    viewed = viewed || std::any_of(c.choices.begin(), c.choices.end(),
                                   [](const AxisChoice& choice) { return choice.key == view_key; });
    ordered = ordered || (!e.series.key.empty() && series_place(e.series, c.resolved.config));
  }
  for (const nlohmann::json& value : e.series.values) {
    const bool found = std::any_of(experiment.cases.begin(), experiment.cases.end(), [&](const PlannedCase& c) {
      const nlohmann::json* at = value_at(c.resolved.config, e.series.key);
      return c.reference_name.empty() && applies(e, c.resolved.config) && at != nullptr && *at == value;
    });
    if (!found && applied)
      problems.add(where + "no case that is meant has " + short_text(value) + " at '" + e.series.key + "'");
  }
  if (!applied) {
    problems.add(where + "no case is meant: none has all the values of `where`");
    return;
  }
  if (varied) names.references.emplace_back("variant");
  if (e.against == own_reference) {
    name_in("value of the case's own", e.metric, own_values(), where, problems);
  } else {
    name_in("metric", metric_of(e), names.metrics, where, problems);
    name_in("reference", e.against, names.references, where, problems);
  }
  if (e.over == Expectation::Over::views && !viewed)
    problems.add(where + "there are no views: the camera of no case that is meant is an orbit whose view is null");
  if (e.over == Expectation::Over::views && e.series.key == view_key)
    problems.add(where + "one value of all views cannot be put in order by camera.view; set `over` to \"cases\"");
  if (!e.series.key.empty() && !ordered)
    problems.add(where + "the key '" + e.series.key + "' " +
                 (e.series.values.empty() ? "is no number" : "has none of the values") + " in any case that is meant");
}

}  // namespace

void check_expectations(const Experiment& experiment, const ConfigTree& tree, bool sound, Problems& problems) {
  for (std::size_t i = 0; i < experiment.expectations.size(); ++i) {
    const Expectation& e = experiment.expectations[i];
    if (e.text.empty()) continue;  // what is wrong with it has been said
    const std::string path = child_path("expect", i), where = tree.where(path) + ": ";
    if (sound) {
      if (check_where(experiment, e, tree, path + ".where", problems)) check_one(experiment, e, where, problems);
    } else if (!experiment.cases.empty()) {
      const Names names = names_of(experiment.cases.back());
      if (names.known) name_in("metric", metric_of(e), names.metrics, where, problems);
    }
  }
}

}  // namespace dvrlab
