// What every backend's session does before it marches: the light volume.
#include "framework/backend/light_cache.h"
#include "framework/interfaces/error.h"

namespace dvrlab {

BackendSession::BackendSession() = default;
BackendSession::~BackendSession() = default;

LightVolume BackendSession::illuminate(const FrameJob& job, std::vector<PhaseTime>& times) {
  if (light_ == nullptr) light_ = std::make_unique<LightCache>();
  return light_->volume(
      job, [&](const StageJob& s, LightVolume& v) { fill(s, v); }, times);
}

FrameJob BackendSession::lit(const FrameJob& job, const LightVolume& volume) {
  FrameJob with = job;
  for (Uniform& u : with.frame.uniforms)
    if (u.name == "frame_light_unit") u.f[0] = double(volume.unit);
  for (Buffer& b : with.frame.buffers) {
    if (volume.levels && b.name == "frame_light_levels") {
      b.count = volume.levels->size();
      b.data = {volume.levels, volume.levels->data()};
    }
    if (volume.levels || b.name != "frame_light_volume") continue;
    b.count = volume.values->size();
    b.data = {volume.values, volume.values->data()};
    b.data64 = nullptr;
    if (volume.values64) b.data64 = {volume.values64, volume.values64->data()};
  }
  return with;
}

void BackendSession::render(const FrameJob& job, FrameResult& result) {
  if (job.light == nullptr) {
    march(job, result);
    return;
  }
  if (!job.light->plan.image.empty()) {
    find_image(job, result);
    return;
  }
  std::vector<PhaseTime> times;
  const LightVolume volume = illuminate(job, times);
  march(lit(job, volume), result);
  result.light = volume.statistics;
  result.times.insert(result.times.begin(), times.begin(), times.end());
}

void BackendSession::find_image(const FrameJob& job, FrameResult& result) {
  if (light_ == nullptr) light_ = std::make_unique<LightCache>();
  light_->image(
      job, [&](const StageJob& s, LightVolume& v) { fill(s, v); }, result);
}

std::vector<ProbeSegment> BackendSession::probe(const FrameJob& job, int x, int y) {
  if (job.light != nullptr && !job.light->plan.image.empty())
    throw NotSupported("the pass finds the image itself, without segments that a probe could show");
  std::vector<PhaseTime> times;
  return job.light == nullptr ? march_ray(job, x, y) : march_ray(lit(job, illuminate(job, times)), x, y);
}

std::vector<ProbeSegment> BackendSession::march_ray(const FrameJob&, int, int) {
  throw NotSupported("backend " + device(Precision::strict).api +
                     ": no probe; probe with backend cpu, which marches the same bits");
}

void BackendSession::fill(const StageJob&, LightVolume&) {
  throw NotSupported("backend " + device(Precision::strict).api +
                     ": no light volumes; use backend cpu, vulkan or opengl");
}

}  // namespace dvrlab
