// A grid in blocks of their own level of detail (flat blocking: P. Ljung, C. Lundstroem, A. Ynnerman, K. Museth,
// Transfer Function Based Adaptive Decompression for Volume Rendering of Large Medical Data Sets, IEEE VolVis 2004).
// Kernels find samples by framework/kernel/blocks.kernel.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/interfaces/field.h"
#include "framework/interfaces/medium.h"

namespace dvrlab {

/// What becomes of samples at the border of two blocks. interblock: a block reaches to the first grid points of the
/// next ones, which both hold; what lies on a face towards a coarser block is that one's interpolation, so that nothing
/// jumps. clamp: a block holds what is its own, in the middle of what each sample stands for, and a position is clamped
/// to the first and the last one (Hernell et al. 2008, section 4).
enum class BlockBorder { interblock, clamp };

/// side^3 voxels at one of log2(side) + 1 levels: level l has (side >> l)^3 samples, with `interblock`
/// ((side >> l) + 1)^3.
struct BlockedField : Field {
  static constexpr int most_levels = 6;
  static constexpr int dropped = 7;  // as a level: nothing but one invisible value, shared by several blocks

  int side = 16;                       // 8, 16 or 32
  std::array<int, 3> dims{0, 0, 0};    // grid points of what was put into blocks
  std::array<int, 3> blocks{0, 0, 0};  // per axis
  BlockBorder border = BlockBorder::interblock;
  VoxelType type = VoxelType::u8;
  std::shared_ptr<const void> values;
  std::uint64_t samples = 0;         // a multiple of row
  std::vector<std::int32_t> record;  // per block, x fastest: first sample (a multiple of 8) + level
  /// Of what is stored, in order: the first sample, and its block, x + 1024 (y + 1024 z).
  std::vector<std::int32_t> start, owner;
  std::shared_ptr<const void> macrocells;
  /// reduction: grid points per sample; error_rms: of the colours of visible voxels, CIELUV; dropped,
  /// level_0, ...: blocks.
  std::vector<std::pair<std::string, double>> statistics;

  /// Volumes at the samples are filled in rows of so many.
  static constexpr int row = 1024;
  int level(std::size_t block) const { return record[block] & 7; }
  std::uint64_t first(std::size_t block) const { return std::uint64_t(record[block] & ~7); }
  /// Samples along each axis of a block of that level.
  int count(int level) const { return (side >> level) + (border == BlockBorder::interblock ? 1 : 0); }
  /// Values and tables.
  std::uint64_t bytes() const;
};

/// How the blocks' levels are chosen.
struct BlockChoice {
  int side = 16;  // voxels of a block along an axis: 8, 16 or 32
  BlockBorder border = BlockBorder::interblock;
  /// Grid points per sample that are wanted, 1: every block at full resolution, and none dropped; 0: by `tolerance`.
  double reduction = 0;
  /// Root mean square over the visible voxels of a block of the colours' differences, CIELUV: the coarsest level below
  /// it is taken.
  double tolerance = 1;
};

/// Levels of blocks of so many voxels along an axis.
inline int levels_of(int side) { return std::countr_zero(static_cast<unsigned>(side)) + 1; }

/// What a sampler that keeps a form of its own of the field is told of the case.
struct ArrangeInput {
  const Medium& medium;                       // of stored values
  int entries;                                // of its table
  double lo, hi;                              // stored values of the first and the last entry
  int cells;                                  // of the coarsest table that it is seen through, if coarser; 0: none
  std::function<bool(double, double)> empty;  // true where no value of a closed interval contributes anything
  bool linear;                                // colours are linear light, not display values
};

/// Puts a grid into blocks. Colours of a value are those of a slab of it, one voxel thick, unlit, over black and over
/// white; surfaces between two values count with their own colour. Throws NotSupported beyond 2^31 samples or 1024
/// blocks along an axis.
std::shared_ptr<const BlockedField> make_blocks(const GridField& grid, const BlockChoice& choice,
                                                const ArrangeInput& input);

/// With BlockBorder::interblock: gives the samples on faces towards coarser blocks the interpolation of those.
/// `values` has `blocked.samples` numbers.
void conform(const BlockedField& blocked, float* values);
void conform(const BlockedField& blocked, double* values);

/// Uniforms and tables blocks_*; without blocks those that say so.
void add_blocks(const BlockedField* blocked, KernelUnit& unit);

}  // namespace dvrlab
