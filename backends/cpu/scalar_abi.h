// The kernel modules' C structures, chosen by the type of number: float, or double in precision fp64.
#pragma once

#include "framework/interfaces/kernel_module.h"

namespace dvrlab::cpu {

template <class Real>
struct ScalarAbi;

template <>
struct ScalarAbi<float> {
  using packet = dvr_packet;
  using chunk = dvr_chunk;
  using calls = dvr_calls;
  static constexpr auto init = &dvr_kernel_module::init;
};

template <>
struct ScalarAbi<double> {
  using packet = dvr_packet64;
  using chunk = dvr_chunk64;
  using calls = dvr_calls64;
  static constexpr auto init = &dvr_kernel_module::init64;
};

}  // namespace dvrlab::cpu
