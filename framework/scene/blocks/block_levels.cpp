#include "framework/scene/blocks/block_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/scene/parallel.h"

namespace dvrlab {
namespace {

constexpr int side = BlockedField::side, levels = BlockedField::levels;

/// Where a voxel of a block lies between two samples of a level, along one axis.
struct Between {
  int i;
  float w;
};
std::array<Between, side> between_samples(BlockBorder border, int level) {
  std::array<Between, side> r;
  const int step = 1 << level, count = side >> level;
  for (int k = 0; k < side; ++k) {
    if (border == BlockBorder::interblock) {
      r[std::size_t(k)] = {k / step, float(k % step) / float(step)};
      continue;
    }
    const float q = std::clamp((float(k) + 0.5f) / float(step) - 0.5f, 0.0f, float(count - 1));
    const int i = std::min(int(q), std::max(count - 2, 0));
    r[std::size_t(k)] = {i, q - float(i)};
  }
  return r;
}

float lerp(float a, float b, float w) { return a + w * (b - a); }

class BlockJudge {
 public:
  BlockJudge(const GridField& grid, const BlockPyramid& pyramid, BlockBorder border, const BlockColors& colors)
      : grid_(grid), pyramid_(pyramid), border_(border), colors_(colors) {
    for (int l = 1; l < levels; ++l) between_[std::size_t(l)] = between_samples(border, l);
  }

  BlockErrors judge(const std::array<int, 3>& block, const ArrangeInput& input) {
    BlockErrors e;
    range(block, e);
    if (input.empty(double(e.lo), double(e.hi))) return e;
    for (int l = 1; l < levels; ++l) e.square[std::size_t(l)] = square(block, l);
    drop(input, e);
    return e;
  }

 private:
  /// The block's voxels, and with shared faces those on the next blocks' first ones.
  void range(const std::array<int, 3>& block, BlockErrors& e) {
    e.lo = 3e38f;
    e.hi = -3e38f;
    const int more = border_ == BlockBorder::interblock ? 1 : 0;
    std::array<int, 3> last;
    for (std::size_t a = 0; a < 3; ++a) {
      here_[a] = std::min(side, grid_.dims[a] - block[a] * side);
      last[a] = std::min(side + more, grid_.dims[a] - block[a] * side);
    }
    for (int z = 0; z < last[2]; ++z)
      for (int y = 0; y < last[1]; ++y)
        for (int x = 0; x < last[0]; ++x) {
          const float v = pyramid_.at(0, block[0] * side + x, block[1] * side + y, block[2] * side + z);
          e.lo = std::min(e.lo, v);
          e.hi = std::max(e.hi, v);
          if (x == side || y == side || z == side) continue;
          voxel_[std::size_t((z * side + y) * side + x)] = v;
          if (colors_.visible(v)) ++e.visible;
        }
  }

  /// Of a block that is not empty: an invisible value of its own stands for it.
  void drop(const ArrangeInput& input, BlockErrors& e) {
    e.square[levels] = 1e300;
    const auto inside = [&](auto visit) {
      for (int z = 0; z < here_[2]; ++z)
        for (int y = 0; y < here_[1]; ++y)
          for (int x = 0; x < here_[0]; ++x) visit(voxel_[std::size_t((z * side + y) * side + x)]);
    };
    bool found = false;
    inside([&](float v) {
      if (found || colors_.visible(v) || !input.empty(double(v), double(v))) return;
      found = true;
      e.lo = e.hi = v;
    });
    if (!found) return;
    e.square[levels] = 0;
    inside([&](float v) { e.square[levels] += colors_.square(v, e.lo); });
  }

  double square(const std::array<int, 3>& block, int level) {
    const int count = (side >> level) + (border_ == BlockBorder::interblock ? 1 : 0);
    for (int z = 0; z < count; ++z)
      for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x)
          sample_[std::size_t((z * count + y) * count + x)] = pyramid_.at(
              level, block[0] * (side >> level) + x, block[1] * (side >> level) + y, block[2] * (side >> level) + z);
    const auto& b = between_[std::size_t(level)];
    // The next sample; where there is one only, itself.
    const int dx = count > 1 ? 1 : 0, dy = dx * count, dz = dy * count;
    double sum = 0;
    for (int z = 0; z < here_[2]; ++z)
      for (int y = 0; y < here_[1]; ++y) {
        const Between bz = b[std::size_t(z)], by = b[std::size_t(y)];
        for (int x = 0; x < here_[0]; ++x) {
          const Between bx = b[std::size_t(x)];
          const float* s = sample_.data() + (bz.i * count + by.i) * count + bx.i;
          const float y0 = lerp(lerp(s[0], s[dx], bx.w), lerp(s[dy], s[dy + dx], bx.w), by.w);
          const float y1 = lerp(lerp(s[dz], s[dz + dx], bx.w), lerp(s[dz + dy], s[dz + dy + dx], bx.w), by.w);
          sum += colors_.square(voxel_[std::size_t((z * side + y) * side + x)], lerp(y0, y1, bz.w));
        }
      }
    return sum;
  }

