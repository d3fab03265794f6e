#include "framework/config/schema.h"

#include <algorithm>
#include <map>

#include "framework/config/sections.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

using Schema = nlohmann::ordered_json;

/// One type of a section: of a plugin, or of the framework.
struct Branch {
  std::string type, summary;
  std::vector<Parameter> keys;
};

/// A section of the config and where its types come from.
struct SectionSource {
  const char* key;           // in the config
  const char* kind;          // of plugins; "" for the framework's own types
  const char* default_type;  // when `type` is left out; "" when it must be there
  bool list;
  const char* summary;
};
constexpr SectionSource sources[] = {
    {"data", "data", "", false, "The scalar field."},
    {"optical_model", "optical_model", "", false, "Turns transfer functions into a medium."},
    {"estimator", "estimator", "", false, "Integrates the medium over one segment."},
    {"lights", "", "", true, "At most 4 lights; by default one at the eye."},
    {"illumination", "illumination", "", true, "Illumination passes, in order."},
    {"camera", "", "", false, "The rays of the image."},
    {"clip", "", "", true, "Planes that cut the data."},
    {"sampling", "", "uniform", false, "Where rays are sampled."},
    {"image", "", "", false, "The picture."},
    {"limits", "", "", false, "What a case may use."},
    {"backend", "backend", "cpu", false, "What runs the march."},
    {"metrics", "metric", "", true, "What is measured against every reference; a type alone is short for its section."},
};

Schema refer(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }
Schema when(Schema condition, Schema then) { return {{"if", std::move(condition)}, {"then", std::move(then)}}; }
Schema has(const char* key) { return {{"required", {key}}}; }

std::vector<Branch> branches_of(const SectionSource& source, const Registry& registry) {
  std::vector<Branch> branches;
  const bool of_plugins = *source.kind != '\0';
  const SectionType* shared = of_plugins ? find_section_type(source.kind, "") : nullptr;
  for (const PluginEntryInfo& e : registry.entries()) {
    if (!of_plugins || e.kind != source.kind || e.descriptor == nullptr) continue;
    Branch b{e.name, e.descriptor->summary, {}};
    b.keys.assign(e.descriptor->parameters, e.descriptor->parameters + e.descriptor->parameter_count);
    if (shared != nullptr) b.keys.insert(b.keys.end(), shared->keys.begin(), shared->keys.end());
    branches.push_back(std::move(b));
  }
  for (const SectionType& s : section_types())
    if (!of_plugins && s.section == std::string(source.key)) branches.push_back({s.type, s.summary, s.keys});
  return branches;
}

class SchemaWriter {
 public:
  explicit SchemaWriter(const Registry& registry) : registry_(registry) {}

  Schema write() {
    Schema properties = {{"$schema", {{"type", "string"}, {"description", "The schema that an editor reads."}}}};
    Schema partial = Schema::object(), complete = Schema::object();
    for (const Parameter& p : find_section_type("case", "")->keys) {
      properties[p.name] = value_schema(p);
      if (std::find(unvaried_.begin(), unvaried_.end(), p.name) == unvaried_.end())
        add_path(p.name, {{"$ref", "#/properties/" + std::string(p.name)}});
    }
    properties["include"] = {{"description", "A config, or a list of them, that is merged below this one."},
                             {"type", {"string", "array"}},
                             {"items", {{"type", "string"}}}};
    for (const SectionSource& source : sources) {
      properties[source.key] = {{"description", source.summary}};
      define(source);
      partial[source.key] = whole(source, "");
      complete[source.key] = whole(source, "complete-");
    }
    add_experiment(properties);
    return {{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "dvrlab config"},
            {"type", "object"},
            {"properties", properties},
            {"additionalProperties", false},
            // What an included file or an axis may bring is not missing.
            {"if", {{"anyOf", {has("include"), has("axes")}}}},
            {"then", {{"properties", partial}}},
            {"else", {{"properties", complete}}},
            {"definitions", definitions_}};
  }

 private:
  /// The value of a section's key: a section, or a list of them.
  static Schema whole(const SectionSource& source, const std::string& prefix) {
    const Schema one = refer(prefix + source.key);
    return source.list ? Schema{{"type", "array"}, {"items", one}} : one;
  }

