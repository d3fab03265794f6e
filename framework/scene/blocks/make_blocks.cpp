// Puts a grid into blocks: what they hold, and where it lies.
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include "framework/interfaces/error.h"
#include "framework/scene/blocks/block_levels.h"
#include "framework/scene/macrocells.h"
#include "framework/scene/parallel.h"
#include "framework/scene/sha256.h"

namespace dvrlab {
namespace {

std::array<int, 3> position(const BlockedField& f, std::size_t block) {
  const auto n = f.blocks;
  const int b = int(block);
  return {b % n[0], b / n[0] % n[1], b / (n[0] * n[1])};
}

template <class T>
T rounded(double x) {
  if constexpr (std::is_floating_point_v<T>) return static_cast<T>(x);
  return static_cast<T>(
      std::clamp(std::floor(x + 0.5), double(std::numeric_limits<T>::min()), double(std::numeric_limits<T>::max())));
}

/// Values that stand for dropped blocks, one of each block's range: as few as do. Which one, per dropped block.
std::vector<float> stand_ins(const std::vector<BlockErrors>& errors, const std::vector<int>& level,
                             std::vector<std::size_t>& which) {
  std::vector<std::size_t> order;
  for (std::size_t b = 0; b < errors.size(); ++b)
    if (level[b] == BlockedField::dropped) order.push_back(b);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return errors[a].hi < errors[b].hi; });
  std::vector<float> values;
  for (const std::size_t b : order) {
    if (values.empty() || values.back() < errors[b].lo) values.push_back(errors[b].hi);
    which[b] = values.size() - 1;
  }
  return values;
}

/// Where the blocks' samples lie. Returns how many there are, without the end of the last row.
std::uint64_t lay_out(BlockedField& f, const BlockChoice& choice, const std::vector<int>& level,
                      const std::vector<std::size_t>& which, std::size_t stand_in_count) {
  std::uint64_t next = 0;
  const auto take = [&](std::size_t block, int samples) {
    const std::uint64_t first = next;
    next += std::uint64_t(samples);
    if (next > std::uint64_t(std::numeric_limits<std::int32_t>::max()) - BlockedField::row)
      throw NotSupported("sampler flat_blocking: more than 2^31 samples; ask for a higher reduction");
    f.start.push_back(std::int32_t(first));
    const std::array<int, 3> p = position(f, block);
    f.owner.push_back(p[0] | p[1] << 10 | p[2] << 20);
    return std::int32_t(first);
  };
  std::vector<std::int32_t> shared(stand_in_count, -1);
  f.record.resize(level.size());
  for (std::size_t b = 0; b < level.size(); ++b) {
    if (level[b] != BlockedField::dropped) {
      f.record[b] = take(b, block_samples(choice, level[b])) + level[b];
      continue;
    }
    std::int32_t& first = shared[which[b]];
    if (first < 0) first = take(b, 8);
    f.record[b] = first + BlockedField::dropped;
  }
  constexpr std::uint64_t row = BlockedField::row;
  f.samples = std::max<std::uint64_t>((next + row - 1) / row, 2) * row;
  return next;
}

/// Calls visit(sample, x, y, z) for each sample of a block.
template <class Visit>
void each_sample(const BlockedField& f, std::size_t block, Visit visit) {
  const int n = f.count(f.level(block));
  std::size_t sample = f.first(block);
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) visit(sample++, x, y, z);
}

/// The block's own trilinear interpolation at a grid point inside it or on its faces.
template <class T>
double inside(const BlockedField& f, std::size_t block, const T* values, const std::array<int, 3>& point) {
  const int level = f.level(block), n = f.count(level), step = 1 << level;
  const std::array<int, 3> b = position(f, block);
  std::array<int, 3> i;
  std::array<double, 3> w;
  for (std::size_t a = 0; a < 3; ++a) {
    const int local = point[a] - b[a] * f.side;
    i[a] = std::min(local / step, n - 2);
    w[a] = double(local - i[a] * step) / step;
  }
  const T* v = values + f.first(block);
  const auto at = [&](int x, int y, int z) { return double(v[((i[2] + z) * n + i[1] + y) * n + i[0] + x]); };
  const auto along = [&](int y, int z) { return at(0, y, z) + w[0] * (at(1, y, z) - at(0, y, z)); };
  const double y0 = along(0, 0) + w[1] * (along(1, 0) - along(0, 0));
  const double y1 = along(0, 1) + w[1] * (along(1, 1) - along(0, 1));
  return y0 + w[2] * (y1 - y0);
}

