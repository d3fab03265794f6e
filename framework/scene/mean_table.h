// The medium's cumulative tables as the kernels read them (framework/kernel/mean.kernel has the layout).
#pragma once

#include <cstdint>

#include "framework/interfaces/bin_medium.h"
#include "framework/interfaces/kernel_unit.h"

namespace dvrlab {

/// Bytes of the tables of `bins` bins of at most `groups` groups, and of the bins themselves.
std::uint64_t mean_table_bytes(int bins, int groups, bool fp64);

/// Adds the uniforms and the buffer mean_*. `bins` may be empty: then the kernels find an empty table. `barycentre`:
/// the last group of a bin is the surfaces' moment. `fp64`: of kernels in double; otherwise in float.
void add_means(const BinMedium& bins, bool barycentre, bool fp64, KernelUnit& unit);

}  // namespace dvrlab
