#include "framework/scene/scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "framework/interfaces/error.h"
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/transfer_function.h"
#include "framework/scene/buffers.h"
#include "framework/scene/camera.h"
#include "framework/scene/cells.h"
#include "framework/scene/discrete_surfaces.h"
#include "framework/scene/lighting.h"
#include "framework/scene/macrocells.h"
#include "framework/scene/mean_table.h"
#include "framework/scene/medium_table.h"
#include "framework/scene/tf_domain.h"
#include "framework/scene/vector.h"

namespace dvrlab {

namespace {

LoadContext load_context(const ResolvedCase& c) {
  return {c.base_folder, c.data.parameters.text("nan_policy"), c.data.parameters.number("nan_value")};
}

std::string field_key(const ResolvedCase& c) { return c.config.at("data").dump() + "|" + c.base_folder; }

Precision precision_of(const ResolvedCase& c) { return static_cast<Precision>(c.top.choice_index("precision")); }

/// The sampler that reads the field: the config's, else the one that the data names.
std::string sampler_of(const ResolvedCase& c, const Field& field) {
  const std::string wanted = c.data.parameters.text("sampler");
  return wanted.empty() ? field.sampler : wanted;
}

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

// The medium in values of tf_domain; `voxel` is the data's smallest spacing in world units.
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
  const double pulse = registry.get<EstimatorPlugin>("estimator", c.estimator.type).dirac_pulse(c.estimator.parameters);
  if (pulse == 0 || medium.dirac.empty()) return medium;
  notes.push_back("estimator: Dirac terms are approximated by pulses of width " + short_number(pulse));
  return with_pulses(medium, pulse);
}

void refuse_impossible(const ResolvedCase& c, const Medium& medium, const EstimatorDeclaration& d) {
  Terms missing;
  missing.bits = medium.terms().bits & ~d.handles;
  const auto& keys = c.estimator.parameters.declared();
  const bool pulses = std::any_of(keys.begin(), keys.end(),
                                  [](const Parameter& p) { return p.name == std::string("approximate_dirac"); });
  const std::string hint =
      missing.dirac() && pulses ? "; estimator.approximate_dirac can stand pulses in for Dirac terms" : "";
  if (missing.bits != 0)
    throw InputError("estimator.type: estimator \"" + c.estimator.type + "\" cannot integrate the terms " +
                     missing.text() + " of optical model \"" + c.optical_model.type +
                     "\"; choose another estimator (dvrlab list estimator) or remove these terms" + hint);
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

/// Skipping concerns samples at equal distances only.
bool skips(const ResolvedCase& c) { return !samples_cells(c) && c.sampling.parameters.boolean("skipping"); }

/// World units. Where segments follow the cells of the data, estimators are told a voxel.
double step_of(const ResolvedCase& c, const Field& field, std::vector<std::string>& notes) {
  if (samples_cells(c)) return field.voxel;
  const ParameterSet& p = c.sampling.parameters;
  if (p.text("unit") != "voxel") return p.number("step");
  const double step = p.number("step") * field.voxel;
  char text[120];
  std::snprintf(text, sizeof(text), "sampling.step: %g voxel = %.9g world units (smallest spacing %.9g)",
                p.number("step"), step, field.voxel);
  notes.emplace_back(text);
  return step;
}

void add_sampling(const ResolvedCase& c, double step, KernelUnit& unit) {
  const ParameterSet& p = c.sampling.parameters;
  const double jitter = samples_cells(c) ? 0.0 : p.number("jitter");
  const auto background = c.image.vector3("background");
  const bool linear = c.image.text("space") == "linear";
  const auto decode = [&](double x) { return linear ? display_to_linear(x) : x; };
  unit.uniforms.insert(
      unit.uniforms.end(),
      {Uniform::real("frame_step", step), Uniform::real("frame_inv_step", 1.0 / step),
       Uniform::constant_integer("frame_jitter_on", jitter > 0 ? 1 : 0), Uniform::real("frame_jitter", jitter),
       // The same 32 bits: the hash takes the seed as they are.
       Uniform::integer("frame_seed", static_cast<int>(static_cast<std::uint32_t>(c.top.integer("seed")))),
       Uniform::real("frame_termination", p.number("termination")),
       Uniform::vector("frame_background", decode(background[0]), decode(background[1]), decode(background[2]))});
}

// Whole numbers of segments stay exact in fp32 far beyond this; software GPUs cut a loop after 65535 rounds.
constexpr double most_segments = 65535;

// A ray passes at most the diagonal of the domain, and what the camera allows.
void refuse_tiny_step(const Field& field, double step, const KernelUnit& frame) {
  const auto number = [&](const char* name) {
    for (const Uniform& u : frame.uniforms)
      if (u.name == name) return u.f[0];
    return 0.0;
  };
  const double diagonal = length(field.to_world.vector(minus(field.hi, field.lo)));
  const double segments = std::min(diagonal, number("frame_t1") - number("frame_t0")) / step;
  if (segments <= most_segments) return;
  char text[200];
  std::snprintf(text, sizeof(text),
                "sampling.step: %.6g world units make up to %.3g segments on a ray; at most %g are marched, "
                "so use a step of at least %.6g world units",
                step, segments, most_segments, step * segments / most_segments);
  throw InputError(text);
}

// Skipping only concerns grids; without it the kernel's binding holds one macrocell that is never empty.
void add_skipping(bool wanted, const Field& field, const Medium& medium, const MediumTableOptions& options,
                  KernelUnit& unit) {
  const auto* grid = dynamic_cast<const GridField*>(&field);
  std::vector<std::uint8_t> distance(4, 0);
  std::array<int, 3> dims{1, 1, 1};
  const bool skip = wanted && grid != nullptr;
  if (skip) {
    const auto cells = macrocells_of(*grid);
    dims = cells->dims;
    distance = empty_distance(*cells, OccupiedBins(medium, options));
  }
  unit.uniforms.insert(
      unit.uniforms.end(),
      {Uniform::constant_integer("frame_skip", skip ? 1 : 0), Uniform::integer("frame_skip_nx", dims[0]),
       Uniform::integer("frame_skip_ny", dims[1]), Uniform::integer("frame_skip_nz", dims[2])});
  const std::uint64_t count = distance.size();
  unit.buffers.push_back(make_buffer("frame_skip_distance", Element::u8, std::move(distance), count));
}

}  // namespace

std::shared_ptr<const Field> FieldCache::load(const ResolvedCase& c, const Registry& registry) {
  const std::string key = field_key(c);
  for (const auto& [known, field] : entries_)
    if (known == key) return field;
  auto field = registry.get<DataPlugin>("data", c.data.type, "data.type").load(c.data.parameters, load_context(c));
  keep(c, field);
  return field;
}

void FieldCache::keep(const ResolvedCase& c, std::shared_ptr<const Field> field) {
  entries_.clear();  // one field at a time: the axes run data outermost, and memory is what limits
  entries_.emplace_back(field_key(c), std::move(field));
}

void check_case(const ResolvedCase& c, const Registry& registry, Problems& problems) {
  const auto part = [&](auto check) {
    try {
      check();
    } catch (const InputError& e) {
      problems.add(e.what());
    } catch (const NotSupported&) {  // a plugin that cannot be made: the verdict of the case when it runs
    }
  };
  part([&] {
    std::vector<std::string> notes;
    const Medium medium = model_medium(c, registry, 1.0, 0.0, 1.0, notes);
    refuse_impossible(c, medium,
                      registry.get<EstimatorPlugin>("estimator", c.estimator.type, "estimator.type")
                          .declaration(c.estimator.parameters));
  });
  part([&] {
    const std::string refusal = registry.get<BackendPlugin>("backend", c.backend.type, "backend.type")
                                    .refuses(precision_of(c), c.backend.parameters);
    if (!refusal.empty()) throw InputError("precision: backend \"" + c.backend.type + "\" " + refusal);
  });
  part([&] { check_cells(c); });
  if (c.illumination.size() > 1)
    problems.add("illumination[1]: a second local shading pass would replace the first (" + c.illumination[0].type +
                 "); give one");
  part([&] {
    const std::string sampler = c.data.parameters.text("sampler");
    if (!sampler.empty()) registry.get<SamplerPlugin>("sampler", sampler, "data.sampler");
  });
  // Cameras, planes and lights that point nowhere do so in every box.
  FormulaField box;
  box.lo = {-1, -1, -1};
  KernelUnit unused;
  part([&] { add_camera(c.camera, box, 2, 2, unused); });
  for (const Section& plane : c.clip) part([&] { add_clipping({plane}, box, unused); });
  ResolvedCase alone;  // a light, then the passes
  alone.camera = c.camera;
  for (const Section& light : c.lights) {
    alone.lights = {light};
    part([&] { local_shading(alone, registry, box, false); });
  }
  alone.lights.clear();
  alone.illumination = c.illumination;
  part([&] { local_shading(alone, registry, box, false); });
}

void state_scene_bytes(const ResolvedCase& c, const Registry& registry, const Field& field, MemoryBill& memory) {
  const auto* grid = dynamic_cast<const GridField*>(&field);
  if (grid != nullptr) memory.state("data", static_cast<double>(grid->bytes()));
  if (grid != nullptr && skips(c)) memory.state("skipping", static_cast<double>(skipping_bytes(grid->dims)));
  memory.state("transfer function table", static_cast<double>(c.optical_model.parameters.integer("tf_entries")) *
                                              medium_columns * (sizeof(float) + sizeof(double)));
  std::vector<std::string> notes;
  const std::string sampler = sampler_of(c, field);
  memory.state("sampler '" + sampler + "'",
               static_cast<double>(registry.get<SamplerPlugin>("sampler", sampler).bytes_needed(field)));
  memory.state("estimator '" + c.estimator.type + "'",
               static_cast<double>(
                   registry.get<EstimatorPlugin>("estimator", c.estimator.type)
                       .bytes_needed(c.estimator.parameters, model_medium(c, registry, 1, 0, 1, notes).terms())));
  for (const Section& s : c.illumination)
    memory.state(
        "illumination '" + s.type + "'",
        static_cast<double>(registry.get<IlluminationPlugin>("illumination", s.type).bytes_needed(s.parameters)));
}

Scene build_scene(const ResolvedCase& c, const Registry& registry, std::shared_ptr<const Field> field) {
  Scene scene;
  scene.field = field;
  scene.notes = field->notes;
  scene.step = step_of(c, *field, scene.notes);

  const TfDomain domain = tf_domain(c.optical_model.parameters, *field);
  if (!domain.note.empty()) scene.notes.push_back(domain.note);
  const double slope = domain.slope(*field), intercept = domain.intercept(*field);
  const auto [lowest, highest] =
      std::minmax({slope * field->stored_min + intercept, slope * field->stored_max + intercept});
  scene.medium = model_medium(c, registry, field->voxel, lowest, highest, scene.notes).rescaled(slope, intercept);
  const EstimatorPlugin& estimator = registry.get<EstimatorPlugin>("estimator", c.estimator.type, "estimator.type");
  const EstimatorDeclaration declared = estimator.declaration(c.estimator.parameters);
  refuse_impossible(c, scene.medium, declared);

  FrameJob& job = scene.job;
  const nlohmann::json& size = c.image.json("size");
  job.width = size[0].get<int>();
  job.height = size[1].get<int>();
  job.precision = precision_of(c);
  job.kernel_folder = Registry::kernel_folder();
  if (!c.limits.is_null("gpu_buffer")) job.gpu_buffer_limit = std::uint64_t(c.limits.integer("gpu_buffer"));

  const Terms terms = scene.medium.terms();
  const LocalShading shading = local_shading(c, registry, *field, c.image.text("space") == "linear");
  const bool surfaces = terms.surfaces();
  const bool shaded = scene.medium.shaded();
  if (shaded && shading.mode == LocalShading::Mode::none)
    scene.notes.emplace_back("optical_model: shaded, but there is no illumination pass: rendered unlit (k = 1, b = 0)");
  job.rgb = terms.rgb();
  job.full = surfaces || terms.dirac() || shading.mode == LocalShading::Mode::prescribed ||
             (shaded && shading.mode != LocalShading::Mode::none);
  MediumTableOptions options = table_options(c, *field);
  options.rgb = job.rgb;
  options.full = job.full;
  options.fold_shaded = !job.full;

  job.frame.plugin = "frame";
  add_camera(c.camera, *field, job.width, job.height, job.frame);
  if (!samples_cells(c)) refuse_tiny_step(*field, scene.step, job.frame);
  add_clipping(c.clip, *field, job.frame);
  add_sampling(c, scene.step, job.frame);
  add_skipping(skips(c), *field, scene.medium, options, job.frame);
  add_medium(scene.medium, options, job.frame);
  add_discrete_surfaces(scene.medium, options.fold_shaded, job.frame);
  add_means(scene.medium, options, declared.mean_bins, declared.barycentre && job.full, job.frame);
  add_shading(shading, std::abs(field->slope), job.frame);
  const bool gradient = job.full && shaded && shading.mode == LocalShading::Mode::blinn_phong;
  job.frame.uniforms.insert(
      job.frame.uniforms.end(),
      {Uniform::constant_integer("frame_samples_ends", declared.samples == EstimatorDeclaration::Samples::ends ? 1 : 0),
       Uniform::constant_integer("frame_cuts_diracs", declared.cuts_diracs ? 1 : 0),
       Uniform::constant_integer("frame_neighbours", declared.neighbours && surfaces ? 1 : 0),
       Uniform::constant_integer("frame_gradient", gradient ? 1 : 0)});

  const std::string sampler = sampler_of(c, *field);
  job.sampler = registry.get<SamplerPlugin>("sampler", sampler).bind(*field);
  job.sampler.plugin = sampler;
  job.sampler.folder = registry.find("sampler", sampler).folder;
  if (samples_cells(c))
    add_cells(c, *field, registry.get<SamplerPlugin>("sampler", sampler).along_ray(), sampler,
              OccupiedBins(scene.medium, options), job.frame);
  if ((samples_cells(c) || walks(job.sampler)) && (declared.fixed_length || (declared.neighbours && surfaces)))
    throw InputError("estimator.type: estimator \"" + c.estimator.type +
                     "\" needs equally spaced samples, but sampler \"" + sampler +
                     "\" ends its segments at the faces of cells; choose another estimator");
  job.estimator.plugin = c.estimator.type;
  job.estimator.folder = c.estimator.folder;
  job.estimator.uniforms = uniforms_of(c.estimator.type, c.estimator.parameters);
  Medium seen = scene.medium;
  if (declared.cuts_diracs) seen.dirac.clear();
  const auto start = std::chrono::steady_clock::now();
  estimator.prepare(c.estimator.parameters,
                    {&seen, options.lo, options.hi, scene.step, job.full,
                     shading.mode == LocalShading::Mode::prescribed, job.precision, c.estimator.folder},
                    job.estimator);
  scene.table_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return scene;
}

}  // namespace dvrlab
