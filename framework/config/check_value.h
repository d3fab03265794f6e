// One value against its declaration.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "framework/interfaces/parameter.h"

namespace dvrlab {

/// "" when the value is legal; else what was found and what would be right: "found -1; must be a whole number in
/// [2,65536]". A structure (json) is legal here: its reader judges it.
std::string wrong_value(const Parameter& p, const nlohmann::json& value);

/// The value as it is stored: a whole number that was written as 4.0 or 1e3 becomes an integer.
nlohmann::json stored_value(const Parameter& p, const nlohmann::json& value);

/// "a whole number in [2,65536]", "one of table, nodes": for messages and `describe`.
std::string legal_text(const Parameter& p);

/// A declaration's interval: "[0,inf)", "(0,180)"; "" holds every number.
bool in_interval(const char* interval, double x);

/// The value in at most 60 characters.
std::string short_text(const nlohmann::json& value);

}  // namespace dvrlab
