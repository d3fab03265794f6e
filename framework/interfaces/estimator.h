// An estimator integrates the medium over one segment (docs/math, section B). Its kernel is one function,
//   segment_kernel(segment q, OUT(vec3r) c, OUT(spectral) t)
// in <name>.kernel; the host side declares it and builds its tables.
#pragma once

#include <cstdint>

#include "framework/interfaces/backend.h"
#include "framework/interfaces/bin_medium.h"
#include "framework/interfaces/kernel_unit.h"
#include "framework/interfaces/medium.h"
#include "framework/interfaces/plugin.h"

namespace dvrlab {

/// `opaque_prediction`: how a segment finds the first opaque value on its way (Lee and Shin 2013, section 4.2).
enum class OpaquePrediction {
  both,       // the next opaque value above for ascending segments, below for descending ones
  published,  // above only, and not when the segment ends there: as the paper prints it
  off         // there are no opaque values: `max_extinction` stands for infinite extinction
};

struct EstimatorDeclaration {
  enum class Samples { ends, centre };
  Samples samples = Samples::ends;
  /// With `ends`: the kernel looks at the medium at the front end only, so that an opaque value between the ends is
  /// not seen, as with `centre` one beside the centre.
  bool front_only = false;
  /// True: the kernel assumes that every segment has the nominal step.
  bool fixed_length = false;
  /// Its tables are those of the nominal step; a shorter last segment is made from them by a rule of thumb. Where
  /// segments have any length (meshes) it is refused.
  bool nominal_length = false;
  /// `centre`: also needs v_prev and v_next (for |dv| terms).
  bool neighbours = false;
  /// The kernel integrates the transfer functions' intervals (medium_interval_at): a medium with tf "nodes" only.
  bool needs_nodes = false;
  /// Bins of the medium's cumulative tables (medium_mean of framework/kernel/mean.kernel); 0: it does not use them.
  int mean_bins = 0;
  /// Light factors inside a segment: the mode of light_of_segment (framework/kernel/light.kernel), as segment_shading
  /// (framework/interfaces/segment_keys.h) makes it of the shared key `shading`.
  int shading = 0;
  /// Cells over the range of values of the coarsest table that it sees the medium through, 0 when it asks pointwise: a
  /// value that contributes nothing may be smeared by so much.
  int cells = 0;
  /// How often a segment asks medium_at and medium_mean, for the count of table fetches. Others that it makes, and
  /// those from tables of its own, are KernelUnit::fetches.
  int points = 0, means = 0;
  OpaquePrediction prediction = OpaquePrediction::both;
  /// With prediction off: per length unit of the optical model.
  double max_extinction = 0;
  /// False: it is built on numbers of fp32, and precision "fp64" is refused.
  bool fp64 = true;
  /// Its shading asks for the barycentre of the surfaces in a segment (mean_surface_place).
  bool barycentre = false;
  /// It divides sources by extinctions: a medium that glows without extinction is refused.
  bool chromaticity = false;
  /// The framework cuts segments at Dirac terms: the kernel never sees one inside a segment, and prepare() none at all.
  bool cuts_diracs = false;
  /// The terms that it can integrate, Terms::bit(...) | ...
  unsigned handles = 0;

  /// Opaque values are seen at one point of a segment, not on the way between its ends.
  bool pointwise() const { return front_only || samples == Samples::centre; }
};

/// What decides how many numbers a kernel's tables hold.
struct TableLayout {
  Terms terms;
  bool full = false;           // the kernel's variant has light factors; without them every source is lit by 1
  bool lit_particles = false;  // m differs from 1
  int groups = 1;              // of four numbers, of the medium's own tables (BinMedium::groups without the barycentre)
  Precision precision = Precision::strict;  // of the kernel
  bool walks = false;                       // segments have any length up to EstimatorContext::longest
};

/// What an estimator is told beside its own parameters. Values are stored units.
struct EstimatorContext {
  const Medium* medium;
  double value_min, value_max;
  double step;            // world units
  bool full;              // the kernel's variant has light factors; without them every source is lit by 1
  bool lit_particles;     // m differs from 1
  Precision precision;    // of the kernel
  std::string folder;     // of the plugin: where its own libraries lie
  double longest;         // world units: segments have any length up to it; 0: the step, but for the last one of a ray
  const BinMedium* bins;  // of `mean_bins`, reshaped by shape_bins; empty without
};

class EstimatorPlugin : public Plugin {
 public:
  virtual EstimatorDeclaration declaration(const ParameterSet& parameters) const = 0;
  /// Width, in the transfer functions' values, of the pulses of tau_s that stand for Dirac terms; 0: none do.
  virtual double dirac_pulse(const ParameterSet& /*parameters*/) const { return 0; }
  /// Reshapes the bins of the medium before cumulative tables are made of them. `step`: the nominal length of a
  /// segment, world units.
  virtual void shape_bins(const ParameterSet& /*parameters*/, double /*step*/, BinMedium& /*bins*/) const {}
  /// Bytes that prepare() will allocate at the most: its tables, and what it needs to build them.
  virtual std::uint64_t bytes_needed(const ParameterSet& /*parameters*/, const TableLayout& /*layout*/) const {
    return 0;
  }
  /// Tables and derived uniforms. The numeric parameters are added by the framework.
  virtual void prepare(const ParameterSet& /*parameters*/, const EstimatorContext& /*context*/,
                       KernelUnit& /*unit*/) const {}
};

}  // namespace dvrlab