  const GridField& grid_;
  const BlockPyramid& pyramid_;
  BlockBorder border_;
  const BlockColors& colors_;
  std::array<std::array<Between, side>, levels> between_;
  std::array<int, 3> here_{};  // voxels of the block that the grid has
  std::array<float, side * side * side> voxel_;
  std::array<float, 9 * 9 * 9> sample_;
};

/// Over the voxels that are seen, so that a little matter in an empty block counts.
double rms(const BlockErrors& e, int level) { return std::sqrt(e.square[std::size_t(level)] / std::max(e.visible, 1)); }

/// The levels that are best when a sample costs `price`, and their samples.
std::uint64_t at_price(const std::vector<BlockErrors>& blocks, BlockBorder border, double price,
                       std::vector<int>& out) {
  std::uint64_t samples = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    double least = 1e300;
    for (int l = 0; l <= levels; ++l) {
      const double cost = blocks[b].square[std::size_t(l)] + price * block_samples(border, l);
      if (!(cost <= least)) continue;
      least = cost;
      out[b] = l;
    }
    samples += std::uint64_t(block_samples(border, out[b]));
  }
  return samples;
}

void spend_rest(const std::vector<BlockErrors>& blocks, BlockBorder border, std::uint64_t rest, std::vector<int>& out) {
  struct Finer {
    std::size_t block;
    int level;
    double gain;  // per sample
  };
  const auto more = [&](std::size_t b, int level) {
    return block_samples(border, level) - block_samples(border, out[b]);
  };
  std::vector<Finer> finer;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int l = 0; l < out[b]; ++l) {
      const auto& s = blocks[b].square;
      const double gain = (s[std::size_t(out[b])] - s[std::size_t(l)]) / more(b, l);
      if (gain > 0) finer.push_back({b, l, gain});
    }
  std::stable_sort(finer.begin(), finer.end(), [](const Finer& a, const Finer& b) { return a.gain > b.gain; });
  for (const Finer& f : finer) {
    if (f.level >= out[f.block] || std::uint64_t(more(f.block, f.level)) > rest) continue;
    rest -= std::uint64_t(more(f.block, f.level));
    out[f.block] = f.level;
  }
}

}  // namespace

int block_samples(BlockBorder border, int level) {
  if (level == BlockedField::dropped) return 0;
  const int n = (side >> level) + (border == BlockBorder::interblock ? 1 : 0);
  return (n * n * n + 7) / 8 * 8;
}

std::vector<BlockErrors> block_errors(const GridField& grid, const BlockPyramid& pyramid, BlockBorder border,
                                      const BlockColors& colors, const ArrangeInput& input) {
  std::array<int, 3> n;
  for (std::size_t a = 0; a < 3; ++a) n[a] = (grid.dims[a] - 1) / side + 1;
  std::vector<BlockErrors> errors;
  errors.resize(std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]));
  parallel_ranges(errors.size(), 1, [&](std::uint64_t begin, std::uint64_t end) {
    BlockJudge judge(grid, pyramid, border, colors);
    for (std::uint64_t b = begin; b < end; ++b) {
      const int i = int(b);
      errors[b] = judge.judge({i % n[0], i / n[0] % n[1], i / (n[0] * n[1])}, input);
    }
  });
  return errors;
}

std::vector<int> choose_levels(const std::vector<BlockErrors>& blocks, const BlockChoice& choice,
                               std::uint64_t grid_points) {
  std::vector<int> out(blocks.size(), BlockedField::dropped);
  if (choice.reduction == 1) return std::vector<int>(blocks.size(), 0);
  if (choice.reduction == 0) {
    for (std::size_t b = 0; b < blocks.size(); ++b)
      while (rms(blocks[b], out[b]) > choice.tolerance && out[b] > 0) --out[b];
    return out;
  }
  const auto budget = std::uint64_t(double(grid_points) / choice.reduction);
  std::uint64_t used = at_price(blocks, choice.border, 0, out);
  if (used <= budget) return out;
  double low = 1e-9, high = 1e9;
  for (int k = 0; k < 100; ++k) {
    const double middle = std::sqrt(low * high);
    (at_price(blocks, choice.border, middle, out) <= budget ? high : low) = middle;
  }
  used = at_price(blocks, choice.border, high, out);
  if (used < budget) spend_rest(blocks, choice.border, budget - used, out);
  return out;
}

}  // namespace dvrlab
