// Small buffers that the scene stage makes.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/interfaces/kernel_unit.h"

namespace dvrlab {

template <class T>
Buffer make_buffer(std::string name, Element element, std::vector<T> values, std::uint64_t count) {
  auto owner = std::make_shared<std::vector<T>>(std::move(values));
  return {std::move(name), element, std::shared_ptr<const void>(owner, owner->data()), count};
}

/// Groups of four floats. An empty list has no binding on a GPU; the cpu finds one entry of zeros.
inline Buffer vec4_buffer(std::string name, std::vector<float> values) {
  const std::uint64_t count = values.size() / 4;
  if (values.empty()) values.assign(4, 0.0f);
  return make_buffer(std::move(name), Element::vec4, std::move(values), count);
}

}  // namespace dvrlab
