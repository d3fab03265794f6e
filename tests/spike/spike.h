// What the spike tests share: configs as JSON text, the test-only plugins, and every target that this machine has.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/scene/scene.h"

namespace dvrlab::spike {

/// With the test-only plugins.
const Registry& registry();

/// A config as JSON text -> a case, defaults filled in.
ResolvedCase resolve(const std::string& config);
/// The scene of a config; of its own field, or of one that a test made.
Scene scene_of(const std::string& config);
Scene scene_of(const std::string& config, std::shared_ptr<const Field> field);

/// "cpu scalar", ..., "vulkan", "opengl". `session` is empty where this machine cannot run it; `reason` says why.
struct Target {
  std::string name;
  std::shared_ptr<BackendSession> session;
  std::string reason;
};
const std::vector<Target>& targets();

/// Renders on every target, prints the times, and expects the first target's bits everywhere. Returns the first.
FrameResult render_everywhere(const std::string& what, const FrameJob& job, int repeats = 1);

/// The case of golden/public.json, null without the file.
nlohmann::json golden(const std::string& id);

}  // namespace dvrlab::spike
