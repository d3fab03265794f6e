// How far a table is from its definition, in units of what fp64 states stored as fp32 may be.
#pragma once

#include <functional>
#include <string>

#include "plugins/estimator/preintegrated/definition.h"
#include "plugins/estimator/preintegrated/table_build.h"

namespace dvrlab::test {

using preintegrated::approximate_entry;
using preintegrated::Approximation;
using preintegrated::Cells;
using preintegrated::defined_entry;
using preintegrated::Entry;
using preintegrated::SourceColumn;
using preintegrated::TableRequest;

/// One channel of the entry from grid value i to grid value j.
using EntryOf = std::function<double(int i, int j, int output)>;
EntryOf entries_of(const preintegrated::Table& table);

/// The largest |x - x_def| / (2^-24 |x_def| + 3 n 2^-53 scale) over all entries and outputs of a table of C, B and T (6
/// n for C_2, 9 n for C_3); at most 1 for a right one. 2^-24 is the rounding to fp32, 3 n 2^-53 the bound of the slide
/// (docs/math, B5); scale is the largest |x_def| of the output. Infinite when there is a NaN.
double worst_error(const EntryOf& entry, const Cells& cells, const TableRequest& request, double h);

/// The same for a table of ratios, of ratio * C_approx, where C_approx (docs/math, B2) is not below 1e-7 of its largest
/// value; there a ratio may be 2^-24 relative wrong, and 1e-9 of scale. Below, it must be finite and not negative.
double worst_ratio_error(const EntryOf& entry, const Cells& cells, const TableRequest& request, double h);

/// Means of the tests' own build.
preintegrated::BuildMeans means(const std::string& isa = "auto", int threads = 2);

/// Unlit E + P, shaded S and highlight W as the hybrid model needs them: in groups of four (source and T; S; back part
/// of S), with one W per extinction channel. With ratio, T is left out.
TableRequest full_request(bool rgb, bool ratio);
/// E + P of three channels and T of the first extinction channel.
TableRequest plain_request(bool rgb);

}  // namespace dvrlab::test
