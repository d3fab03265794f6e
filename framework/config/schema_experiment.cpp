// The sections of an experiment as JSON Schema: key paths -> values.
#include "framework/config/axes.h"
#include "framework/config/schema_parts.h"
#include "framework/config/sections.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

/// A list of values, or a range of numbers. (No anyOf: an editor says what is wrong with the one that is meant.)
Schema axis_of(const Schema& value) {
  return {{"type", {"array", "object"}},
          {"minItems", 1},
          {"items", value},
          {"if", {{"type", "object"}}},
          {"then", refer("range")}};
}

void define_range(Schema& definitions) {
  const Schema positive = {{"type", "number"}, {"exclusiveMinimum", 0}};
  const Schema factor = {{"type", "array"}, {"items", positive}, {"minItems", 2}, {"maxItems", 2}};
  definitions["range"] = {{"type", "object"},
                          {"properties",
                           {{"lin",
                             {{"description", "[first, last, count]: equal distances."},
                              {"type", "array"},
                              {"items",
                               {{{"type", "number"}},
                                {{"type", "number"}},
                                {{"type", "integer"}, {"minimum", 2}, {"maximum", most_axis_values}}}},
                              {"minItems", 3},
                              {"maxItems", 3}}},
                            {"log2", factor},
                            {"log10", factor}}},
                          {"additionalProperties", false},
                          {"minProperties", 1},
                          {"maxProperties", 1}};
  definitions["range"]["properties"]["log2"]["description"] = "[first, last]: factors of 2.";
  definitions["range"]["properties"]["log10"]["description"] = "[first, last]: factors of 10.";
}

void define_expectation(Schema& definitions) {
  const SectionType& expect = *find_section_type("expect", "");
  define_branch("expectation", {"", expect.summary, expect.keys}, definitions);
  definitions["expectation"]["properties"]["where"]["$ref"] = "#/definitions/values";
  Schema& e = definitions["complete-expectation"];
  for (const char* bound : {"at_least", "at_most", "between", "order", "affine"}) {
    e["oneOf"].push_back({{"required", {bound}}, {"properties", {{bound, {{"not", {{"type", "null"}}}}}}}});
  }
}

}  // namespace

void add_experiment(const KeyPaths& paths, Schema& properties, Schema& definitions) {
  const std::string deeper = "^((" + join_words(paths.lists, "|") + ")\\[[0-9]+\\].*|(" +
                             join_words(paths.sections, "|") + ")\\.[a-z0-9_]+[.\\[].*)$";
  Schema axes = Schema::object(), values = Schema::object();
  for (const auto& [path, value] : paths.known.items()) {
    axes[path] = axis_of(value);
    if (path != "metrics") values[path] = value;  // what is measured is the same for a case and its references
  }
  define_range(definitions);
  const auto section = [&](const Schema& known, const Schema& other) {
    return Schema{{"type", "object"},
                  {"properties", known},
                  {"patternProperties", {{deeper, other}}},
                  {"additionalProperties", false}};
  };
  definitions["axes"] = section(axes, axis_of(Schema::object()));
  definitions["axes"]["properties"]["zip"] = {
      {"description", "Keys that vary together: a list of sections of key path -> values of one length."},
      {"type", "array"},
      {"minItems", 1},
      {"items", section(axes, axis_of(Schema::object()))}};
  definitions["axes"]["properties"]["zip"]["items"]["minProperties"] = 1;
  definitions["values"] = section(values, Schema::object());
  properties["axes"] = {
      {"description", "Keys that the experiment varies: key path -> values. The cases are the full product."},
      {"type", "object"},
      {"properties",
       {{"permutation", {{"description", "Every value is its own truth."}, {"$ref", "#/definitions/axes"}}},
        {"variant", {{"description", "All values must give the same bits."}, {"$ref", "#/definitions/axes"}}}}},
      {"additionalProperties", false}};
  properties["reference"] = {
      {"description", "Name -> what differs from the case: the case that others are measured against."},
      {"type", "object"},
      {"propertyNames",
       {{"pattern", "^[A-Za-z0-9_=,+][A-Za-z0-9._=,+-]*$"}, {"not", {{"enum", {"variant", "itself"}}}}}},
      {"additionalProperties", refer("values")}};
  define_expectation(definitions);
  properties["expect"] = {
      {"description", "Bounds on metrics."}, {"type", "array"}, {"items", refer("complete-expectation")}};
}

}  // namespace dvrlab
