// Pre-integration by a power series: one-dimensional tables of moments.
#include <algorithm>
#include <string>

#include "framework/interfaces/error.h"
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/segment_keys.h"
#include "framework/scene/buffers.h"
#include "framework/scene/gauss.h"
#include "plugins/estimator/power_series/moment_table.h"

namespace dvrlab::power_series {
namespace {

constexpr Parameter parameters[] = {
    {"order", ParameterType::integer, "", "1", "[1,4]",
     "Terms of the series. Order 1 holds at every depth; the higher ones only below the safe depth of their order "
     "(0.5, 1, 1).",
     Affects::pixels,
     R"({"optical_model":{"type":"absorption_emission","surface":null,"scattering":null,"dv_std":null,"opacity":[[0.3,0],[0.8,0.2]]}})",
     "3"},
    {"table_size", ParameterType::integer, "", "4096", "[2,65536]", "Bins of the tables.", Affects::pixels, "", "16"},
    {"fallback", ParameterType::choice, "", "\"split\"", "split|order1|none",
     "Segments deeper than the safe depth of the order. split: into parts of equal difference of values, one per 0.5 "
     "of "
     "depth (or per safe_depth) and at most most_parts, and order 1 where a part is still too deep; order1; none: the "
     "series as it is, with its poles.",
     Affects::pixels,
     R"({"optical_model":{"type":"absorption_emission","surface":null,"scattering":null,"dv_std":null,"opacity":[[0.3,0],[0.8,0.9]]},"estimator":{"order":2},"sampling":{"step":4}})",
     "\"none\""},
    {"safe_depth", ParameterType::number, "", "0", "[0,inf)",
     "Optical depth up to which the series of an order above 1 is taken as it is; 0: that of the order, 0.5, 1, 1.",
     Affects::pixels,
     R"({"optical_model":{"type":"absorption_emission","surface":null,"scattering":null,"dv_std":null,"opacity":[[0.3,0],[0.8,0.9]]},"estimator":{"order":2},"sampling":{"step":4}})",
     "0.1"},
    {"most_parts", ParameterType::integer, "", "16", "[1,256]", "With fallback split: parts of a segment at the most.",
     Affects::pixels,
     R"({"optical_model":{"type":"absorption_emission","surface":null,"scattering":null,"dv_std":null,"opacity":[[0.3,0],[0.8,0.9]]},"estimator":{"order":2},"sampling":{"step":4}})",
     "1", "fallback=split"},
    {"variant", ParameterType::choice, "", "\"corrected\"", "corrected|published|published_gradient",
     "What the paper prints, to show the difference. published: the pseudo-code's index that is off by one, the colour "
     "of a bin with the extinction of the bin below it (a colour without extinction counts as black); "
     "published_gradient: the sign of equation 24 with shading nonlinear.",
     Affects::pixels,
     R"({"optical_model":{"type":"absorption_emission","surface":null,"scattering":null,"dv_std":null,"opacity":[[0,0.01],[0.3,0.01],[0.8,0.2]]}})",
     "\"published\""},
    shading_of_every_kind_key,
    opaque_prediction_key,
    max_extinction_key};

constexpr double safe_depths[] = {0, 1e30, 0.5, 1, 1};  // of the orders; docs/math B.6
constexpr double part_depth = 0.5;                      // of the parts of deeper segments, on the average

int order_of(const ParameterSet& p) { return static_cast<int>(p.integer("order")); }

/// Coefficients of the light over the place in the segment.
int places_of(const ParameterSet& p, bool full) {
  const int mode = full ? segment_shading(p) : 0;
  return mode == 1 ? 2 : mode == 3 ? 4 : 1;
}

/// Order 1 without places asks for the mean of the medium alone.
bool mean_only(int order, int places) { return order * places == 1; }

class PowerSeries : public EstimatorPlugin {
 public:
  void check(const ParameterSet& p) const override {
    if (p.text("variant") == "published_gradient" && p.text("shading") != "nonlinear")
      throw InputError(p.path_of("variant") +
                       ": \"published_gradient\" is the sign of equation 24, which only shading \"nonlinear\" has");
  }

  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d = declaration_of_means(p);
    d.barycentre = p.text("shading") == "barycentre";
    d.cuts_diracs = true;
    d.means = 0;  // with the light's places unknown: prepare() counts
    // The published index smears a bin over the next one too.
    if (p.text("variant") == "published") d.cells = std::max(1, d.cells / 2);
    d.handles = Terms::every_column | Terms::rgb_bit | Terms::dirac_bit;
    // The depth of surfaces is measured in |dv|, that of particles in length: the series would need both in one. What
    // is published knows no surfaces.
    if (order_of(p) > 1 || p.text("variant") == "published")
      d.handles &= ~(Terms::bit(Term::tau_s) | Terms::bit(Term::S_s) | Terms::bit(Term::W_s));
    return d;
  }

