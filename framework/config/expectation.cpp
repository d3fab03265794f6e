#include "framework/config/expectation.h"

#include <algorithm>

#include "framework/config/check_value.h"
#include "framework/config/resolve.h"

namespace dvrlab {
namespace {

std::string number_text(double x) { return nlohmann::json(x).dump(); }

Expectation::Series read_series(const nlohmann::json& j, bool affine) {
  Expectation::Series s;
  s.key = j.at("by").get<std::string>();
  s.affine = affine;
  if (affine) {
    s.power = j.value("power", 1.0);
    s.within = j.at("within").get<double>();
  } else {
    s.increasing = j.at("is") == "increasing";
    s.values = j.value("values", std::vector<nlohmann::json>{});
  }
  return s;
}

std::string series_text(const Expectation::Series& s) {
  if (!s.affine) return std::string(s.increasing ? " increasing" : " decreasing") + " with " + s.key;
  return " affine in " + s.key + (s.power == 1 ? "" : "^" + number_text(s.power)) + " to " + number_text(s.within) +
         " of its range";
}

Expectation read_one(const ConfigTree& tree, const std::string& path, Problems& problems) {
  const SectionType& type = *find_section_type("expect", "");
  nlohmann::json unused;
  Problems mine;
  const ParameterSet p = resolve_keys(tree, path, {type.keys, type.shapes, {}}, mine, unused);
  Expectation e;
  problems.add(mine);
  if (!mine.empty()) return e;
  e.metric = p.text("metric");
  e.against = p.text("against");
  for (const auto& [key, value] : p.json("where").items()) {
    const std::string wrong = wrong_path(key);
    if (!wrong.empty()) problems.add(tree.where(child_path(path + ".where", key)) + ": " + wrong);
    if (wrong.empty()) e.where.emplace_back(key, value);
  }
  if (p.text("over") == "views") e.over = Expectation::Over::views;
  if (p.text("take") == "mean") e.take = Expectation::Take::mean;
  std::string bound;
  int bounds = 0;
  if (!p.is_null("at_least")) {
    e.at_least = p.json("at_least").get<double>();
    bound = " >= " + number_text(*e.at_least);
    ++bounds;
  }
  if (!p.is_null("at_most")) {
    e.at_most = p.json("at_most").get<double>();
    bound = " <= " + number_text(*e.at_most);
    ++bounds;
  }
  if (!p.is_null("between")) {
    e.at_least = p.json("between")[0].get<double>();
    e.at_most = p.json("between")[1].get<double>();
    bound = " in [" + number_text(*e.at_least) + ", " + number_text(*e.at_most) + "]";
    ++bounds;
  }
  for (const char* kind : {"order", "affine"}) {
    if (p.is_null(kind)) continue;
    e.series = read_series(p.json(kind), std::string(kind) == "affine");
    if (const std::string wrong = wrong_path(e.series.key); !wrong.empty()) {
      problems.add(tree.where(path + "." + kind + ".by") + ": " + wrong);
      return e;
    }
    bound = series_text(e.series);
    ++bounds;
  }
  if (bounds != 1) {
    problems.add(tree.where(path) + ": found " + std::to_string(bounds) +
                 " bounds; must be exactly one of at_least, at_most, between, order, affine");
  }
  e.text = e.metric + " against " + e.against + bound;
  if (e.over == Expectation::Over::views) e.text = p.text("take") + " over views of " + e.text;
  return e;
}

}  // namespace

const std::vector<std::string>& own_values() {
  static const std::vector<std::string> names = {
      "light.min",        "light.max",    "light.mean",        "light.deviation", "light.error_rms",
      "light.error_max",  "time.light",   "time.direct_light", "time.march",      "blocks.reduction",
      "blocks.error_rms", "blocks.bytes", "blocks.dropped"};
  return names;
}

std::vector<Expectation> read_expectations(const ConfigTree& tree, Problems& problems) {
  std::vector<Expectation> expectations;
  const ConfigJson* list = tree.find("expect");
  if (list == nullptr) return expectations;
  if (!list->is_array()) {
    problems.add(tree.where("expect") + ": found " + short_text(*list) + "; must be a list [...]");
    return expectations;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string path = child_path("expect", i);
    if ((*list)[i].is_object()) {
      expectations.push_back(read_one(tree, path, problems));
    } else {
      problems.add(tree.where(path) + ": found " + short_text((*list)[i]) + "; must be a section {...}");
      expectations.emplace_back();
    }
  }
  return expectations;
}

const nlohmann::json* value_at(const nlohmann::json& resolved_config, const std::string& path) {
  const nlohmann::json* node = &resolved_config;
  for (const std::string& step : split_path(path)) {
    if (step.front() == '[') {
      const std::size_t index = std::stoul(step.substr(1));
      if (!node->is_array() || index >= node->size()) return nullptr;
      node = &(*node)[index];
    } else {
      if (!node->is_object() || !node->contains(step)) return nullptr;
      node = &(*node)[step];
    }
  }
  return node;
}

std::optional<double> series_place(const Expectation::Series& s, const nlohmann::json& resolved_config) {
  const nlohmann::json* value = value_at(resolved_config, s.key);
  if (value == nullptr) return std::nullopt;
  if (s.values.empty()) return value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
  const auto at = std::find(s.values.begin(), s.values.end(), *value);
  if (at == s.values.end()) return std::nullopt;
  return static_cast<double>(at - s.values.begin());
}

bool applies(const Expectation& e, const nlohmann::json& resolved_config) {
  for (const auto& [path, wanted] : e.where) {
    const nlohmann::json* found = value_at(resolved_config, path);
    if (found == nullptr || *found != wanted) return false;
  }
  return true;
}

}  // namespace dvrlab
