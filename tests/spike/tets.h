// A block of boxes, each cut into six tetrahedra, as the buffers of the spike_tets sampler.
#pragma once

#include <functional>
#include <memory>

#include "framework/interfaces/field.h"

namespace dvrlab::spike {

struct TetBlock {
  Vector3 lo, hi;
  std::array<int, 3> boxes;
  std::function<double(const Vector3&)> value;                                   // at the vertices
  std::function<bool(int, int, int)> keep = [](int, int, int) { return true; };  // false: a hole
};

std::shared_ptr<const Field> make_tets(const TetBlock& block);

}  // namespace dvrlab::spike
