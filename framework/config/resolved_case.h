// One case after resolution: every section has its type, every declared key a legal value.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/interfaces/parameter_set.h"
#include "framework/interfaces/plugin.h"

namespace dvrlab {

/// A section with a `type`: of a plugin, or of the framework (camera, lights, sampling, ...).
struct Section {
  std::string type;
  ParameterSet parameters;
  const PluginDescriptor* plugin = nullptr;  // nullptr for the framework's own types
  std::string folder;                        // the plugin's folder
};

/// Keys of a section that every plugin of the kind shares (data.nan_policy, optical_model.tf, ...) are in the
/// same ParameterSet as the plugin's own.
struct ResolvedCase {
  Section data, optical_model, estimator, camera, sampling, backend;
  Section sampler;                    // without a type where the config has none: the one that the data name
  std::vector<Section> lights;        // at most 4
  std::vector<Section> illumination;  // passes, in order
  std::vector<Section> clip;          // planes: parameters normal, offset
  std::vector<Section> metrics;
  ParameterSet image;   // size, background, space
  ParameterSet limits;  // memory, gpu_buffer
  ParameterSet top;     // name, precision, seed, repeat, ...
  std::string base_folder;
  nlohmann::json config;  // the whole resolved config: running it again renders the same image
};

}  // namespace dvrlab
