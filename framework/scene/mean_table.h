// The medium's cumulative tables as the kernels read them (framework/kernel/mean.kernel has the layout).
#pragma once

#include "framework/scene/medium_table.h"

namespace dvrlab {

/// Adds the uniforms and the buffer mean_*: `bins` bins over [options.lo, options.hi], 0 for none.
void add_means(const Medium& medium, const MediumTableOptions& options, int bins, bool barycentre, KernelUnit& unit);

}  // namespace dvrlab
