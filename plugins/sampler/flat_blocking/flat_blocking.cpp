// The `flat_blocking` sampler: a voxel grid in blocks of their own level of detail, chosen by the transfer functions.
#include <algorithm>

#include "framework/interfaces/blocks.h"
#include "framework/interfaces/error.h"
#include "framework/scene/blocks/block_levels.h"

namespace dvrlab::flat_blocking {
namespace {

using enum ParameterType;
constexpr Affects pixels = Affects::pixels;

const Parameter parameters[] = {
    {"levels", choice, "", "\"reduction\"", "reduction|tolerance", "What the blocks' levels are chosen by.", pixels,
     R"({"sampler":{"reduction":null}})", "\"tolerance\""},
    {"reduction", number, "grid points per sample", "8.9", "[1,500]",
     "How much less is kept, with the least error of the colours; 1: everything, the grid itself.", pixels, "", "12",
     "levels=reduction"},
    {"tolerance", number, "CIELUV", "1", "[0,inf)",
     "Largest error of the colours of a block's visible voxels, root mean square; 1 is a just noticeable difference.",
     pixels, R"({"sampler":{"levels":"tolerance","reduction":null}})", "8", "levels=tolerance"},
    {"block", integer, "voxel", "16", "[8,32]",
     "Side of a block, 8, 16 or 32: small ones follow fine structures, large ones share less of their faces.", pixels,
     "", "8"},
    {"block_border", choice, "", "\"interblock\"", "interblock|clamp",
     "interblock: continuous across blocks; clamp: each block alone, its positions clamped to its samples (the "
     "paper's).",
     pixels, "", "\"clamp\""},
};

constexpr Element element_of[] = {Element::u8, Element::i8, Element::u16, Element::i16, Element::f32};  // of VoxelType

class FlatBlocking : public SamplerPlugin {
 public:
  void check(const ParameterSet& p) const override {
    const long long side = p.integer("block");
    if (side != 8 && side != 16 && side != 32)
      throw InputError(p.path_of("block") + ": found " + std::to_string(side) + "; must be 8, 16 or 32");
  }
  std::uint64_t most_samples(const Field& field, const ParameterSet& p) const override {
    const BlockChoice choice = choice_of(p);
    // All of it, with shared faces, whole blocks at the grid's ends.
    double samples = block_samples(choice, 0);
    for (const int n : grid_of(field).dims) samples *= (n - 1) / choice.side + 1;
    if (choice.reduction > 1)
      samples = std::min(samples, static_cast<double>(grid_of(field).count()) / choice.reduction);
    return static_cast<std::uint64_t>(samples);
  }
  std::uint64_t bytes_needed(const Field& field, const ParameterSet& p) const override {
    const GridField& grid = grid_of(field);
    return most_samples(field, p) * (grid.bytes() / grid.count()) + BlockPyramid::bytes(grid.dims, choice_of(p));
  }
  std::shared_ptr<const BlockedField> arrange(const Field& field, const ParameterSet& p,
                                              const ArrangeInput& input) const override {
    return make_blocks(grid_of(field), choice_of(p), input);
  }
  KernelUnit bind(const Field& field) const override {
    const auto& f = dynamic_cast<const BlockedField&>(field);
    KernelUnit unit;
    // As the grid sampler: world gradients by the inverse transposed, normals follow the physical value.
    const Affine inverse = f.to_world.inverse();
    const double sign = f.slope < 0 ? -1.0 : 1.0;
    const char* names[] = {"flat_blocking_gradient_x", "flat_blocking_gradient_y", "flat_blocking_gradient_z"};
    for (std::size_t r = 0; r < 3; ++r)
      unit.uniforms.push_back(
          Uniform::vector(names[r], sign * inverse.m[r], sign * inverse.m[3 + r], sign * inverse.m[6 + r]));
    const bool whole = f.border == BlockBorder::interblock &&
                       std::all_of(f.record.begin(), f.record.end(), [](std::int32_t r) { return (r & 7) == 0; });
    unit.uniforms.push_back(Uniform::constant_integer("flat_blocking_whole", whole ? 1 : 0));
    unit.buffers = {Buffer{"flat_blocking_voxels", element_of[static_cast<std::size_t>(f.type)], f.values, f.samples}};
    return unit;
  }

 private:
  static BlockChoice choice_of(const ParameterSet& p) {
    BlockChoice choice;
    choice.side = static_cast<int>(p.integer("block"));
    choice.border = static_cast<BlockBorder>(p.choice_index("block_border"));
    const bool by_reduction = p.text("levels") == "reduction";
    choice.reduction = by_reduction ? p.number("reduction") : 0;
    choice.tolerance = by_reduction ? 0 : p.number("tolerance");
    return choice;
  }
  static const GridField& grid_of(const Field& field) {
    const auto* grid = dynamic_cast<const GridField*>(&field);
    if (grid == nullptr)
      throw InputError("sampler.type: \"flat_blocking\" puts voxel grids into blocks; " + field.source +
                       " is none, leave out the section sampler");
    return *grid;
  }
};

}  // namespace

DVRLAB_PLUGIN("sampler", "flat_blocking", "1.0", FlatBlocking, parameters,
              "a voxel grid in blocks at levels of detail chosen by the transfer functions",
              "P. Ljung, C. Lundstroem, A. Ynnerman, K. Museth, Transfer Function Based Adaptive Decompression for "
              "Volume Rendering of Large Medical Data Sets, IEEE Symposium on Volume Visualization 2004, "
              "doi:10.1109/SVVG.2004.14")

}  // namespace dvrlab::flat_blocking
