#include "framework/scene/macrocells.h"

#include <algorithm>

namespace dvrlab {

namespace {
constexpr int side = 8;  // cells, as framework/kernel/steps.kernel assumes

template <class T>
void scan(const GridField& grid, Macrocells& m) {
  const T* voxel = static_cast<const T*>(grid.voxels.get());
  const auto& n = grid.dims;
  const auto cells = [&](int i, int axis) {  // first and last macrocell that hold grid point i
    const std::size_t a = std::size_t(axis);
    return std::array<int, 2>{std::clamp((i - 1) / side, 0, m.dims[a] - 1), std::min(i / side, m.dims[a] - 1)};
  };
  std::vector<float> row_lo(std::size_t(m.dims[0])), row_hi(std::size_t(m.dims[0]));
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      const T* row = voxel + (std::size_t(k) * std::size_t(n[1]) + std::size_t(j)) * std::size_t(n[0]);
      for (int mx = 0; mx < m.dims[0]; ++mx) {
        const auto [lo, hi] = std::minmax_element(row + mx * side, row + std::min((mx + 1) * side + 1, n[0]));
        row_lo[std::size_t(mx)] = float(*lo);
        row_hi[std::size_t(mx)] = float(*hi);
      }
      const auto ys = cells(j, 1), zs = cells(k, 2);
      for (int mz = zs[0]; mz <= zs[1]; ++mz) {
        for (int my = ys[0]; my <= ys[1]; ++my) {
          const std::size_t first =
              (std::size_t(mz) * std::size_t(m.dims[1]) + std::size_t(my)) * std::size_t(m.dims[0]);
          for (std::size_t mx = 0; mx < row_lo.size(); ++mx) {
            m.lo[first + mx] = std::min(m.lo[first + mx], row_lo[mx]);
            m.hi[first + mx] = std::max(m.hi[first + mx], row_hi[mx]);
          }
        }
      }
    }
  }
}
}  // namespace

std::uint64_t skipping_bytes(const std::array<int, 3>& dims) {
  std::uint64_t count = 1;
  for (const int n : dims) count *= std::uint64_t((n - 1 + side - 1) / side);
  return count * (2 * sizeof(float) + sizeof(std::uint8_t));
}

std::shared_ptr<const Macrocells> macrocells_of(const GridField& grid) {
  if (grid.macrocells) return std::static_pointer_cast<const Macrocells>(grid.macrocells);
  auto m = std::make_shared<Macrocells>();
  for (std::size_t a = 0; a < 3; ++a) m->dims[a] = (grid.dims[a] - 1 + side - 1) / side;
  const std::size_t count = std::size_t(m->dims[0]) * std::size_t(m->dims[1]) * std::size_t(m->dims[2]);
  m->lo.assign(count, 3e38f);
  m->hi.assign(count, -3e38f);
  switch (grid.type) {
    case VoxelType::u8:
      scan<std::uint8_t>(grid, *m);
      break;
    case VoxelType::i8:
      scan<std::int8_t>(grid, *m);
      break;
    case VoxelType::u16:
      scan<std::uint16_t>(grid, *m);
      break;
    case VoxelType::i16:
      scan<std::int16_t>(grid, *m);
      break;
    case VoxelType::f32:
      scan<float>(grid, *m);
      break;
  }
  grid.macrocells = m;
  return m;
}

std::vector<std::uint8_t> empty_distance(const Macrocells& cells, const OccupiedBins& bins) {
  const auto [nx, ny, nz] = cells.dims;
  std::vector<std::uint8_t> d(cells.lo.size());
  for (std::size_t c = 0; c < d.size(); ++c) d[c] = bins.empty(cells.lo[c], cells.hi[c]) ? 255 : 0;
  // Two raster passes over the 26 neighbours give the exact Chebyshev distance.
  const auto relax = [&, nx = nx, ny = ny, nz = nz](int x, int y, int z, int sign) {
    std::uint8_t& here = d[(std::size_t(z) * std::size_t(ny) + std::size_t(y)) * std::size_t(nx) + std::size_t(x)];
    for (int k = -1; k <= 1; ++k) {
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          if ((k * 9 + j * 3 + i) * sign >= 0) continue;
          const int a = x + i, b = y + j, c = z + k;
          if (a < 0 || b < 0 || c < 0 || a >= nx || b >= ny || c >= nz) continue;
          const int there = d[(std::size_t(c) * std::size_t(ny) + std::size_t(b)) * std::size_t(nx) + std::size_t(a)];
          here = std::uint8_t(std::min<int>(here, there + 1));
        }
      }
    }
  };
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) relax(x, y, z, 1);
  for (int z = nz - 1; z >= 0; --z)
    for (int y = ny - 1; y >= 0; --y)
      for (int x = nx - 1; x >= 0; --x) relax(x, y, z, -1);
  return d;
}

}  // namespace dvrlab
