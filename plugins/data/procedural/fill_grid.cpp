#include "plugins/data/procedural/fill_grid.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "framework/scene/parallel.h"
#include "framework/scene/voxels.h"

namespace dvrlab::procedural {
namespace {

// Evaluates all rows; returns the number of clamped voxels.
template <class T>
std::uint64_t fill(const FormulaParams& f, const GridField& grid, T* out) {
  const auto nx = static_cast<std::uint64_t>(grid.dims[0]), ny = static_cast<std::uint64_t>(grid.dims[1]);
  const double per_value = 1 / grid.slope;
  std::atomic<std::uint64_t> clamped = 0;
  parallel_ranges(grid.count() / nx, 16, [&](std::uint64_t begin, std::uint64_t end) {
    std::uint64_t mine = 0;
    for (std::uint64_t row = begin; row < end; ++row) {
      for (std::uint64_t i = 0; i < nx; ++i) {
        const Vector3 index{static_cast<double>(i), static_cast<double>(row % ny), static_cast<double>(row / ny)};
        const double v = value(f, grid.to_world.point(index));
        if constexpr (std::is_integral_v<T>) {
          constexpr double lo = std::numeric_limits<T>::min(), hi = std::numeric_limits<T>::max();
          const double stored = std::floor((v - grid.intercept) * per_value + 0.5);
          mine += stored < lo || stored > hi;
          out[row * nx + i] = static_cast<T>(std::fmin(std::fmax(stored, lo), hi));
        } else {
          out[row * nx + i] = static_cast<T>(v);
        }
      }
    }
    clamped += mine;
  });
  return clamped;
}

// Stored numbers of an integer type map linearly to `range`. A field of one value is stored as 0, exactly.
template <class T>
std::uint64_t fill_integers(const FormulaParams& f, const std::array<double, 2>& range, GridField& grid, T* out) {
  constexpr double lo = std::numeric_limits<T>::min(), hi = std::numeric_limits<T>::max();
  const bool single = range[0] == range[1];
  grid.slope = single ? 1 : (range[1] - range[0]) / (hi - lo);
  grid.intercept = single ? range[0] : range[0] - lo * grid.slope;
  return fill(f, grid, out);
}

}  // namespace

GridField fill_grid(const FormulaParams& f, const GridPlan& plan) {
  GridField grid;
  grid.dims = plan.dims;
  grid.type = plan.type;
  for (std::size_t a = 0; a < 3; ++a) {
    const double extent = plan.bounds.hi[a] - plan.bounds.lo[a];
    const double spacing = extent / (plan.cell_centres ? plan.dims[a] : plan.dims[a] - 1);
    grid.to_world.m[4 * a] = spacing;
    grid.to_world.t[a] = plan.bounds.lo[a] + (plan.cell_centres ? 0.5 * spacing : 0);
  }
  const auto memory = allocate_voxels(grid.bytes(), "procedural field");
  grid.voxels = memory;
  void* out = memory.get();
  std::uint64_t clamped = 0;
  switch (plan.type) {
    case VoxelType::u8:
      clamped = fill_integers(f, plan.range, grid, static_cast<std::uint8_t*>(out));
      break;
    case VoxelType::i8:
      clamped = fill_integers(f, plan.range, grid, static_cast<std::int8_t*>(out));
      break;
    case VoxelType::u16:
      clamped = fill_integers(f, plan.range, grid, static_cast<std::uint16_t*>(out));
      break;
    case VoxelType::i16:
      clamped = fill_integers(f, plan.range, grid, static_cast<std::int16_t*>(out));
      break;
    case VoxelType::f32:
      fill(f, grid, static_cast<float*>(out));
      break;
  }
  if (clamped) grid.notes.push_back(std::to_string(clamped) + " voxels lie outside `range` and were clamped to it");
  return grid;
}

}  // namespace dvrlab::procedural
