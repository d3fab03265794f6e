// Rendering a config on every target: the instruction sets of the cpu backend, Vulkan, OpenGL.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/interfaces/backend.h"
#include "framework/interfaces/error.h"
#include "framework/plugin/registry.h"
#include "framework/scene/scene.h"

namespace dvrlab::test {

/// A place where a frame can be rendered.
struct Target {
  std::string name;        // for messages
  nlohmann::json backend;  // the config's section
};
inline void PrintTo(const Target& t, std::ostream* out) { *out << t.name; }
/// cpu scalar, sse4.2, avx2, avx512, vulkan, opengl. Those that cannot run here throw NotSupported when used.
const std::vector<Target>& targets();

const Registry& registry();

/// Resolves, checks and builds the first case of a config. Data is kept between calls.
Scene scene_of(const nlohmann::json& config);

/// Renders on a target; sessions are kept between calls. `alter` may change the job first (negative controls).
/// Throws NotSupported when the target is not here.
FrameResult render(const nlohmann::json& config, const Target& target,
                   const std::function<void(FrameJob&)>& alter = nullptr);

/// The light volume of the config, likewise. `times`: of the stages.
LightVolume illuminate(const nlohmann::json& config, const Target& target, std::vector<PhaseTime>* times = nullptr,
                       const std::function<void(FrameJob&)>& alter = nullptr);

/// The segments of one ray on the cpu.
std::vector<ProbeSegment> probe(const nlohmann::json& config, int x, int y);

/// The largest absolute difference over radiance and transmittance; NaN counts as infinite.
double largest_difference(const FrameImage& a, const FrameImage& b);
/// Number of values whose bits differ.
std::size_t differing_values(const FrameImage& a, const FrameImage& b);

/// The file in the folder of further real data (DVRLAB_SHARED_DATA), or "" when it is not there.
std::string shared_data(const std::string& relative);

/// Golden values (golden/public.json beside the shared data); null when they are not there.
const nlohmann::json& golden();

/// b merged over a (JSON merge patch).
nlohmann::json patched(nlohmann::json a, const nlohmann::json& b);

}  // namespace dvrlab::test
