#include "framework/config/check_value.h"

#include <cmath>
#include <cstdlib>

#include "framework/config/words.h"
#include "framework/plugin/registry.h"

namespace dvrlab {
namespace {

using nlohmann::json;

bool whole(const json& v) {
  if (v.is_number_integer()) return !v.is_number_unsigned() || v.get<std::uint64_t>() <= (std::uint64_t{1} << 62);
  return v.is_number_float() && std::abs(v.get<double>()) < 9e15 && v.get<double>() == std::floor(v.get<double>());
}

bool finite_number(const json& v) { return v.is_number() && std::isfinite(v.get<double>()); }

template <class Test>
bool list_of(const json& v, std::size_t count, Test test) {
  if (!v.is_array() || v.size() != count) return false;
  for (const json& x : v) {
    if (!test(x)) return false;
  }
  return true;
}

/// "" or what is wrong with a list of transfer function nodes.
std::string wrong_nodes(const Parameter& p, const json& v) {
  if (v.is_null()) return "";
  if (!v.is_array() || v.empty()) return "must be " + legal_text(p);
  std::size_t columns = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const std::string node = "node " + std::to_string(i) + " ";
    const json& row = v[i];
    if (i == 0 && row.is_array()) columns = row.size();
    if (columns < 2 || !list_of(row, columns, finite_number)) {
      return node + short_text(row) + " must be a list of numbers, as long as the first one: " + legal_text(p);
    }
    if (i > 0 && row[0].get<double>() < v[i - 1][0].get<double>())
      return node + short_text(row) + " lies before its predecessor: values must ascend";
    if (std::any_of(row.begin() + 1, row.end(), [](const json& x) { return x.get<double>() < 0; }))
      return node + short_text(row) + " is negative: what a transfer function gives must be 0 or more";
  }
  for (const std::string& components : split_words(p.legal)) {
    if (columns == 1 + std::stoul(components)) return "";
  }
  return "the nodes have " + std::to_string(columns) + " numbers each; must be " + legal_text(p);
}

bool right_type(const Parameter& p, const json& v) {
  switch (p.type) {
    case ParameterType::boolean:
      return v.is_boolean();
    case ParameterType::integer:
      return whole(v);
    case ParameterType::number:
      return finite_number(v);
    case ParameterType::text:
    case ParameterType::choice:
      return v.is_string();
    case ParameterType::vector3:
      return list_of(v, 3, finite_number);
    case ParameterType::integer3:
      return list_of(v, 3, [](const json& x) { return whole(x) && std::abs(x.get<double>()) < 2147483648.0; });
    case ParameterType::nodes:
    case ParameterType::json:
      return true;
  }
  return false;
}

bool in_range(const Parameter& p, const json& v) {
  switch (p.type) {
    case ParameterType::integer:
    case ParameterType::number:
      return in_interval(p.legal, v.get<double>());
    case ParameterType::vector3:
    case ParameterType::integer3:
      return list_of(v, 3, [&](const json& x) { return in_interval(p.legal, x.get<double>()); });
    default:
      return true;
  }
}

/// Numbers that are whole, alone or in lists, as integers.
json whole_numbers(const json& value) {
  if (value.is_number_float() && whole(value)) return static_cast<std::int64_t>(value.get<double>());
  if (!value.is_array()) return value;
  json list = json::array();
  for (const json& x : value) list.push_back(whole_numbers(x));
  return list;
}

}  // namespace

std::string short_text(const json& value) {
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

bool in_interval(const char* interval, double x) {
  const std::string text = interval;
  if (text.empty()) return true;
  char* end = nullptr;
  const double lo = std::strtod(text.c_str() + 1, &end);
  const double hi = std::strtod(end + 1, &end);
  return (text.front() == '[' ? x >= lo : x > lo) && (text.back() == ']' ? x <= hi : x < hi);
}

std::string legal_text(const Parameter& p) {
  const std::string range = *p.legal == '\0' ? "" : std::string(" in ") + p.legal;
  switch (p.type) {
    case ParameterType::boolean:
      return "true or false";
    case ParameterType::integer:
      return "a whole number" + range;
    case ParameterType::number:
      return "a number" + range;
    case ParameterType::text:
      return "a text";
    case ParameterType::choice:
      return "one of " + join_words(split_words(p.legal));
    case ParameterType::vector3:
      return "three numbers [x, y, z]" + (range.empty() ? "" : ", each" + range);
    case ParameterType::integer3:
      return "three whole numbers [i, j, k]" + (range.empty() ? "" : ", each" + range);
    case ParameterType::nodes: {
      const std::string components = p.legal;
      return std::string("null or nodes ") + (components == "1"   ? "[[value, x], ...]"
                                              : components == "3" ? "[[value, r, g, b], ...]"
                                                                  : "[[value, x], ...] or [[value, r, g, b], ...]");
    }
    case ParameterType::json:
      return *p.legal == '\0' ? "a structure, see its description" : p.legal;
  }
  return "";
}

std::string wrong_value(const Parameter& p, const json& value) {
  if (p.type == ParameterType::nodes) return wrong_nodes(p, value);
  if (!right_type(p, value) || !in_range(p, value)) return "found " + short_text(value) + "; must be " + legal_text(p);
  if (p.type == ParameterType::choice) {
    const std::vector<std::string> legal = split_words(p.legal);
    const std::string found = value.get<std::string>();
    for (const std::string& word : legal) {
      if (word == found) return "";
    }
    return "found '" + found + "'" + did_you_mean(found, legal) + "; must be " + legal_text(p);
  }
  return "";
}

json stored_value(const Parameter& p, const json& value) {
  if (p.type == ParameterType::json) return whole_numbers(value);
  if (p.type == ParameterType::integer && value.is_number_float())
    return static_cast<std::int64_t>(value.get<double>());
  if (p.type == ParameterType::integer3) {
    json list = json::array();
    for (const json& x : value) list.push_back(static_cast<std::int64_t>(x.get<double>()));
    return list;
  }
  return value;
}

}  // namespace dvrlab
