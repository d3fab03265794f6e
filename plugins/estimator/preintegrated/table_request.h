// What a pre-integration table is asked to hold.
#pragma once

#include <vector>

namespace dvrlab::preintegrated {

/// One scalar source: the sum of the chosen terms of one colour channel. `S` and `W` mean both parts (per length and
/// per |dv|) and the Dirac terms: colour c_i(1-e^-mu_i) in S, 1-e^-mu_i in W.
struct SourceColumn {
  bool E = false, P = false, S = false, W = false;
  int channel = 0;  // 0 .. 2
  bool operator==(const SourceColumn&) const = default;
};

/// What one of the floats of an entry holds. `index` is a source column, for `transmittance` an extinction channel.
struct OutputChannel {
  enum class Kind {
    zero,    // padding
    total,   // C of the column; as a ratio r = C / C_approx
    back,    // C_1 = B, its part weighted with the position w, so that the front part is C - B; as a ratio B / C_approx
    second,  // C_2, weighted with w^2, for light factors that are a cubic of w
    third,   // C_3, weighted with w^3
    transmittance  // T (not for ratio tables: there it follows from the one-dimensional tables)
  };
  Kind kind = Kind::zero;
  int index = 0;
  bool operator==(const OutputChannel&) const = default;
};

/// Limits of one build; a caller with more builds a second table.
inline constexpr int most_columns = 16;
inline constexpr int most_groups = 12;

struct TableRequest {
  bool rgb_extinction = false;  // 3 extinction channels; otherwise the red one serves all
  std::vector<SourceColumn> columns;
  /// In groups of 4, as kernels fetch them; a multiple of 4 entries.
  std::vector<OutputChannel> outputs;
  /// Ratios to the approximate integral (docs/math B.2) instead of C and B: the corrected look-up of B.5.
  bool ratio = false;

  int extinctions() const { return rgb_extinction ? 3 : 1; }
  int groups() const { return static_cast<int>(outputs.size()) / 4; }
  /// The highest power of the position that weighs one of a column's outputs: 0, 1 or 3.
  int moments(int column) const;
  bool operator==(const TableRequest&) const = default;
};

/// Throws InputError (what is wrong, and what would be right).
void check(const TableRequest& request);

}  // namespace dvrlab::preintegrated
