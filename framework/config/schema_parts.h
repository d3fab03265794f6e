// The parts that the JSON Schema of configs is made of.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/config/schema.h"

namespace dvrlab {

using Schema = nlohmann::ordered_json;

/// One type of a section: of a plugin, or of the framework.
struct SchemaBranch {
  std::string type, summary;
  std::vector<Parameter> keys;
};

inline Schema refer(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }
inline Schema when(const Schema& condition, const Schema& then) { return {{"if", condition}, {"then", then}}; }
inline Schema has(const char* key) { return {{"required", {key}}}; }

/// A section of a known type: definition `name` as part of a config, `complete-name` with all that must be there.
void define_branch(const std::string& name, const SchemaBranch& branch, Schema& definitions);

/// What key paths may name below an experiment's axes, references and `where`.
struct KeyPaths {
  Schema known = Schema::object();    // path -> schema of the value
  std::vector<std::string> sections;  // whose structures may be entered: "image.size[0]"
  std::vector<std::string> lists;     // whose elements may be entered: "lights[0].color"
};

/// The experiment's own sections: axes, reference, expect.
void add_experiment(const KeyPaths& paths, Schema& properties, Schema& definitions);

}  // namespace dvrlab
