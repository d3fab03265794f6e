// Opens one plugin library and judges it; every way to fail has its own sentence.
#pragma once

#include <string>

#include "framework/interfaces/plugin.h"

namespace dvrlab {

/// The kinds of plugins: the folder names below a root.
inline constexpr const char* plugin_kinds[] = {"data",         "sampler", "optical_model", "estimator",
                                               "illumination", "metric",  "backend"};

struct OpenedLibrary {
  const PluginDescriptor* descriptor = nullptr;  // nullptr when `problem` says why
  std::string problem;
};

/// Opens `library` for good: a library is never unloaded, so its descriptor stays valid.
/// `kind` and `name` are what the folders promise.
OpenedLibrary open_library(const std::string& library, const std::string& kind, const std::string& name);

}  // namespace dvrlab