  void define(const SectionSource& source) {
    const std::string section = source.key;
    const std::vector<Branch> branches = branches_of(source, registry_);
    Schema keys = Schema::object();
    for (const Branch& b : branches) {
      const std::string name = b.type.empty() ? section : section + "." + b.type;
      define_branch(name, b);
      for (const Parameter& p : b.keys) {
        keys[p.name]["anyOf"].push_back(refer(name + "/properties/" + p.name));
        if (!source.list) add_path(section + "." + p.name, refer("keys-" + section + "/properties/" + p.name));
      }
    }
    definitions_["keys-" + section] = {{"type", "object"}, {"properties", keys}, {"additionalProperties", false}};
    if (branches.size() != 1 || !branches[0].type.empty()) {
      define_choice(source, branches, "");
      define_choice(source, branches, "complete-");
    }
    add_path(section, whole(source, ""));
  }

  /// A section of a known type: as part of a config, and complete.
  void define_branch(const std::string& name, const Branch& b) {
    Schema properties = Schema::object(), required = Schema::array();
    if (!b.type.empty()) properties["type"] = {{"const", b.type}, {"description", b.summary}};
    for (const Parameter& p : b.keys) {
      properties[p.name] = value_schema(p);
      if (p.default_value == nullptr) required.push_back(p.name);
    }
    Schema unread = Schema::array(), unread_by_default = Schema::array();
    for (const Parameter& p : b.keys) add_unread(p, b.keys, unread, unread_by_default);
    definitions_[name] = {
        {"type", "object"}, {"description", b.summary}, {"properties", properties}, {"additionalProperties", false}};
    if (!unread.empty()) definitions_[name]["allOf"] = unread;
    unread_by_default.insert(unread_by_default.begin(), refer(name));
    definitions_["complete-" + name] = {{"required", required}, {"allOf", unread_by_default}};
  }

  /// A key that is read only with some words of a choice.
  static void add_unread(const Parameter& p, const std::vector<Parameter>& keys, Schema& unread, Schema& by_default) {
    if (*p.only_with == '\0') return;
    const std::vector<std::string> condition = split_words(p.only_with, '='), readers = split_words(condition.at(1));
    const auto reads = [&](const std::string& w) {
      return std::find(readers.begin(), readers.end(), w) != readers.end();
    };
    for (const Parameter& choice : keys) {
      if (choice.name != condition[0]) continue;
      std::vector<std::string> others = split_words(choice.legal);
      std::erase_if(others, reads);
      const Schema refuse = {{"properties", {{p.name, false}}}};
      unread.push_back(
          when({{"required", {choice.name}}, {"properties", {{choice.name, {{"enum", others}}}}}}, refuse));
      if (choice.default_value != nullptr && !reads(Schema::parse(choice.default_value).get<std::string>()))
        by_default.push_back(when({{"not", has(choice.name)}}, refuse));
    }
  }

  /// `type` chooses the branch. Without it: the default type, or keys that are merged over a section elsewhere.
  void define_choice(const SectionSource& source, const std::vector<Branch>& branches, const std::string& prefix) {
    const std::string section = source.key;
    Schema types = Schema::array(), summaries = Schema::array(), choices = Schema::array();
    for (const Branch& b : branches) {
      types.push_back(b.type);
      summaries.push_back(b.summary);
      choices.push_back(when({{"required", {"type"}}, {"properties", {{"type", {{"const", b.type}}}}}},
                             refer(prefix + section + "." + b.type)));
    }
    Schema s = {{"type", "object"},
                {"description", source.summary},
                {"properties", {{"type", {{"enum", types}, {"enumDescriptions", summaries}}}}}};
    if (!prefix.empty() && *source.default_type == '\0') s["required"] = {"type"};
    const bool by_default = !prefix.empty() && *source.default_type != '\0';
    choices.push_back(when({{"not", has("type")}}, by_default ? refer(prefix + section + "." + source.default_type)
                                                              : refer("keys-" + section)));
    s["allOf"] = choices;
    if (section == "metrics")  // "psnr" is short for {"type": "psnr"}
      s = {{"type", {"string", "object"}}, {"if", {{"type", "string"}}}, {"then", {{"enum", types}}}, {"else", s}};
    definitions_[prefix + section] = s;
  }

