// JSON that people read: lists of plain values stay on one line.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace dvrlab {

std::string pretty_json(const nlohmann::ordered_json& value, int indent = 0);

}  // namespace dvrlab
