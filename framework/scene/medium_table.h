// The medium as the kernels read it: table or nodes (framework/kernel/medium.kernel has the layout).
#pragma once

#include <vector>

#include "framework/interfaces/kernel_unit.h"
#include "framework/interfaces/medium.h"

namespace dvrlab {

struct MediumTableOptions {
  bool nodes = false;  // tf: "nodes"
  int entries = 4096;
  double lo = 0, hi = 1;  // stored values of the first and last entry
  bool rgb = false, full = false;
  bool lit_particles = false;  // full: m is not 1 everywhere, so where there is E, it must stay apart from P
  bool fold_shaded = false;    // plain: the unlit medium's source is E + P + S_l (no local shading: k = 1, b = 0)
};

using MediumGroup = std::array<double, 4>;

/// Which groups of four numbers an entry of the medium has: those of medium.kernel. Linear in the columns, so it serves
/// values, means and polynomial coefficients alike.
class MediumLayout {
 public:
  /// Of a full medium. Compact where extinction is grey, every highlight's weight is the extinction beside it, and the
  /// matter that has a length is lit either everywhere or nowhere: then half or less of the numbers say all.
  enum class Form { general, compact_unlit, compact_lit };

  MediumLayout(const Medium& medium, const MediumTableOptions& options);
  std::vector<MediumGroup> groups(const std::array<double, medium_columns>& columns) const;
  /// The same into count() times four numbers.
  void write(const std::array<double, medium_columns>& columns, double* to) const;
  /// Where tau_l of a channel stands among them.
  int extinction_at(int channel) const;
  Form form() const { return form_; }
  bool emits() const { return emits_; }
  bool surfaces() const { return surfaces_; }
  int count() const { return count_; }

 private:
  MediumTableOptions options_;
  Form form_ = Form::general;
  bool emits_, surfaces_;
  int count_ = 0;
};

/// Fetches of four numbers with which a kernel finds the medium at a value.
int fetches_of_point(const Medium& medium, const MediumTableOptions& options);

/// Adds the uniforms medium_* and the buffers medium_table, medium_node, medium_node_poly, medium_shaded_sum.
void add_medium(const Medium& medium, const MediumTableOptions& options, KernelUnit& unit);

/// Which table bins can contribute anything: the macrocells' question. Bin b lies between entries b and b+1; the
/// first and last bin include everything outside.
class OccupiedBins {
 public:
  /// `cells`: of the coarsest table that the medium is seen through, if that is coarser than the medium's own; 0: none.
  OccupiedBins(const Medium& medium, MediumTableOptions options, int cells);
  /// True if no value of the closed interval [a, b] contributes, with one bin of margin.
  bool empty(double a, double b) const;
  /// How many bins before bin b contribute, and two more entries, as medium_shaded_sum has them.
  const std::vector<int>& sums() const { return sum_; }

 private:
  double lo_, scale_;
  std::vector<int> sum_;  // prefix sums
};

}  // namespace dvrlab
