// Scenes of configs, with their data loaded once.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace dvrlab::bench {

/// The scene of the first case of a config, or of the case of the panel that is named, with overrides. `file` is
/// relative to the source tree. Throws NotSupported when its data is optional and missing.
Scene config_scene(const std::string& file, const std::string& panel = "", const std::vector<std::string>& set = {});

/// The sections of that case, resolved.
nlohmann::json config_sections(const std::string& file, const std::vector<std::string>& set = {});

}  // namespace dvrlab::bench
