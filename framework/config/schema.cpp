#include "framework/config/schema.h"

#include <algorithm>

#include "framework/config/schema_parts.h"
#include "framework/config/sections.h"

namespace dvrlab {
namespace {

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
    {"sampler", "sampler", "", false, "What reads the data at positions; left out: the one that the data name."},
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

std::vector<SchemaBranch> branches_of(const SectionSource& source, const Registry& registry) {
  std::vector<SchemaBranch> branches;
  const bool of_plugins = *source.kind != '\0';
  const SectionType* shared = of_plugins ? find_section_type(source.kind, "") : nullptr;
  for (const PluginEntryInfo& e : registry.entries()) {
    if (!of_plugins || e.kind != source.kind || e.descriptor == nullptr) continue;
    SchemaBranch b{e.name, e.descriptor->summary, {}};
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
        paths_.known[p.name] = {{"$ref", "#/properties/" + std::string(p.name)}};
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
    add_experiment(paths_, properties, definitions_);
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
    if (!source.list) return one;
    Schema list = {{"type", "array"}, {"items", one}};
    if (source.key == std::string("lights")) list["maxItems"] = most_lights;
    return list;
  }

  void define(const SectionSource& source) {
    const std::string section = source.key;
    const std::vector<SchemaBranch> branches = branches_of(source, registry_);
    Schema keys = Schema::object();
    for (const SchemaBranch& b : branches) {
      const std::string name = b.type.empty() ? section : section + "." + b.type;
      define_branch(name, b, definitions_);
      for (const Parameter& p : b.keys) add_key(source, name, p.name, keys);
    }
    definitions_["keys-" + section] = {{"type", "object"}, {"properties", keys}, {"additionalProperties", false}};
    if (branches.size() != 1 || !branches[0].type.empty()) {
      define_choice(source, branches, "");
      define_choice(source, branches, "complete-");
    }
    paths_.known[section] = whole(source, "");
    (source.list ? paths_.lists : paths_.sections).push_back(section);
  }

  /// A key of branch `name` among those of all branches, and as a path that an axis may vary.
  void add_key(const SectionSource& source, const std::string& name, const std::string& key, Schema& keys) {
    const std::size_t dot = key.find('.');
    const std::string top = key.substr(0, dot), section = source.key;
    const Schema here = refer(name + "/properties/" + top);
    Schema& all = keys[top]["anyOf"];
    if (std::find(all.begin(), all.end(), here) == all.end()) all.push_back(here);
    if (source.list) return;
    paths_.known[section + "." + top] = refer("keys-" + section + "/properties/" + top);
    if (dot != std::string::npos)
      paths_.known[section + "." + key]["anyOf"].push_back(
          refer(name + "/properties/" + top + "/properties/" + key.substr(dot + 1)));
  }

  /// `type` chooses the branch. Without it: the default type, or keys that are merged over a section elsewhere.
  void define_choice(const SectionSource& source, const std::vector<SchemaBranch>& branches,
                     const std::string& prefix) {
    const std::string section = source.key;
    if (!source.list) paths_.known[section + ".type"] = refer(section + "/properties/type");
    Schema types = Schema::array(), summaries = Schema::array(), choices = Schema::array();
    for (const SchemaBranch& b : branches) {
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
      s = {{"anyOf", {Schema{{"enum", types}, {"enumDescriptions", summaries}}, s}}};
    definitions_[prefix + section] = s;
  }

  const Registry& registry_;
  Schema definitions_ = Schema::object();
  KeyPaths paths_;
  const std::vector<std::string> unvaried_ = {"name", "schema", "base_folder"};
};

}  // namespace

nlohmann::ordered_json config_schema(const Registry& registry) { return SchemaWriter(registry).write(); }

}  // namespace dvrlab
