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

struct Expectation {
  std::string metric;                                         // "psnr", "psnr.r"
  std::string against;                                        // a reference's name, or "variant"
  std::vector<std::pair<std::string, nlohmann::json>> where;  // key path -> value that a case must have
  enum class Over { cases, views } over = Over::cases;  // views: one value of all views that differ in nothing else
  enum class Take { worst, mean } take = Take::worst;   // of the views
  std::optional<double> at_least, at_most;              // `between` sets both
  std::string order_by;                                 // key path; "" when there is no order
  bool increasing = false;
  std::string text;  // "psnr against truth >= 40": for messages and result files
};

/// Everything wrong is added to `problems`; an expectation that cannot be read has no text.
std::vector<Expectation> read_expectations(const ConfigTree& tree, Problems& problems);

/// True if the case with this resolved config is meant.
bool applies(const Expectation& e, const nlohmann::json& resolved_config);

/// The value at a key path of a resolved config; nullptr when there is none.
const nlohmann::json* value_at(const nlohmann::json& resolved_config, const std::string& path);

}  // namespace dvrlab
