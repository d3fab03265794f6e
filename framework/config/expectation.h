// What an experiment's numbers must satisfy: the config's `expect`.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/config_tree.h"
#include "framework/config/problems.h"

namespace dvrlab {

/// What `against` says for values that a case has without any comparison: of its light volume, and times.
inline constexpr const char* own_reference = "itself";
/// "light.min", ...: cases whose passes fill a light volume have them.
const std::vector<std::string>& own_values();

struct Expectation {
  std::string metric;                                         // "psnr", "psnr.r"
  std::string against;                                        // a reference's name, or "variant"
  std::vector<std::pair<std::string, nlohmann::json>> where;  // key path -> value that a case must have
  enum class Over { cases, views } over = Over::cases;  // views: one value of all views that differ in nothing else
  enum class Take { worst, mean } take = Take::worst;   // of the views
  std::optional<double> at_least, at_most;              // `between` sets both
  /// Of all cases that differ in nothing but `key`: how the metric follows that key.
  struct Series {
    std::string key;                     // key path; "" when there is none
    std::vector<nlohmann::json> values;  // the key's values in their order; empty: numbers in their own order
    bool increasing = false;
    bool affine = false;  // instead of an order: metric = a + b key^power to `within` of the metric's range
    double power = 1, within = 0;
  } series;
  std::string text;  // "psnr against truth >= 40": for messages and result files
};

/// Everything wrong is added to `problems`; an expectation that cannot be read has no text.
std::vector<Expectation> read_expectations(const ConfigTree& tree, Problems& problems);

/// True if the case with this resolved config is meant.
bool applies(const Expectation& e, const nlohmann::json& resolved_config);

/// Where a case stands in the series: its key's number, or the index of its value. Nothing when it has neither.
std::optional<double> series_place(const Expectation::Series& series, const nlohmann::json& resolved_config);

/// The value at a key path of a resolved config; nullptr when there is none.
const nlohmann::json* value_at(const nlohmann::json& resolved_config, const std::string& path);

}  // namespace dvrlab
