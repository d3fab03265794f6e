#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/parallel.h"
#include "framework/scene/voxels.h"

namespace dvrlab {
namespace {

constexpr std::uint64_t least_voxels = 1 << 18;
constexpr std::int32_t infinity_bits = 0x7f800000;

// A float's bits as an integer of the same order: comparisons of integers vectorise without relaxed arithmetic.
std::int32_t ordered(std::int32_t bits) { return bits ^ ((bits >> 31) & 0x7fffffff); }

struct Range {
  double lo = std::numeric_limits<double>::infinity(), hi = -lo;
  bool finite = true;
};

template <class T>
Range scan_integers(const T* v, std::uint64_t begin, std::uint64_t end) {
  T lo = std::numeric_limits<T>::max(), hi = std::numeric_limits<T>::min();
  for (std::uint64_t i = begin; i < end; ++i) {
    lo = std::min(lo, v[i]);
    hi = std::max(hi, v[i]);
  }
  return {static_cast<double>(lo), static_cast<double>(hi), true};
}

Range scan_floats(const float* v, std::uint64_t begin, std::uint64_t end) {
  std::int32_t lo = std::numeric_limits<std::int32_t>::max(), hi = std::numeric_limits<std::int32_t>::min();
  std::int32_t magnitude = 0;
  for (std::uint64_t i = begin; i < end; ++i) {
    const std::int32_t bits = std::bit_cast<std::int32_t>(v[i]);
    lo = std::min(lo, ordered(bits));
    hi = std::max(hi, ordered(bits));
    magnitude = std::max(magnitude, bits & 0x7fffffff);
  }
  return {std::bit_cast<float>(ordered(lo)), std::bit_cast<float>(ordered(hi)), magnitude < infinity_bits};
}

template <class Scan>
Range scan_all(std::uint64_t count, Scan scan) {
  Range range;
  std::mutex guard;
  parallel_ranges(count, least_voxels, [&](std::uint64_t begin, std::uint64_t end) {
    const Range mine = scan(begin, end);
    const std::lock_guard lock(guard);
    range.lo = std::min(range.lo, mine.lo);
    range.hi = std::max(range.hi, mine.hi);
    range.finite = range.finite && mine.finite;
  });
  return range;
}

Range scan(const GridField& grid) {
  const auto run = [&]<class T>(const T* v) {
    return scan_all(grid.count(), [v](std::uint64_t b, std::uint64_t e) { return scan_integers(v, b, e); });
  };
  const void* voxels = grid.voxels.get();
  switch (grid.type) {
    case VoxelType::u8:
      return run(static_cast<const std::uint8_t*>(voxels));
    case VoxelType::i8:
      return run(static_cast<const std::int8_t*>(voxels));
    case VoxelType::u16:
      return run(static_cast<const std::uint16_t*>(voxels));
    case VoxelType::i16:
      return run(static_cast<const std::int16_t*>(voxels));
    case VoxelType::f32:
      break;
  }
  return scan_all(grid.count(), [v = static_cast<const float*>(voxels)](std::uint64_t b, std::uint64_t e) {
    return scan_floats(v, b, e);
  });
}

// The rare path: some voxel is NaN or Inf. The voxels may be shared with a file, so a copy is repaired.
void repair(GridField& grid, const std::string& nan_policy, double nan_value) {
  const auto* v = static_cast<const float*>(grid.voxels.get());
  const auto bad = [](float x) { return !std::isfinite(x); };
  if (nan_policy == "error") {
    const auto i = static_cast<std::uint64_t>(std::find_if(v, v + grid.count(), bad) - v);
    throw InputError(grid.source + ": " + voxel_text(grid.dims, i) + " is " + (std::isnan(v[i]) ? "NaN" : "infinite") +
                     "; clean the data or set data.nan_policy to \"replace\"");
  }
  const auto memory = allocate_voxels(grid.bytes(), grid.source);
  const auto stored = static_cast<float>((nan_value - grid.intercept) / grid.slope);
  std::replace_copy_if(v, v + grid.count(), static_cast<float*>(memory.get()), bad, stored);
  grid.notes.push_back(std::to_string(std::count_if(v, v + grid.count(), bad)) +
                       " voxels that are NaN or infinite were replaced by the value " + std::to_string(nan_value));
  grid.voxels = memory;
}

}  // namespace

void finish_grid(GridField& grid, const std::string& nan_policy, double nan_value) {
  grid_bytes({grid.dims[0], grid.dims[1], grid.dims[2]}, bytes_of(grid.type), grid.source);
  try {
    grid.to_world.inverse();
  } catch (const InputError& e) {
    throw InputError(grid.source + ": " + e.what());
  }
  grid.sampler = "grid";
  grid.voxel = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 3; ++c) {
    grid.lo[c] = 0;
    grid.hi[c] = grid.dims[c] - 1;
    const auto& m = grid.to_world.m;
    grid.voxel = std::min(grid.voxel, std::hypot(m[c], m[3 + c], m[6 + c]));
  }
  Range range = scan(grid);
  if (!range.finite) {
    repair(grid, nan_policy, nan_value);
    range = scan(grid);
  }
  grid.stored_min = range.lo;
  grid.stored_max = range.hi;
}

}  // namespace dvrlab