/// The coarsest block, coarser than `block`, that shares a sample of it; `block` itself if there is none.
std::size_t governing(const BlockedField& f, std::size_t block, const std::array<int, 3>& local) {
  const int level = f.level(block), last = f.count(level) - 1;
  const std::array<int, 3> b = position(f, block);
  std::array<int, 3> from, to;
  for (std::size_t a = 0; a < 3; ++a) {
    from[a] = local[a] == 0 ? std::max(b[a] - 1, 0) : b[a];
    to[a] = local[a] == last ? std::min(b[a] + 1, f.blocks[a] - 1) : b[a];
  }
  std::size_t coarsest = block;
  for (int z = from[2]; z <= to[2]; ++z)
    for (int y = from[1]; y <= to[1]; ++y)
      for (int x = from[0]; x <= to[0]; ++x) {
        const std::size_t other = std::size_t((z * f.blocks[1] + y) * f.blocks[0] + x);
        if (f.level(other) != BlockedField::dropped && f.level(other) > f.level(coarsest)) coarsest = other;
      }
  return coarsest;
}

/// From coarse to fine, so that what is read is final.
template <class T>
void conform_values(const BlockedField& f, T* values) {
  if (f.border == BlockBorder::clamp) return;
  for (int level = levels_of(f.side) - 2; level >= 0; --level)
    parallel_ranges(f.record.size(), 16, [&](std::uint64_t begin, std::uint64_t end) {
      for (std::uint64_t block = begin; block < end; ++block) {
        if (f.level(block) != level) continue;
        const std::array<int, 3> b = position(f, block);
        const int last = f.count(level) - 1, step = 1 << level;
        const auto on_face = [&](int i) { return i == 0 || i == last; };
        each_sample(f, block, [&](std::size_t sample, int x, int y, int z) {
          if (!on_face(x) && !on_face(y) && !on_face(z)) return;
          const std::size_t other = governing(f, block, {x, y, z});
          if (other == block) return;
          const std::array<int, 3> point = {b[0] * f.side + x * step, b[1] * f.side + y * step,
                                            b[2] * f.side + z * step};
          values[sample] = rounded<T>(inside(f, other, values, point));
        });
      }
    });
}

/// Ranges of the values in 8^3 cells, as the blocks give them.
template <class T>
std::shared_ptr<const Macrocells> ranges(const BlockedField& f, const T* values) {
  auto m = std::make_shared<Macrocells>();
  for (std::size_t a = 0; a < 3; ++a) m->dims[a] = (f.dims[a] - 1 + 7) / 8;
  const std::size_t count = std::size_t(m->dims[0]) * std::size_t(m->dims[1]) * std::size_t(m->dims[2]);
  m->lo.assign(count, 3e38f);
  m->hi.assign(count, -3e38f);
  const bool shared = f.border == BlockBorder::interblock;
  // Of a block with its own samples any may be what a position near its border is clamped to.
  const auto add = [&](std::size_t cell, std::size_t block, const std::array<int, 3>& from) {
    const int level = f.level(block);
    const auto take = [&](T v) {
      m->lo[cell] = std::min(m->lo[cell], float(v));
      m->hi[cell] = std::max(m->hi[cell], float(v));
    };
    if (level == BlockedField::dropped) return take(values[f.first(block)]);
    const int step = 1 << level;
    const auto far = [&](std::size_t a, int i) {
      return shared && (i * step < from[a] - (step - 1) || i * step > from[a] + 8 + (step - 1));
    };
    each_sample(f, block, [&](std::size_t sample, int x, int y, int z) {
      if (!far(0, x) && !far(1, y) && !far(2, z)) take(values[sample]);
    });
  };
  const int per_block = f.side / 8;  // macrocells
  parallel_ranges(count, 1, [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t cell = begin; cell < end; ++cell) {
      const int c = int(cell);
      const std::array<int, 3> p = {c % m->dims[0], c / m->dims[0] % m->dims[1], c / (m->dims[0] * m->dims[1])};
      std::array<int, 3> to, from;
      for (std::size_t a = 0; a < 3; ++a) {
        to[a] = std::min((p[a] + (shared ? 0 : 1)) / per_block, f.blocks[a] - 1);
        from[a] = p[a] % per_block * 8;
      }
      for (int z = p[2] / per_block; z <= to[2]; ++z)
        for (int y = p[1] / per_block; y <= to[1]; ++y)
          for (int x = p[0] / per_block; x <= to[0]; ++x)
            add(cell, std::size_t((z * f.blocks[1] + y) * f.blocks[0] + x), from);
    }
  });
  return m;
}

template <class T>
void fill(BlockedField& f, const BlockPyramid& pyramid, const std::vector<float>& stand_in,
          const std::vector<std::size_t>& which) {
  const auto values = std::make_shared<std::vector<T>>(f.samples);
  parallel_ranges(f.record.size(), 16, [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t block = begin; block < end; ++block) {
      const int level = f.level(block);
      if (level == BlockedField::dropped) continue;
      const std::array<int, 3> b = position(f, block);
      const int n = f.side >> level;
      each_sample(f, block, [&](std::size_t sample, int x, int y, int z) {
        (*values)[sample] = rounded<T>(double(pyramid.at(level, b[0] * n + x, b[1] * n + y, b[2] * n + z)));
      });
    }
  });
  for (std::size_t block = 0; block < f.record.size(); ++block)
    if (f.level(block) == BlockedField::dropped)
      std::fill_n(values->begin() + std::ptrdiff_t(f.first(block)), 8, rounded<T>(double(stand_in[which[block]])));
  conform_values(f, values->data());
  f.macrocells = ranges(f, values->data());
  f.values = {values, values->data()};
}