  /// The published index: what is meant for bin j gets the extinction of bin j - 1.
  void shape_bins(const ParameterSet& p, double, BinMedium& bins) const override {
    if (p.text("variant") != "published") return;
    Vector3 below{};
    for (int j = 0; j < bins.count; ++j) {
      const Vector3 tau = bins.extinction(j);
      Vector3 factor;
      for (std::size_t c = 0; c < 3; ++c) factor[c] = tau[c] > 0 ? below[c] / tau[c] : 0;
      bins.scale(j, factor);
      for (std::size_t c = 0; c < 3; ++c) bins.bin(j)[bins.extinction_at[c]] = below[c];
      below = tau;
    }
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const TableLayout& layout) const override {
    const int bins = static_cast<int>(p.integer("table_size")), places = places_of(p, layout.full);
    if (mean_only(order_of(p), places)) return 0;
    const int groups = layout.groups + (p.text("shading") == "barycentre" && layout.full ? 1 : 0);
    return static_cast<std::uint64_t>(levels_of(bins)) * (static_cast<std::uint64_t>(bins) + 2) *
           static_cast<std::uint64_t>(groups * order_of(p) * places) * 4 *
           (layout.precision == Precision::fp64 ? sizeof(double) : sizeof(float));
  }

  void prepare(const ParameterSet& p, const EstimatorContext& context, KernelUnit& unit) const override {
    const int order = order_of(p), places = places_of(p, context.full);
    const bool fp64 = context.precision == Precision::fp64;
    const auto integer = [&](const char* name, int value) {
      unit.uniforms.push_back(Uniform::constant_integer(std::string("power_series_") + name, value));
    };
    const int points = (order + places) / 2;
    integer("terms", order);
    integer("places", places);
    integer("bins", context.bins->count);
    integer("points", points);
    const double asked = order > 1 ? p.number("safe_depth") : 0;
    unit.uniforms.push_back(Uniform::real("power_series_deepest", asked > 0 ? asked : safe_depths[order]));
    unit.uniforms.push_back(Uniform::real("power_series_part_depth", asked > 0 ? asked : part_depth));
    unit.buffers.push_back(vec4_buffer("power_series_gauss", gauss_rows(points)));
    Buffer moments{"power_series_moment", Element::vec4, nullptr, 0, nullptr};
    const int mean = 6 * context.bins->groups;
    if (!mean_only(order, places)) {
      const MomentTable table = moment_table(*context.bins, order, places, fp64);
      moments.data = table.rounded;
      moments.data64 = table.values;
      moments.count = table.entries;
      // Both end bins and the two entries between them, whose depths come first.
      unit.fetches = context.bins->groups * (2 + 2 + 2 * order * places);
      if (order > 1 && p.text("fallback") == "split") unit.fetches += mean;
    } else {
      unit.fetches = mean;
      moments = vec4_buffer("power_series_moment", {});
    }
    unit.buffers.push_back(std::move(moments));
  }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "power_series", "1.0", PowerSeries, parameters,
              "pre-integration by a power series of the order 1 to 4 from one-dimensional tables",
              "B. Lee, Y.-G. Shin, Advanced Interactive Preintegrated Volume Rendering with a Power Series, IEEE TVCG "
              "2013, doi:10.1109/TVCG.2012.313; A. Guetat et al. 2010 for non-linear gradient interpolation")

}  // namespace dvrlab::power_series
