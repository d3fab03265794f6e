// The framework's own config sections, declared in the same tables as the parameters of plugins.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/interfaces/parameter_set.h"

namespace dvrlab {

/// How a structure (ParameterType::json) is judged: nullptr, or true when the value has the shape that `legal` says.
struct JsonShape {
  const char* key;
  bool (*fits)(const nlohmann::json& value);
};

/// The keys of a section, or of one of its types.
struct SectionType {
  const char* section;  // "camera"; "case" for the keys at the top
  const char* type;     // "perspective"; "" when the section has no types of the framework's own
  const char* summary;  // one sentence
  std::vector<Parameter> keys;
  std::vector<JsonShape> shapes = {};
  /// What the declarations cannot say, as Plugin::check: throws InputError that begins with the key's path.
  void (*check)(const ParameterSet& keys) = nullptr;
};

/// Lights of a case; those that local shading can take.
inline constexpr std::size_t most_lights = 16, most_shading_lights = 4;

/// All of them. `data` and `optical_model` are the keys that every plugin of that kind shares.
const std::vector<SectionType>& section_types();

/// nullptr when there is none.
const SectionType* find_section_type(const std::string& section, const std::string& type);

/// The types of a section: camera -> perspective, orthographic, ray.
std::vector<std::string> types_of(const std::string& section);

/// The legal keys at the top of a config that are sections, not plain values.
const std::vector<std::string>& top_sections();

}  // namespace dvrlab
