// Full pre-integration: two-dimensional tables of all segments of the nominal length, and how they are looked up.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>

#include "framework/interfaces/error.h"
#include "framework/interfaces/segment_keys.h"
#include "plugins/estimator/preintegrated/published.h"
#include "plugins/estimator/preintegrated/tables_of.h"

namespace dvrlab::preintegrated {
namespace {

constexpr Parameter parameters[] = {
    {"table_size", ParameterType::integer, "", "1024", "[2,65000]", "Values along each side of the table.",
     Affects::pixels, "", "16"},
    {"lookup", ParameterType::choice, "", "\"corrected\"", "corrected|plain",
     "corrected: depth and mean source from one-dimensional tables, times the table's "
     "ratio (ours, see the page); plain: "
     "radiance and transmittance from the table.",
     Affects::pixels, "", "\"plain\""},
    {"depth_table_size", ParameterType::integer, "", "4096", "[2,65536]",
     "Bins of the one-dimensional tables: depth and mean source of the corrected look-up, depth of segments of another "
     "length with the plain one.",
     Affects::pixels, "", "64"},
    {"variant", ParameterType::choice, "", "\"corrected\"", "corrected|published|published_slide",
     "published: the entries of equation 22 of Yang et al. 2012 as printed; published_slide: those of the window slide "
     "of Lum et al. 2004. Both only show what the corrections are for, with the plain look-up.",
     Affects::pixels, R"({"estimator":{"lookup":"plain","table_size":64}})", "\"published\""},
    shading_of_every_kind_key,
    opaque_prediction_key,
    max_extinction_key,
    {"update", ParameterType::choice, "", "\"full\"", "full|partial",
     "Whether a table that differs from an earlier one of the same run in some of its "
     "values is built again as a whole; "
     "a partial update may differ in the last bit of a float.",
     Affects::nothing}};

constexpr long long most_published_values = 512;

/// Tables where segments have any length: of the longest one, of half of it, and so on.
constexpr int lengths_of_walks = 8;

/// The degree of the light factors in the position, by the modes of light_of_segment.
int degree_of(const ParameterSet& p) {
  constexpr int degrees[] = {0, 1, 0, 3};
  return degrees[segment_shading(p)];
}

class Preintegrated : public EstimatorPlugin {
 public:
  void check(const ParameterSet& p) const override {
    if (p.text("variant") == "corrected") return;
    if (p.text("lookup") != "plain")
      throw InputError(p.path_of("variant") + ": \"" + p.text("variant") +
                       "\" fills a table of radiance and transmittance; set lookup to \"plain\"");
    if (p.text("shading") == "nonlinear")
      throw InputError(p.path_of("variant") + ": \"" + p.text("variant") +
                       "\" is of tables without the moments that shading \"nonlinear\" needs; choose another shading");
    if (p.integer("table_size") > most_published_values)
      throw InputError(p.path_of("table_size") + ": with variant \"" + p.text("variant") + "\" at most " +
                       std::to_string(most_published_values) + ", for a table is integrated cell by cell");
  }

  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d;
    d.samples = EstimatorDeclaration::Samples::ends;
    d.shading = segment_shading(p);
    d.fp64 = false;  // its table holds floats
    // A ratio jumps where an entry begins to hold a Dirac term; the corrected look-up meets none.
    d.cuts_diracs = p.text("lookup") == "corrected";
    d.nominal_length = !d.cuts_diracs;
    d.mean_bins = static_cast<int>(p.integer("depth_table_size"));
    d.cells = std::min(d.mean_bins, static_cast<int>(p.integer("table_size")) - 1);
    d.means = p.text("lookup") == "corrected" ? 1 : 0;  // plain: only where a segment has another length
    declare_prediction(p, d);
    d.barycentre = p.text("shading") == "barycentre";
    d.handles = Terms::every_column | Terms::rgb_bit | Terms::dirac_bit;
    return d;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const TableLayout& layout) const override {
    Groups unused;
    const int n = static_cast<int>(p.integer("table_size"));
    const TableRequest request =
        request_of(layout.terms, layout.full, layout.lit_particles, p.text("lookup") == "plain", degree_of(p), unused);
    // Beside the table a published one, or an older one that may be kept; every thread of a build has its own memory.
    const std::uint64_t bytes = Table::bytes(n, request) * (layout.walks ? lengths_of_walks : 1);
    const bool copies = p.text("variant") != "corrected" || p.text("update") == "partial";
    const std::uint64_t beside = copies ? bytes : std::min(bytes, most_bytes_kept);
    return bytes + beside + (std::uint64_t{64} << 20);
  }

  void prepare(const ParameterSet& p, const EstimatorContext& context, KernelUnit& unit) const override {
    const bool plain = p.text("lookup") == "plain";
    const int n = static_cast<int>(p.integer("table_size"));
    Groups groups;
    const TableRequest request =
        request_of(context.medium->terms(), context.full, context.lit_particles, plain, degree_of(p), groups);
    const auto table_at = [&](double h) {
      return table_of(*context.medium, context.value_min, context.value_max, n, request, h,
                      p.text("update") == "partial", {context.folder});
    };
    const std::uint64_t entries =
        2 * static_cast<std::uint64_t>(request.groups()) * static_cast<std::uint64_t>(table_entries(n));
    const int lengths = context.longest > 0 ? lengths_of_walks : 1;
    std::shared_ptr<const void> numbers;
    if (lengths > 1) {
      const auto all = std::make_shared_for_overwrite<float[]>(4 * entries * lengths_of_walks);
      for (int k = 0; k < lengths; ++k) {
        const auto table = table_at(std::ldexp(context.longest, -k));
        std::memcpy(all.get() + 4 * entries * static_cast<std::uint64_t>(k), table->memory().get(), 16 * entries);
      }
      numbers = all;
    } else {
      auto table = table_at(context.step);
      const auto variant = static_cast<Variant>(p.choice_index("variant"));
      if (variant != Variant::corrected) table = published_table(*table, variant, 0);
      numbers = {table, table->memory().get()};
    }
    const auto integer = [&](const char* name, int value) {
      unit.uniforms.push_back(Uniform::constant_integer(std::string("preintegrated_") + name, value));
    };
    unit.fetches = (lengths > 1 ? 6 : 3) * request.groups();
    integer("lengths", lengths);
    unit.uniforms.push_back(Uniform::real("preintegrated_longest", context.longest));
    integer("values", n);
    integer("block", static_cast<int>(table_entries(n)));
    integer("groups", request.groups());
    integer("shaded", groups.shaded);
    integer("emitted", groups.emitted);
    integer("particles", groups.particles);
    integer("highlight", groups.highlight);
    integer("through", groups.through);
    unit.uniforms.push_back(Uniform::real("preintegrated_lo", context.value_min));
    unit.uniforms.push_back(Uniform::real("preintegrated_scale", (n - 1) / (context.value_max - context.value_min)));
    unit.uniforms.push_back(Uniform::real("preintegrated_step", context.step));
    unit.buffers.push_back({"preintegrated_table", Element::vec4, std::move(numbers),
                            entries * static_cast<std::uint64_t>(lengths), nullptr});
  }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "preintegrated", "1.0", Preintegrated, parameters,
              "full pre-integration: two-dimensional tables, front- and back-weighted, with a corrected look-up",
              "F. Yang et al. 2012, equations 18-23; E. Lum, B. Wilson, K.-L. Ma, High-Quality Lighting and Efficient "
              "Pre-Integration for Volume Rendering, VisSym 2004, doi:10.2312/VisSym/VisSym04/025-034")

}  // namespace dvrlab::preintegrated
