// Where the value of a declared key lies in its section's JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace dvrlab {

/// "step" -> /step; a key of a group, "surface.opacity" -> /surface/opacity.
inline nlohmann::json::json_pointer key_pointer(const std::string& name) {
  const std::size_t dot = name.find('.');
  nlohmann::json::json_pointer p;
  p.push_back(name.substr(0, dot));
  if (dot != std::string::npos) p.push_back(name.substr(dot + 1));
  return p;
}

}  // namespace dvrlab
