#include "framework/scene/blocks/block_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "framework/scene/parallel.h"

namespace dvrlab {
namespace {

/// Where a voxel of a block lies between two samples of a level, along one axis.
struct Between {
  int i;
  float w;
};
std::vector<Between> between_samples(const BlockChoice& choice, int level) {
  std::vector<Between> r;
  const int step = 1 << level, count = choice.side >> level;
  for (int k = 0; k <= choice.side; ++k) {
    if (choice.border == BlockBorder::interblock) {
      const int i = std::min(k / step, count - 1);
      r.push_back({i, float(k - i * step) / float(step)});
      continue;
    }
    const float q = std::clamp((float(k) + 0.5f) / float(step) - 0.5f, 0.0f, float(count - 1));
    const int i = std::min(int(q), std::max(count - 2, 0));
    r.push_back({i, q - float(i)});
  }
  return r;
}

float lerp(float a, float b, float w) { return a + w * (b - a); }

class BlockJudge {
 public:
  BlockJudge(const GridField& grid, const BlockPyramid& pyramid, const BlockChoice& choice, const BlockColors& colors)
      : grid_(grid),
        pyramid_(pyramid),
        side_(choice.side),
        shared_(choice.border == BlockBorder::interblock),
        colors_(colors) {
    for (int l = 1; l < levels_of(side_); ++l) between_[std::size_t(l)] = between_samples(choice, l);
    voxel_.resize(std::size_t((side_ + 1) * (side_ + 1) * (side_ + 1)));
    sample_.resize(std::size_t((side_ / 2 + 1) * (side_ / 2 + 1) * (side_ / 2 + 1)));
  }

  BlockErrors judge(const std::array<int, 3>& block, const ArrangeInput& input) {
    BlockErrors e;
    range(block, e);
    if (input.empty(double(e.lo), double(e.hi))) return e;
    for (int l = 1; l < levels_of(side_); ++l) e.square[std::size_t(l)] = square(block, l);
    drop(input, e);
    return e;
  }

 private:
  /// The block's voxels. With shared faces those on the next blocks' first ones too: its last cells end there.
  void range(const std::array<int, 3>& block, BlockErrors& e) {
    e.lo = 3e38f;
    e.hi = -3e38f;
    for (std::size_t a = 0; a < 3; ++a)
      here_[a] = std::min(side_ + (shared_ ? 1 : 0), grid_.dims[a] - block[a] * side_);
    each_voxel([&](float& v, int x, int y, int z) {
      v = pyramid_.at(0, block[0] * side_ + x, block[1] * side_ + y, block[2] * side_ + z);
      e.lo = std::min(e.lo, v);
      e.hi = std::max(e.hi, v);
      if (colors_.visible(v)) ++e.visible;
    });
  }

  template <class Visit>
  void each_voxel(Visit visit) {
    for (int z = 0; z < here_[2]; ++z)
      for (int y = 0; y < here_[1]; ++y)
        for (int x = 0; x < here_[0]; ++x) visit(voxel_[std::size_t((z * (side_ + 1) + y) * (side_ + 1) + x)], x, y, z);
  }

  /// Of a block that is not empty: an invisible value of its own stands for it.
  void drop(const ArrangeInput& input, BlockErrors& e) {
    e.square[BlockedField::dropped] = 1e300;
    bool found = false;
    each_voxel([&](float v, int, int, int) {
      if (found || colors_.visible(v) || !input.empty(double(v), double(v))) return;
      found = true;
      e.lo = e.hi = v;
    });
    if (!found) return;
    e.square[BlockedField::dropped] = 0;
    each_voxel([&](float v, int, int, int) { e.square[BlockedField::dropped] += colors_.square(v, e.lo); });
  }

  double square(const std::array<int, 3>& block, int level) {
    const int count = (side_ >> level) + (shared_ ? 1 : 0);
    for (int z = 0; z < count; ++z)
      for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x)
          sample_[std::size_t((z * count + y) * count + x)] = pyramid_.at(
              level, block[0] * (side_ >> level) + x, block[1] * (side_ >> level) + y, block[2] * (side_ >> level) + z);
    const auto& b = between_[std::size_t(level)];
    // The next sample; where there is one only, itself.
    const int dx = count > 1 ? 1 : 0, dy = dx * count, dz = dy * count;
    double sum = 0;
    each_voxel([&](float v, int x, int y, int z) {
      const Between bx = b[std::size_t(x)], by = b[std::size_t(y)], bz = b[std::size_t(z)];
      const float* s = sample_.data() + (bz.i * count + by.i) * count + bx.i;
      const float y0 = lerp(lerp(s[0], s[dx], bx.w), lerp(s[dy], s[dy + dx], bx.w), by.w);
      const float y1 = lerp(lerp(s[dz], s[dz + dx], bx.w), lerp(s[dz + dy], s[dz + dy + dx], bx.w), by.w);
      sum += colors_.square(v, lerp(y0, y1, bz.w));
    });
    return sum;
  }

