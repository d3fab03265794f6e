// Small buffers that the scene stage makes.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/interfaces/kernel_unit.h"

namespace dvrlab {

template <class T>
Buffer make_buffer(std::string name, Element element, std::vector<T> values, std::uint64_t count) {
  auto owner = std::make_shared<std::vector<T>>(std::move(values));
  return {std::move(name), element, std::shared_ptr<const void>(owner, owner->data()), count, nullptr};
}

/// Single numbers for kernels in fp32, where they are rounded, and in fp64. Without any there is no binding on a GPU;
/// the cpu finds two zeros.
inline Buffer real_buffer(std::string name, std::vector<double> values) {
  const std::uint64_t count = values.size();
  if (values.empty()) values.assign(2, 0.0);
  std::vector<float> rounded(values.size());
  std::transform(values.begin(), values.end(), rounded.begin(), [](double x) { return static_cast<float>(x); });
  Buffer buffer = make_buffer(std::move(name), Element::f32, std::move(rounded), count);
  const auto owner = std::make_shared<std::vector<double>>(std::move(values));
  buffer.data64 = {owner, owner->data()};
  return buffer;
}

/// Groups of four numbers for kernels in fp32 and in fp64; both lists have one length. An empty table has no
/// binding on a GPU; the cpu finds one entry of zeros.
inline Buffer vec4_buffer(std::string name, std::vector<float> rounded, std::vector<double> values) {
  const std::uint64_t count = values.size() / 4;
  if (values.empty()) {
    rounded.assign(4, 0.0f);
    values.assign(4, 0.0);
  }
  Buffer buffer = make_buffer(std::move(name), Element::vec4, std::move(rounded), count);
  const auto owner = std::make_shared<std::vector<double>>(std::move(values));
  buffer.data64 = {owner, owner->data()};
  return buffer;
}

/// The same, for tables whose fp32 values are the rounded ones.
inline Buffer vec4_buffer(std::string name, std::vector<double> values) {
  std::vector<float> rounded(values.size());
  std::transform(values.begin(), values.end(), rounded.begin(), [](double x) { return static_cast<float>(x); });
  return vec4_buffer(std::move(name), std::move(rounded), std::move(values));
}

}  // namespace dvrlab
