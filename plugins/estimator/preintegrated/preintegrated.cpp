// Full pre-integration: two-dimensional tables of all segments of the nominal length, and how they are looked up.
#include "framework/interfaces/segment_keys.h"
#include "plugins/estimator/preintegrated/tables_of.h"

namespace dvrlab::preintegrated {
namespace {

constexpr Parameter parameters[] = {
    {"table_size", ParameterType::integer, "", "1024", "[2,16384]", "Values along each side of the table.",
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
    shading_key,
    {"update", ParameterType::choice, "", "\"full\"", "full|partial",
     "Whether a table that differs from an earlier one of the same run in some of its "
     "values is built again as a whole; "
     "a partial update may differ in the last bit of a float.",
     Affects::nothing}};

class Preintegrated : public EstimatorPlugin {
 public:
  EstimatorDeclaration declaration(const ParameterSet& p) const override {
    EstimatorDeclaration d;
    d.samples = EstimatorDeclaration::Samples::ends;
    // A ratio jumps where an entry begins to hold a Dirac term; the corrected look-up meets none.
    d.cuts_diracs = p.text("lookup") == "corrected";
    d.mean_bins = static_cast<int>(p.integer("depth_table_size"));
    for (int t = 0; t < term_count; ++t) d.handles |= Terms::bit(static_cast<Term>(t));
    d.handles |= Terms::rgb_bit | Terms::dirac_bit;
    return d;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const Terms& terms) const override {
    Groups unused;
    const int n = static_cast<int>(p.integer("table_size"));
    const TableRequest most = request_of(terms, true, true, p.text("lookup") == "plain", unused);
    // Two tables are kept, and every thread of a build has its own memory.
    return 2 * Table::bytes(n, most) + (std::uint64_t{64} << 20);
  }

  void prepare(const ParameterSet& p, const EstimatorContext& context, KernelUnit& unit) const override {
    const bool plain = p.text("lookup") == "plain";
    const int n = static_cast<int>(p.integer("table_size"));
    Groups groups;
    const TableRequest request =
        request_of(context.medium->terms(), context.full, context.lit_particles, plain, groups);
    const auto table = table_of(*context.medium, context.value_min, context.value_max, n, request, context.step,
                                p.text("update") == "partial", {context.folder});
    const auto integer = [&](const char* name, int value) {
      unit.uniforms.push_back(Uniform::constant_integer(std::string("preintegrated_") + name, value));
    };
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
    unit.buffers.push_back(
        {"preintegrated_table",
         Element::vec4,
         {table, table->memory().get()},
         2 * static_cast<std::uint64_t>(request.groups()) * static_cast<std::uint64_t>(table_entries(n)),
         nullptr});
  }
};

}  // namespace

DVRLAB_PLUGIN("estimator", "preintegrated", "1.0", Preintegrated, parameters,
              "full pre-integration: two-dimensional tables, front- and back-weighted, with a corrected look-up",
              "F. Yang et al. 2012, equations 18-23; E. Lum, B. Wilson, K.-L. Ma, High-Quality Lighting and Efficient "
              "Pre-Integration for Volume Rendering, VisSym 2004, doi:10.2312/VisSym/VisSym04/025-034")

}  // namespace dvrlab::preintegrated