void add_statistics(BlockedField& f, const std::vector<BlockErrors>& errors, const std::vector<int>& level,
                    double grid_points, std::uint64_t samples) {
  double square = 0, voxels = 0;
  std::array<int, BlockedField::dropped + 1> count{};
  for (std::size_t b = 0; b < level.size(); ++b) {
    ++count[std::size_t(level[b])];
    voxels += errors[b].visible;
    square += errors[b].square[std::size_t(level[b])];
  }
  f.statistics = {{"reduction", grid_points / double(samples)},
                  {"error_rms", voxels > 0 ? std::sqrt(square / voxels) : 0.0},
                  {"bytes", double(f.bytes())},
                  {"dropped", count[BlockedField::dropped]}};
  for (int l = 0; l < levels_of(f.side); ++l)
    f.statistics.emplace_back("level_" + std::to_string(l), count[std::size_t(l)]);
}

template <class T>
std::span<const std::byte> raw(const std::vector<T>& x) {
  return std::as_bytes(std::span(x));
}

std::string key_of(const BlockChoice& choice, const ArrangeInput& input) {
  std::vector<double> numbers = {double(choice.side),
                                 double(choice.border),
                                 choice.reduction,
                                 choice.tolerance,
                                 double(input.entries),
                                 input.lo,
                                 input.hi,
                                 double(input.cells),
                                 double(input.linear)};
  for (const OpaqueRange& o : input.medium.opaque) {
    numbers.insert(numbers.end(), {o.v0, o.v1});
    for (const auto* colors : {&o.P, &o.S, &o.W})
      for (const Vector3& c : *colors) numbers.insert(numbers.end(), c.begin(), c.end());
  }
  return sha256({raw(numbers), raw(input.medium.interval), raw(input.medium.dirac)});
}

}  // namespace

std::uint64_t BlockedField::bytes() const {
  constexpr std::array<std::uint64_t, 5> size = {1, 1, 2, 2, 4};
  return samples * size[std::size_t(type)] + (record.size() + start.size() + owner.size()) * sizeof(std::int32_t);
}

void conform(const BlockedField& blocked, float* values) { conform_values(blocked, values); }
void conform(const BlockedField& blocked, double* values) { conform_values(blocked, values); }

std::shared_ptr<const BlockedField> make_blocks(const GridField& grid, const BlockChoice& choice,
                                                const ArrangeInput& input) {
  const std::string key = key_of(choice, input);
  if (grid.blocked != nullptr && grid.blocked_key == key) return grid.blocked;
  grid.blocked = nullptr;  // before another one takes memory
  auto f = std::make_shared<BlockedField>();
  static_cast<Field&>(*f) = grid;
  f->dims = grid.dims;
  f->side = choice.side;
  f->border = choice.border;
  f->type = grid.type;
  for (std::size_t a = 0; a < 3; ++a) f->blocks[a] = (grid.dims[a] - 1) / choice.side + 1;
  if (*std::max_element(f->blocks.begin(), f->blocks.end()) > 1024)
    throw NotSupported("sampler flat_blocking: more than 1024 blocks along an axis; use larger ones");
  const BlockPyramid pyramid(grid, choice);
  const std::vector<BlockErrors> errors = block_errors(grid, pyramid, choice, BlockColors(input, grid.voxel), input);
  std::vector<int> level;
  std::vector<std::size_t> which(errors.size());
  std::vector<float> stand_in;
  // What stands for dropped blocks is kept, too: it is known once the levels are, and there are few of them.
  std::uint64_t before = std::numeric_limits<std::uint64_t>::max();
  for (std::uint64_t kept_back = 0;; kept_back += 8 * stand_in.size()) {
    level = choose_levels(errors, choice, grid.count(), kept_back);
    stand_in = stand_ins(errors, level, which);
    std::uint64_t sum = 8 * stand_in.size();
    for (const int l : level) sum += std::uint64_t(block_samples(choice, l));
    const bool fits = choice.reduction <= 1 || double(sum) * choice.reduction <= double(grid.count());
    if (fits || stand_in.empty() || sum >= before) break;
    before = sum;
  }
  const std::uint64_t samples = lay_out(*f, choice, level, which, stand_in.size());
  switch (grid.type) {
    case VoxelType::u8:
      fill<std::uint8_t>(*f, pyramid, stand_in, which);
      break;
    case VoxelType::i8:
      fill<std::int8_t>(*f, pyramid, stand_in, which);
      break;
    case VoxelType::u16:
      fill<std::uint16_t>(*f, pyramid, stand_in, which);
      break;
    case VoxelType::i16:
      fill<std::int16_t>(*f, pyramid, stand_in, which);
      break;
    case VoxelType::f32:
      fill<float>(*f, pyramid, stand_in, which);
      break;
  }
  add_statistics(*f, errors, level, double(grid.count()), samples);
  grid.blocked = f;
  grid.blocked_key = key;
  return f;
}

}  // namespace dvrlab