  void add_path(const std::string& path, const Schema& value) { paths_[path] = value; }

  /// Sections of the experiment: key paths -> values.
  void add_experiment(Schema& properties) {
    const Schema deeper = "^(" + deeper_paths() + ")$";
    Schema axes = Schema::object(), values = Schema::object();
    for (const auto& [path, value] : paths_.items()) {
      values[path] = value;
      axes[path] = axis_of(value);
    }
    define_range();
    const auto paths = [&](const Schema& known, const Schema& other) {
      return Schema{{"type", "object"},
                    {"properties", known},
                    {"patternProperties", {{deeper.get<std::string>(), other}}},
                    {"additionalProperties", false}};
    };
    definitions_["axes"] = paths(axes, axis_of(Schema::object()));
    definitions_["axes"]["properties"]["zip"] = {
        {"description", "Keys that vary together: a list of sections of key path -> values of one length."},
        {"type", "array"},
        {"items", paths(axes, axis_of(Schema::object()))}};
    definitions_["values"] = paths(values, Schema::object());
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
        {"propertyNames", {{"pattern", "^[A-Za-z0-9_=,+][A-Za-z0-9._=,+-]*$"}, {"not", {{"const", "variant"}}}}},
        {"additionalProperties", refer("values")}};
    define_expectation();
    properties["expect"] = {
        {"description", "Bounds on metrics."}, {"type", "array"}, {"items", refer("complete-expectation")}};
  }

  /// A list of values, or a range of numbers. (No anyOf: an editor says what is wrong with the one that is meant.)
  static Schema axis_of(const Schema& value) {
    return {{"type", {"array", "object"}},
            {"minItems", 1},
            {"items", value},
            {"if", {{"type", "object"}}},
            {"then", refer("range")}};
  }

  /// Into lists and structures: "lights[0].color", "image.size[0]".
  static std::string deeper_paths() {
    std::vector<std::string> sections, lists;
    for (const SectionSource& s : sources) (s.list ? lists : sections).emplace_back(s.key);
    return "(" + join_words(lists, "|") + ")\\[[0-9]+\\].*|(" + join_words(sections, "|") + ")\\.[a-z0-9_]+[.\\[].*";
  }

  void define_range() {
    const Schema positive = {{"type", "number"}, {"exclusiveMinimum", 0}};
    const Schema factor = {{"type", "array"}, {"items", positive}, {"minItems", 2}, {"maxItems", 2}};
    definitions_["range"] = {{"type", "object"},
                             {"properties",
                              {{"lin",
                                {{"description", "[first, last, count]: equal distances."},
                                 {"type", "array"},
                                 {"items", {{"type", "number"}}},
                                 {"minItems", 3},
                                 {"maxItems", 3}}},
                               {"log2", factor},
                               {"log10", factor}}},
                             {"additionalProperties", false},
                             {"minProperties", 1},
                             {"maxProperties", 1}};
    definitions_["range"]["properties"]["log2"]["description"] = "[first, last]: factors of 2.";
    definitions_["range"]["properties"]["log10"]["description"] = "[first, last]: factors of 10.";
  }

  void define_expectation() {
    const SectionType& expect = *find_section_type("expect", "");
    define_branch("expectation", {"", expect.summary, expect.keys});
    definitions_["expectation"]["properties"]["where"]["$ref"] = "#/definitions/values";
    Schema& e = definitions_["complete-expectation"];
    for (const char* bound : {"at_least", "at_most", "between", "order"}) {
      e["oneOf"].push_back({{"required", {bound}}, {"properties", {{bound, {{"not", {{"type", "null"}}}}}}}});
    }
  }

  const Registry& registry_;
  Schema definitions_ = Schema::object(), paths_ = Schema::object();
  const std::vector<std::string> unvaried_ = {"name", "schema", "base_folder"};
};

}  // namespace

nlohmann::ordered_json config_schema(const Registry& registry) { return SchemaWriter(registry).write(); }

}  // namespace dvrlab
