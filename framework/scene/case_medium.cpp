#include "framework/scene/case_medium.h"

#include <algorithm>
#include <cstdio>

#include "framework/interfaces/error.h"
#include "framework/scene/cells.h"
#include "framework/scene/discrete_surfaces.h"
#include "framework/scene/scene.h"
#include "framework/scene/tf_domain.h"

namespace dvrlab {

namespace {
std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

/// Values that nothing passes, one by one: isosurfaces of opacity 1.
std::vector<double> isosurfaces(const Medium& medium) {
  std::vector<double> values;
  for (const OpaqueRange& r : medium.opaque)
    if (r.v0 == r.v1) values.push_back(r.v0);
  return values;
}

/// "" or the way out for terms that samples cannot see.
std::string hint_of(const ResolvedCase& c) {
  const auto& keys = c.estimator.parameters.declared();
  const bool pulses = std::any_of(keys.begin(), keys.end(),
                                  [](const Parameter& p) { return p.name == std::string("approximate_dirac"); });
  return pulses ? "; estimator.approximate_dirac can stand pulses in for Dirac terms" : "";
}

/// What an estimator that predicts no opaque values sees in their place.
Medium without_prediction(const ResolvedCase& c, const EstimatorPlugin& estimator, Medium medium, double length_unit,
                          std::vector<std::string>& notes) {
  const EstimatorDeclaration d = estimator.declaration(c.estimator.parameters);
  if (d.prediction != OpaquePrediction::off || medium.opaque.empty()) return medium;
  notes.push_back("estimator: opaque values have the extinction " + short_number(d.max_extinction) +
                  " per length unit, opaque isosurfaces the depth 16.6");
  return without_opaque_values(medium, d.max_extinction / length_unit);
}

/// The medium with pulses in place of Dirac terms, where the estimator asks for them.
Medium with_pulses_of(const ResolvedCase& c, Medium medium, const EstimatorPlugin& estimator,
                      std::vector<std::string>& notes) {
  const double pulse = estimator.dirac_pulse(c.estimator.parameters);
  std::vector<double> surfaces = isosurfaces(medium);
  for (const Dirac& d : medium.dirac) surfaces.push_back(d.v);
  if (pulse == 0 || surfaces.empty()) return medium;
  for (const double v : surfaces)
    if (static_cast<float>(v - pulse / 2) >= static_cast<float>(v))
      throw InputError("estimator.approximate_dirac: a pulse of width " + short_number(pulse) + " at value " +
                       short_number(v) + " is narrower than fp32 resolves; give a wider one");
  notes.push_back("estimator: Dirac terms are approximated by pulses of width " + short_number(pulse));
  return with_pulses(medium, pulse);
}

}  // namespace

Medium model_medium(const ResolvedCase& c, const Registry& registry, double voxel, double value_min, double value_max,
                    std::vector<std::string>& notes) {
  const ParameterSet& p = c.optical_model.parameters;
  ModelContext context;
  context.length_unit = p.text("length_unit") == "voxel" ? voxel : 1.0;
  context.opacity_interpolation = p.text("interpolation") == "opacity";
  context.linear_color = c.image.text("space") == "linear";
  context.opaque = static_cast<ModelContext::Opaque>(p.choice_index("opaque"));
  context.opaque_width = (value_max - value_min) / static_cast<double>(p.integer("tf_entries") - 1);
  context.value_min = value_min;
  context.value_max = value_max;
  context.notes = &notes;
  Medium medium =
      registry.get<OpticalModelPlugin>("optical_model", c.optical_model.type, "optical_model.type").medium(p, context);
  const EstimatorPlugin& estimator = registry.get<EstimatorPlugin>("estimator", c.estimator.type);
  return with_pulses_of(c, without_prediction(c, estimator, std::move(medium), context.length_unit, notes), estimator,
                        notes);
}

Medium stored_medium(const ResolvedCase& c, const Registry& registry, const Field& field,
                     std::vector<std::string>& notes) {
  const TfDomain domain = tf_domain(c.optical_model.parameters, field);
  if (!domain.note.empty()) notes.push_back(domain.note);
  const double slope = domain.slope(field), intercept = domain.intercept(field);
  const auto [lowest, highest] =
      std::minmax({slope * field.stored_min + intercept, slope * field.stored_max + intercept});
  return model_medium(c, registry, field.voxel, lowest, highest, notes).rescaled(slope, intercept);
}

void refuse_impossible(const ResolvedCase& c, const Medium& medium, const EstimatorDeclaration& d) {
  Terms missing;
  missing.bits = medium.terms().bits & ~d.handles;
  const std::string hint = missing.dirac() ? hint_of(c) : "";
  if (missing.bits != 0)
    throw InputError("estimator.type: estimator \"" + c.estimator.type + "\" cannot integrate the terms " +
                     missing.text() + " of optical model \"" + c.optical_model.type +
                     "\"; choose another estimator (dvrlab list estimator) or remove these terms" + hint);
  if (d.chromaticity && medium.glows_without_extinction())
    throw InputError(
        "estimator.type: estimator \"" + c.estimator.type +
        "\" averages chromaticities with these parameters, but optical model \"" + c.optical_model.type +
        "\" emits where there is no extinction, so that they are infinite; choose another rule or estimator");
  if (samples_cells(c) && (d.fixed_length || (d.neighbours && medium.terms().surfaces())))
    throw InputError("sampling.type: \"cells\" ends segments where the field is no longer linear, but estimator \"" +
                     c.estimator.type + "\" needs equally spaced samples for the terms of optical model \"" +
                     c.optical_model.type + "\"; choose another estimator");
  if (!isosurfaces(medium).empty() && d.pointwise())
    throw InputError(
        "estimator.type: estimator \"" + c.estimator.type +
        "\" looks at one point of each segment, where it does not see an isosurface of opacity 1; choose another "
        "estimator or a lower opacity" +
        hint_of(c));
  if (!d.fp64 && precision_of(c) == Precision::fp64)
    throw InputError("precision: estimator \"" + c.estimator.type +
                     "\" computes in fp32 only; choose another estimator for \"fp64\", for example exact");
  if (d.needs_nodes && c.optical_model.parameters.text("tf") != "nodes")
    throw InputError("estimator.type: estimator \"" + c.estimator.type +
                     "\" integrates between the transfer functions' nodes; set optical_model.tf to \"nodes\"");
}

MediumTableOptions table_options(const ResolvedCase& c, const Field& field) {
  const ParameterSet& p = c.optical_model.parameters;
  MediumTableOptions o;
  o.nodes = p.text("tf") == "nodes";
  o.entries = static_cast<int>(p.integer("tf_entries"));
  o.lo = field.stored_min;
  o.hi = field.stored_max;
  if (!p.is_null("tf_range")) {
    const nlohmann::json& range = p.json("tf_range");
    o.lo = (range[0].get<double>() - field.intercept) / field.slope;
    o.hi = (range[1].get<double>() - field.intercept) / field.slope;
    if (o.lo > o.hi) std::swap(o.lo, o.hi);
  }
  if (!(o.hi > o.lo)) o.hi = o.lo + 1.0;  // a constant field: the table needs a width
  return o;
}

MediumTableOptions table_options(const ResolvedCase& c, const Field& field, const Medium& medium,
                                 const LocalShading& light, const EstimatorDeclaration& d) {
  using Mode = LocalShading::Mode;
  const Terms terms = medium.terms();
  MediumTableOptions o = table_options(c, field);
  o.rgb = terms.rgb();
  // A light volume alone is a factor of all that a segment sends, where all of it is lit and seen at one point.
  const bool factor =
      light.mode == Mode::none && !terms.has(Term::E) && d.samples == EstimatorDeclaration::Samples::centre;
  o.full = terms.surfaces() || terms.dirac() || light.mode == Mode::prescribed ||
           (medium.shaded() && light.mode != Mode::none) || (light.light_volume && !factor);
  o.lit_particles = light.mode == Mode::prescribed || light.light_volume;
  o.fold_shaded = !o.full;
  return o;
}

TableLayout table_layout(const ResolvedCase& c, const Medium& medium, const MediumTableOptions& options) {
  return {medium.terms(), options.full, options.lit_particles, MediumLayout(medium, options).count(), precision_of(c)};
}

}  // namespace dvrlab
