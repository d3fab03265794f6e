// What every backend's session does before it marches: the light volume.
#include <algorithm>
#include <cmath>

#include "framework/backend/light_cache.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

std::vector<std::pair<std::string, double>> statistics_of(const LightVolume& volume) {
  double sum = 0, square = 0, least = 1e300, most = -1e300;
  for (const float x : *volume.values) {
    sum += double(x);
    square += double(x) * double(x);
    least = std::min(least, double(x));
    most = std::max(most, double(x));
  }
  const auto count = double(volume.values->size());
  const double mean = sum / count;
  std::vector<std::pair<std::string, double>> values = {
      {"min", least},
      {"max", most},
      {"mean", mean},
      {"deviation", std::sqrt(std::max(square / count - mean * mean, 0.0))}};
  if (volume.error == nullptr) return values;
  square = most = 0;
  for (const float e : *volume.error) {
    square += double(e) * double(e);
    most = std::max(most, double(e));
  }
  values.insert(values.end(), {{"error_rms", std::sqrt(square / double(volume.error->size()))}, {"error_max", most}});
  return values;
}

}  // namespace

BackendSession::BackendSession() = default;
BackendSession::~BackendSession() = default;

LightVolume BackendSession::illuminate(const FrameJob& job, std::vector<PhaseTime>& times) {
  if (light_ == nullptr) light_ = std::make_unique<LightCache>();
  return light_->volume(
      job, [&](const StageJob& s, LightVolume& v) { fill(s, v); }, times);
}

FrameJob BackendSession::lit(const FrameJob& job, const LightVolume& volume) {
  FrameJob with = job;
  for (Buffer& b : with.frame.buffers) {
    if (b.name != "frame_light_volume") continue;
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
  std::vector<PhaseTime> times;
  const LightVolume volume = illuminate(job, times);
  march(lit(job, volume), result);
  result.light = statistics_of(volume);
  result.times.insert(result.times.begin(), times.begin(), times.end());
}

std::vector<ProbeSegment> BackendSession::probe(const FrameJob& job, int x, int y) {
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
