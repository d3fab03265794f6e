// One declared parameter as JSON Schema.
#include <cstdlib>

#include "framework/config/check_value.h"
#include "framework/config/schema.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

using Schema = nlohmann::ordered_json;

/// "[0,inf)" -> {"minimum": 0}
void add_interval(const std::string& interval, Schema& s) {
  if (interval.empty()) return;
  char* end = nullptr;
  const double lo = std::strtod(interval.c_str() + 1, &end), hi = std::strtod(end + 1, nullptr);
  const auto bound = [&](double x, bool closed, const char* inclusive, const char* exclusive) {
    if (x - x != 0) return;  // infinite: no bound
    Schema number = x;
    if (x == static_cast<double>(static_cast<long long>(x))) number = static_cast<long long>(x);
    s[closed ? inclusive : exclusive] = number;
  };
  bound(lo, interval.front() == '[', "minimum", "exclusiveMinimum");
  bound(hi, interval.back() == ']', "maximum", "exclusiveMaximum");
}

Schema list_of(const Schema& item, std::size_t count) {
  return {{"type", "array"}, {"items", item}, {"minItems", count}, {"maxItems", count}};
}

Schema number_of(const char* type, const char* interval) {
  Schema s = {{"type", type}};
  add_interval(interval, s);
  return s;
}

/// A value, and what is never negative.
Schema node_of(std::size_t length) {
  return {{"type", "array"},
          {"items", Schema::array({{{"type", "number"}}})},
          {"additionalItems", {{"type", "number"}, {"minimum", 0}}},
          {"minItems", length},
          {"maxItems", length}};
}

/// Rows of equal length: all of one of the legal lengths.
Schema nodes_of(const std::string& components) {
  Schema options = Schema::array({{{"type", "null"}}});
  for (const std::string& count : split_words(components)) {
    options.push_back(
        {{"type", "array"}, {"minItems", 1}, {"items", node_of(1 + std::strtoul(count.c_str(), nullptr, 10))}});
  }
  return {{"anyOf", options}};
}

Schema shape_of(const Parameter& p) {
  switch (p.type) {
    case ParameterType::boolean:
      return {{"type", "boolean"}};
    case ParameterType::integer:
      return number_of("integer", p.legal);
    case ParameterType::number:
      return number_of("number", p.legal);
    case ParameterType::text:
      return {{"type", "string"}};
    case ParameterType::choice:
      return {{"enum", split_words(p.legal)}};
    case ParameterType::vector3:
      return list_of(number_of("number", p.legal), 3);
    case ParameterType::integer3:
      return list_of(number_of("integer", p.legal), 3);
    case ParameterType::nodes:
      return nodes_of(p.legal);
    case ParameterType::json:
      return *p.schema == '\0' ? Schema::object() : Schema::parse(p.schema);
  }
  return Schema::object();
}

}  // namespace

nlohmann::ordered_json value_schema(const Parameter& p) {
  Schema s = shape_of(p);
  const std::string unit = p.unit, summary = p.summary;
  const bool required = p.default_value == nullptr;
  s["description"] = summary + (unit.empty() ? "" : " Unit: " + unit + ".");
  s["markdownDescription"] = summary + (unit.empty() ? "" : "\n\n* unit: " + unit) + (unit.empty() ? "\n\n" : "\n") +
                             "* legal: " + legal_text(p) + "\n* " +
                             (required ? "required" : "default: `" + std::string(p.default_value) + "`") +
                             (p.affects == Affects::pixels  ? "\n* decides pixels"
                              : p.affects == Affects::speed ? "\n* speed only: the same bits"
                                                            : "");
  if (*p.only_with != '\0')
    s["markdownDescription"] = s["markdownDescription"].get<std::string>() + "\n* only with " + p.only_with;
  if (!required) s["default"] = Schema::parse(p.default_value);
  return s;
}

}  // namespace dvrlab
