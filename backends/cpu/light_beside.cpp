#include "backends/cpu/light_beside.h"

#include <algorithm>
#include <cstring>

#include "framework/scene/parallel.h"
#include "framework/scene/phase_clock.h"

namespace dvrlab::cpu {
namespace {

const Buffer* find(const KernelUnit& unit, const std::string& name) {
  const auto b =
      std::find_if(unit.buffers.begin(), unit.buffers.end(), [&](const Buffer& x) { return x.name == name; });
  return b == unit.buffers.end() ? nullptr : &*b;
}
const Uniform* uniform(const KernelUnit& unit, const std::string& name) {
  const auto u =
      std::find_if(unit.uniforms.begin(), unit.uniforms.end(), [&](const Uniform& x) { return x.name == name; });
  return u == unit.uniforms.end() ? nullptr : &*u;
}

bool wants_levels(const FrameJob& job) {
  return job.light != nullptr && job.light->plan.storage == LightStorage::unorm16 && light_planes(*job.light) == 1;
}

/// The voxels beside which light of the same points may lie, if the sampler tells their cells; nothing where it cannot.
const Buffer* voxels_of(const FrameJob& job) {
  const std::uint64_t points = light_points(job.light->dims, job.light->blocks.get(), 1).points();
  const Buffer* voxels = find(job.sampler, job.sampler.plugin + "_voxels");
  if (voxels == nullptr || bytes_of(voxels->element) > 2 || voxels->count != points) return nullptr;
  if (job.precision == Precision::fp64) return nullptr;
  const Uniform* lo = uniform(job.frame, "frame_light_lo");
  const Uniform* scale = uniform(job.frame, "frame_light_scale");
  for (std::size_t a = 0; a < 3; ++a)
    if (lo->f[a] != 0 || scale->f[a] != 1) return nullptr;
  constexpr std::uint64_t most = 0xffffffff;  // lanes address bytes by 32 bits
  return points * (bytes_of(voxels->element) + 2) <= most ? voxels : nullptr;
}

Buffer lay(const Buffer& voxels, const Buffer& levels) {
  const std::size_t size = bytes_of(voxels.element), record = size + sizeof(std::uint16_t);
  constexpr std::size_t reach = 8;  // the last pair is loaded with what lies behind it
  // Not a vector: nothing of it is written twice.
  const std::shared_ptr<std::uint8_t[]> bytes(new std::uint8_t[voxels.count * record + reach]);
  std::memset(bytes.get() + voxels.count * record, 0, reach);
  const auto* v = static_cast<const std::uint8_t*>(voxels.data.get());
  const auto* l = static_cast<const std::uint8_t*>(levels.data.get());
  const auto with = [&](auto constant) {
    constexpr std::size_t n = decltype(constant)::value;
    parallel_ranges(voxels.count, 65536, [&](std::uint64_t begin, std::uint64_t end) {
      for (std::uint64_t i = begin; i < end; ++i) {
        std::uint8_t* to = bytes.get() + i * (n + 2);
        std::memcpy(to, v + i * n, n);
        std::memcpy(to + n, l + 2 * i, 2);
      }
    });
  };
  if (size == 1)
    with(std::integral_constant<std::size_t, 1>());
  else
    with(std::integral_constant<std::size_t, 2>());
  Buffer b;
  b.name = "frame_light_beside";
  b.element = Element::u8;
  b.count = voxels.count * record + reach;
  b.data = std::shared_ptr<const void>(bytes, bytes.get());
  return b;
}

}  // namespace

std::uint64_t LightBeside::bytes_for(const FrameJob& job) {
  const Buffer* voxels = wants_levels(job) && tells_cells(job.sampler) ? voxels_of(job) : nullptr;
  return voxels == nullptr ? 0 : voxels->count * (bytes_of(voxels->element) + 2);
}

bool LightBeside::cells_of(const KernelUnit& sampler) {
  const std::string place = sampler.folder + "/" + sampler.plugin;
  if (place != asked_) {
    cells_ = tells_cells(sampler);
    asked_ = place;
  }
  return cells_;
}

std::optional<FrameJob> LightBeside::add(const FrameJob& job, std::vector<PhaseTime>& times) {
  const Buffer* voxels = wants_levels(job) && cells_of(job.sampler) ? voxels_of(job) : nullptr;
  if (voxels == nullptr) {
    *this = {};
    return std::nullopt;
  }
  const Buffer& levels = *find(job.frame, "frame_light_levels");
  if (voxels->data != voxels_ || levels.data != levels_) {
    const PhaseClock clock;
    voxels_ = voxels->data;
    levels_ = levels.data;
    beside_ = {};  // both at once would be twice the memory
    beside_ = lay(*voxels, levels);
    times.push_back({"light beside the voxels", clock.wall(), clock.cpu()});
  }
  FrameJob with = job;
  with.frame.buffers.push_back(beside_);
  return with;
}

}  // namespace dvrlab::cpu