  const GridField& grid_;
  const BlockPyramid& pyramid_;
  int side_;
  bool shared_;
  const BlockColors& colors_;
  std::array<std::vector<Between>, BlockedField::most_levels> between_;
  std::array<int, 3> here_{};  // voxels of the block that the grid has
  std::vector<float> voxel_, sample_;
};

/// Over the voxels that are seen, so that a little matter in an empty block counts.
double rms(const BlockErrors& e, int level) { return std::sqrt(e.square[std::size_t(level)] / std::max(e.visible, 1)); }

/// From one level to the next, from the coarsest to none.
int coarser(const BlockChoice& choice, int level) {
  return level + 1 == levels_of(choice.side) ? BlockedField::dropped : level + 1;
}

/// The levels that are best when a sample costs `price`, and their samples.
std::uint64_t at_price(const std::vector<BlockErrors>& blocks, const BlockChoice& choice, double price,
                       std::vector<int>& out) {
  std::uint64_t samples = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    double least = 1e300;
    for (int l = 0; l <= BlockedField::dropped; l = coarser(choice, l)) {
      const double cost = blocks[b].square[std::size_t(l)] + price * block_samples(choice, l);
      if (!(cost <= least)) continue;
      least = cost;
      out[b] = l;
    }
    samples += std::uint64_t(block_samples(choice, out[b]));
  }
  return samples;
}

void spend_rest(const std::vector<BlockErrors>& blocks, const BlockChoice& choice, std::uint64_t rest,
                std::vector<int>& out) {
  struct Finer {
    std::size_t block;
    int level;
    double gain;  // per sample
  };
  const auto more = [&](std::size_t b, int level) {
    return block_samples(choice, level) - block_samples(choice, out[b]);
  };
  std::vector<Finer> finer;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    for (int l = 0; l < out[b]; l = coarser(choice, l)) {
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

int block_samples(const BlockChoice& choice, int level) {
  if (level == BlockedField::dropped) return 0;
  const int n = (choice.side >> level) + (choice.border == BlockBorder::interblock ? 1 : 0);
  return (n * n * n + 7) / 8 * 8;
}

std::vector<BlockErrors> block_errors(const GridField& grid, const BlockPyramid& pyramid, const BlockChoice& choice,
                                      const BlockColors& colors, const ArrangeInput& input) {
  std::array<int, 3> n;
  for (std::size_t a = 0; a < 3; ++a) n[a] = (grid.dims[a] - 1) / choice.side + 1;
  std::vector<BlockErrors> errors;
  errors.resize(std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]));
  parallel_ranges(errors.size(), 1, [&](std::uint64_t begin, std::uint64_t end) {
    BlockJudge judge(grid, pyramid, choice, colors);
    for (std::uint64_t b = begin; b < end; ++b) {
      const int i = int(b);
      errors[b] = judge.judge({i % n[0], i / n[0] % n[1], i / (n[0] * n[1])}, input);
    }
  });
  return errors;
}

std::vector<int> choose_levels(const std::vector<BlockErrors>& blocks, const BlockChoice& choice,
                               std::uint64_t grid_points, std::uint64_t kept_back) {
  std::vector<int> out(blocks.size(), BlockedField::dropped);
  if (choice.reduction == 1) return std::vector<int>(blocks.size(), 0);
  if (choice.reduction == 0) {
    for (std::size_t b = 0; b < blocks.size(); ++b)
      while (rms(blocks[b], out[b]) > choice.tolerance && out[b] > 0)
        out[b] = out[b] == BlockedField::dropped ? levels_of(choice.side) - 1 : out[b] - 1;
    return out;
  }
  const auto wanted = std::uint64_t(double(grid_points) / choice.reduction);
  const std::uint64_t budget = wanted - std::min(wanted, kept_back);
  std::uint64_t used = at_price(blocks, choice, 0, out);
  if (used <= budget) return out;
  double low = 1e-9, high = 1e9;
  for (int k = 0; k < 100; ++k) {
    const double middle = std::sqrt(low * high);
    (at_price(blocks, choice, middle, out) <= budget ? high : low) = middle;
  }
  used = at_price(blocks, choice, high, out);
  if (used < budget) spend_rest(blocks, choice, budget - used, out);
  return out;
}

}  // namespace dvrlab
