#include "tests/support/render.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>

#include "framework/config/experiment.h"
#include "framework/image/averaged.h"

namespace dvrlab::test {

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {{"cpu scalar", {{"type", "cpu"}, {"isa", "scalar"}}},
                                          {"cpu sse4.2", {{"type", "cpu"}, {"isa", "sse4.2"}}},
                                          {"cpu avx2", {{"type", "cpu"}, {"isa", "avx2"}}},
                                          {"cpu avx512", {{"type", "cpu"}, {"isa", "avx512"}}},
                                          {"vulkan", {{"type", "vulkan"}}},
                                          {"opengl", {{"type", "opengl"}}}};
  return all;
}

const Registry& registry() {
  static const Registry found;
  return found;
}

namespace {
ResolvedCase resolved(const nlohmann::json& config) {
  const Experiment e = plan_experiment(parse_document(config.dump(), "test.json", DVRLAB_SOURCE), registry());
  return e.cases.front().resolved;
}
}  // namespace

Scene scene_of(const nlohmann::json& config) {
  static FieldCache fields;
  const ResolvedCase c = resolved(config);
  return build_scene(c, registry(), fields.load(c, registry()));
}

namespace {
/// Kept between calls.
BackendSession& session_of(const nlohmann::json& full) {
  static std::map<std::string, std::unique_ptr<BackendSession>> sessions;
  const ResolvedCase c = resolved(full);
  std::unique_ptr<BackendSession>& session = sessions[c.config.at("backend").dump()];
  if (!session)
    session = registry().get<BackendPlugin>("backend", c.backend.type).open(c.backend.parameters, c.backend.folder);
  return *session;
}
}  // namespace

FrameResult render(const nlohmann::json& config, const Target& target, const std::function<void(FrameJob&)>& alter) {
  nlohmann::json full = config;
  full["backend"] = target.backend;
  BackendSession& session = session_of(full);
  Scene scene = scene_of(full);
  if (alter) alter(scene.job);
  FrameResult result;
  session.render(scene.job, result);
  result.image = averaged(std::move(result.image), scene.rays_per_side);
  return result;
}

LightVolume illuminate(const nlohmann::json& config, const Target& target, std::vector<PhaseTime>* times,
                       const std::function<void(FrameJob&)>& alter) {
  nlohmann::json full = config;
  full["backend"] = target.backend;
  BackendSession& session = session_of(full);
  Scene scene = scene_of(full);
  if (alter) alter(scene.job);
  std::vector<PhaseTime> ignored;
  return session.illuminate(scene.job, times != nullptr ? *times : ignored);
}

std::vector<ProbeSegment> probe(const nlohmann::json& config, int x, int y) {
  nlohmann::json full = config;
  full["backend"] = {{"type", "cpu"}};
  return session_of(full).probe(scene_of(full).job, x, y);
}

double largest_difference(const FrameImage& a, const FrameImage& b) {
  if (a.width != b.width || a.height != b.height) return std::numeric_limits<double>::infinity();
  double worst = 0;
  const auto scan = [&](const std::vector<float>& x, const std::vector<float>& y) {
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double d = std::abs(double(x[k]) - double(y[k]));
      worst = std::isnan(d) ? std::numeric_limits<double>::infinity() : std::max(worst, d);
    }
  };
  scan(a.color, b.color);
  scan(a.trans, b.trans);
  return worst;
}

std::size_t differing_values(const FrameImage& a, const FrameImage& b) {
  std::size_t n = 0;
  const auto scan = [&](const std::vector<float>& x, const std::vector<float>& y) {
    for (std::size_t k = 0; k < x.size(); ++k) n += std::memcmp(&x[k], &y[k], sizeof(float)) != 0 ? 1u : 0u;
  };
  scan(a.color, b.color);
  scan(a.trans, b.trans);
  return n;
}

std::string shared_data(const std::string& relative) {
  const char* set = std::getenv("DVRLAB_SHARED_DATA");
  const std::filesystem::path file =
      std::filesystem::path(set != nullptr ? set : DVRLAB_SHARED_DATA_DEFAULT) / relative;
  return std::filesystem::exists(file) ? std::filesystem::absolute(file).lexically_normal().string() : "";
}

const nlohmann::json& golden() {
  static const nlohmann::json values = [] {
    const std::string file = shared_data("../golden/public.json");
    return file.empty() ? nlohmann::json() : nlohmann::json::parse(std::ifstream(file));
  }();
  return values;
}

nlohmann::json patched(nlohmann::json a, const nlohmann::json& b) {
  a.merge_patch(b);
  return a;
}

}  // namespace dvrlab::test
