// Moments of a medium over runs of bins, for any two bins in two entries (docs/math B.6, B.7).
//
// Level k cuts the bins into blocks of 2^(k+1) with a middle each. The entry of bin j on level k holds the bins
// strictly between j and the middle of its block (in the upper half the middle's own bin too): of each number of the
// medium the integrals of G y^i r^l over them, y the depth and r the distance from the middle, the distance in units of
// 2^k bins. Two bins j0 < j1 whose highest differing bit is k lie in the two halves of one block of level k, so the
// entries of both hold what lies between them. Everything is a sum of terms of one sign: no digits are lost, in float
// either.
// Level 0 holds nothing: the table begins with level 1.
#pragma once

#include <cstdint>
#include <memory>

#include "framework/interfaces/bin_medium.h"

namespace dvrlab::power_series {

struct MomentTable {
  int levels = 0;
  std::uint64_t entries = 0;  // of four numbers: [level - 1][bin][group][i][l]
  /// One of them, as asked for.
  std::shared_ptr<float[]> rounded;
  std::shared_ptr<double[]> values;
};

/// The levels 1 .. of a table of so many bins, the outer ones not counted; at least one.
int levels_of(int bins);

/// i = 0 .. orders - 1, l = 0 .. places - 1; orders 1 .. 4, places 1, 2 or 4.
MomentTable moment_table(const BinMedium& bins, int orders, int places, bool fp64);

}  // namespace dvrlab::power_series
