// Exact means of a medium over the bins of a regular grid of values.
#pragma once

#include "framework/interfaces/bin_medium.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

/// The groups of `layout` averaged over `bins` bins of [lo, hi], Dirac terms and opaque ranges left out. `barycentre`
/// adds one more group, averaged over the channels: (x tau_s, tau_s, 0, 0), x the place in bins from lo.
BinMedium bin_groups(const Medium& medium, const MediumLayout& layout, double lo, double hi, int bins, bool barycentre);

}  // namespace dvrlab
