// Exact means of a medium over the bins of a regular grid of values: what cumulative and pre-integrated tables are made
// of.
#pragma once

#include <array>
#include <vector>

#include "framework/interfaces/medium.h"

namespace dvrlab {

using MediumColumns = std::array<double, medium_columns>;

/// The mean of every column over each of `bins` equal bins of [lo, hi], Dirac terms and opaque ranges left out.
std::vector<MediumColumns> bin_means(const Medium& medium, double lo, double hi, int bins);

/// The mean over each bin of (value - its bin's centre) in bins, times tau_s averaged over the channels: what moves the
/// barycentre of the surfaces in a bin away from its centre.
std::vector<double> bin_surface_offsets(const Medium& medium, double lo, double hi, int bins);

}  // namespace dvrlab
