// Blocks as kernels read them (framework/kernel/blocks.kernel).
#include <bit>

#include "framework/interfaces/blocks.h"
#include "framework/interfaces/kernel_unit.h"
#include "framework/scene/buffers.h"

namespace dvrlab {

void add_blocks(const BlockedField* blocked, KernelUnit& unit) {
  const std::array<int, 3> dims = blocked != nullptr ? blocked->dims : std::array{2, 2, 2};
  const std::array<int, 3> blocks = blocked != nullptr ? blocked->blocks : std::array{1, 1, 1};
  const int side = blocked != nullptr ? blocked->side : 16;
  const int on = blocked == nullptr ? 0 : blocked->border == BlockBorder::interblock ? 1 : 2;
  unit.uniforms.insert(unit.uniforms.end(),
                       {Uniform::constant_integer("blocks_on", on), Uniform::integer("blocks_nx", dims[0]),
                        Uniform::integer("blocks_ny", dims[1]), Uniform::integer("blocks_nz", dims[2]),
                        Uniform::integer("blocks_x", blocks[0]), Uniform::integer("blocks_y", blocks[1]),
                        Uniform::integer("blocks_z", blocks[2]), Uniform::constant_integer("blocks_side", side),
                        Uniform::constant_integer("blocks_log", std::countr_zero(unsigned(side))),
                        Uniform::real("blocks_inv_side", 1.0 / side),
                        Uniform::integer("blocks_stored", blocked != nullptr ? int(blocked->start.size()) : 1)});
  // Without blocks there is no binding on a GPU; the cpu finds a zero.
  const auto table = [&](const char* name, std::vector<int> values) {
    const std::uint64_t count = blocked != nullptr ? values.size() : 0;
    unit.buffers.push_back(make_buffer(name, Element::i32, std::move(values), count));
  };
  table("blocks_record", blocked != nullptr ? blocked->record : std::vector<int>{0});
  table("blocks_start", blocked != nullptr ? blocked->start : std::vector<int>{0});
  table("blocks_owner", blocked != nullptr ? blocked->owner : std::vector<int>{0});
}

}  // namespace dvrlab
