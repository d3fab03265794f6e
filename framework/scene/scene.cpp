#include "framework/scene/scene.h"

#include <algorithm>
#include <cmath>

#include "framework/interfaces/blocks.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/mesh.h"
#include "framework/scene/bin_groups.h"
#include "framework/scene/camera.h"
#include "framework/scene/case_medium.h"
#include "framework/scene/cells.h"
#include "framework/scene/discrete_surfaces.h"
#include "framework/scene/image_setting.h"
#include "framework/scene/light_work.h"
#include "framework/scene/lighting.h"
#include "framework/scene/macrocells.h"
#include "framework/scene/mean_table.h"
#include "framework/scene/phase_clock.h"
#include "framework/scene/sampling.h"
#include "framework/scene/tf_domain.h"

namespace dvrlab {

namespace {

std::string field_key(const ResolvedCase& c) { return c.config.at("data").dump() + "|" + c.base_folder; }

/// Of a walking sampler, world units.
double longest_segment(const ResolvedCase& c, const Field& field, double step) {
  const auto* mesh = dynamic_cast<const MeshField*>(&field);
  const Vector3 d =
      field.to_world.vector({field.hi[0] - field.lo[0], field.hi[1] - field.lo[1], field.hi[2] - field.lo[2]});
  const double longest = mesh != nullptr ? mesh->longest : std::hypot(d[0], d[1], d[2]);
  return samples_faces(c) ? std::min(longest, step) : longest;
}

std::shared_ptr<LightWork> light_work_of(const ResolvedCase& c, const Registry& registry, const Field& field,
                                         const Medium& medium, const MediumTableOptions& options,
                                         const LocalShading& shading, std::shared_ptr<const BlockedField> blocks) {
  const TfDomain domain = tf_domain(c.optical_model.parameters, field);
  return light_work(c, registry, field, medium, options, shading, domain.slope(field), domain.intercept(field),
                    std::move(blocks));
}

/// What light rays ask at positions: the frame's own sampler, or a grid that stands in for one that walks. Of one mesh
/// and grid it is made once.
KernelUnit light_sampler(const Registry& registry, const Field& field, const KernelUnit& own,
                         const std::array<int, 3>& dims) {
  if (!walks(own)) return own;
  const auto* mesh = dynamic_cast<const MeshField*>(&field);
  if (mesh == nullptr) return own;
  if (mesh->resampled == nullptr || mesh->resampled_dims != dims) {
    KernelUnit unit = registry.get<SamplerPlugin>("sampler", "resampled").bind_to(field, dims);
    unit.plugin = "resampled";
    unit.folder = registry.find("sampler", "resampled").folder;
    mesh->resampled = std::make_shared<KernelUnit>(std::move(unit));
    mesh->resampled_dims = dims;
  }
  return *mesh->resampled;
}

/// The sampler that reads the field: the config's, else the one that the data names.
std::string sampler_of(const ResolvedCase& c, const Field& field) {
  return c.sampler.type.empty() ? field.sampler : c.sampler.type;
}

/// As large as the sampler's blocks can become, with nothing in them; nullptr without blocks.
std::shared_ptr<const BlockedField> expected_blocks(const ResolvedCase& c, const Registry& registry,
                                                    const Field& field) {
  const std::uint64_t samples =
      registry.get<SamplerPlugin>("sampler", sampler_of(c, field)).most_samples(field, c.sampler.parameters);
  if (samples == 0) return nullptr;
  auto blocks = std::make_shared<BlockedField>();
  blocks->samples = (samples / BlockedField::row + 2) * BlockedField::row;
  return blocks;
}

std::shared_ptr<const BlockedField> blocks_of(const ResolvedCase& c, const Registry& registry, const Field& field,
                                              const Medium& medium, const MediumTableOptions& options,
                                              const OccupiedBins& occupied, int cells) {
  const auto empty = [&](double a, double b) { return occupied.empty(a, b); };
  return registry.get<SamplerPlugin>("sampler", sampler_of(c, field), "sampler.type")
      .arrange(field, c.sampler.parameters,
               {medium, options.entries, options.lo, options.hi, cells, empty, c.image.text("space") == "linear"});
}

}  // namespace

LoadContext load_context(const ResolvedCase& c) {
  return {c.base_folder, c.data.parameters.text("nan_policy"), c.data.parameters.number("nan_value")};
}

void require_data(const ResolvedCase& c) {
  const ParameterSet& p = c.data.parameters;
  if (!p.boolean("optional") || !c.config["data"].contains("file")) return;
  try {
    resolve_path(p.text("file"), load_context(c), p.path_of("file"));
  } catch (const InputError& e) {
    throw NotSupported(e.what());
  }
}

Precision precision_of(const ResolvedCase& c) { return static_cast<Precision>(c.top.choice_index("precision")); }

std::shared_ptr<const Field> FieldCache::load(const ResolvedCase& c, const Registry& registry) {
  const std::string key = field_key(c);
  for (const auto& [known, field] : entries_)
    if (known == key) return field;
  require_data(c);
  auto field = registry.get<DataPlugin>("data", c.data.type, "data.type").load(c.data.parameters, load_context(c));
  keep(c, field);
  return field;
}

void FieldCache::keep(const ResolvedCase& c, std::shared_ptr<const Field> field) {
  entries_.clear();  // one field at a time: the axes run data outermost, and memory is what limits
  entries_.emplace_back(field_key(c), std::move(field));
}

void state_scene_bytes(const ResolvedCase& c, const Registry& registry, const Field& field, MemoryBill& memory) {
  const auto* grid = dynamic_cast<const GridField*>(&field);
  if (grid != nullptr) memory.state("data", static_cast<double>(grid->bytes()));
  if (const auto* mesh = dynamic_cast<const MeshField*>(&field))
    memory.state("data", static_cast<double>(mesh->bytes()));
  if (grid != nullptr && skips(c)) memory.state("skipping", static_cast<double>(skipping_bytes(grid->dims)));
  memory.state("transfer function table", static_cast<double>(c.optical_model.parameters.integer("tf_entries")) *
                                              medium_columns * (sizeof(float) + sizeof(double)));
  const std::string sampler = sampler_of(c, field);
  memory.state(
      "sampler '" + sampler + "'",
      static_cast<double>(
          registry.get<SamplerPlugin>("sampler", sampler, "sampler.type").bytes_needed(field, c.sampler.parameters)));
  std::vector<std::string> notes;
  const Medium medium = stored_medium(c, registry, field, notes);
  const LocalShading shading = local_shading(c, registry, field, c.image.text("space") == "linear");
  const EstimatorPlugin& estimator = registry.get<EstimatorPlugin>("estimator", c.estimator.type);
  const EstimatorDeclaration declared = estimator.declaration(c.estimator.parameters);
  const MediumTableOptions options = table_options(c, field, medium, shading, declared);
  TableLayout layout = table_layout(c, medium, options);
  layout.walks = dynamic_cast<const MeshField*>(&field) != nullptr;
  memory.state("estimator '" + c.estimator.type + "'",
               static_cast<double>(estimator.bytes_needed(c.estimator.parameters, layout)));
  if (declared.mean_bins > 0)
    memory.state("mean tables", static_cast<double>(mean_table_bytes(declared.mean_bins, layout.groups + 1,
                                                                     layout.precision == Precision::fp64)));
  if (shading.light_volume) {
    const auto work = light_work_of(c, registry, field, medium, options, shading, expected_blocks(c, registry, field));
    const double precisions = precision_of(c) == Precision::fp64 ? 3 : 1;
    memory.state("light volumes", static_cast<double>(work->bytes()) * precisions);
  }
}

Scene build_scene(const ResolvedCase& c, const Registry& registry, std::shared_ptr<const Field> field) {
  Scene scene;
  scene.field = field;
  scene.notes = field->notes;
  scene.step = step_of(c, *field, scene.notes);

  PhaseClock clock;
  const auto end_phase = [&](const char* phase) {
    scene.times.push_back({phase, clock.wall(), clock.cpu()});
    clock = {};
  };
  scene.medium = stored_medium(c, registry, *field, scene.notes);
  const EstimatorPlugin& estimator = registry.get<EstimatorPlugin>("estimator", c.estimator.type, "estimator.type");
  const EstimatorDeclaration declared = estimator.declaration(c.estimator.parameters);
  refuse_impossible(c, scene.medium, declared);
  end_phase("medium");

  FrameJob& job = scene.job;
  scene.rays_per_side = static_cast<int>(c.image.integer("supersampling"));
  const auto [width, height] = rays_of_image(c);
  job.width = width;
  job.height = height;
  job.precision = precision_of(c);
  job.kernel_folder = Registry::kernel_folder();
  if (!c.limits.is_null("gpu_buffer")) job.gpu_buffer_limit = std::uint64_t(c.limits.integer("gpu_buffer"));

  const Terms terms = scene.medium.terms();
  const LocalShading shading = local_shading(c, registry, *field, c.image.text("space") == "linear");
  const bool surfaces = terms.surfaces();
  const bool shaded = scene.medium.shaded();
  if (shaded && shading.mode == LocalShading::Mode::none && !shading.light_volume)
    scene.notes.emplace_back("optical_model: shaded, but there is no illumination pass: rendered unlit (k = 1, b = 0)");
  const MediumTableOptions options = table_options(c, *field, scene.medium, shading, declared);
  job.rgb = options.rgb;
  job.full = options.full;
  const OccupiedBins occupied(scene.medium, options, declared.cells);
  const std::shared_ptr<const BlockedField> blocks =
      blocks_of(c, registry, *field, scene.medium, options, occupied, declared.cells);
  if (blocks != nullptr) {
    end_phase("blocks");
    scene.blocks = blocks->statistics;
  }

  job.frame.plugin = "frame";
  add_camera(c.camera, *field, job.width, job.height, job.frame);
  if (c.sampling.type == "uniform" && dynamic_cast<const MeshField*>(field.get()) == nullptr)
    refuse_tiny_step(*field, scene.step, job.frame);
  add_clipping(c.clip, *field, job.frame);
  add_sampling(c, *field, scene.step, job.frame);
  add_blocks(blocks.get(), job.frame);
  add_skipping(skips(c), *field, blocks.get(), occupied, job.frame);
  // What tables hold: of opaque values only what lies before them.
  const Medium before_opaque = continued_into_opaque(scene.medium);
  add_medium(before_opaque, options, job.frame);
  add_discrete_surfaces(scene.medium, options, declared.prediction, job.frame);
  const MediumLayout layout(before_opaque, options);
  const bool barycentre = declared.barycentre && job.full;
  add_shading(shading, std::abs(field->slope), job.frame);
  const bool gradient = job.full && shaded && shading.mode == LocalShading::Mode::blinn_phong;
  job.frame.uniforms.insert(
      job.frame.uniforms.end(),
      {Uniform::constant_integer("frame_samples_ends", declared.samples == EstimatorDeclaration::Samples::ends ? 1 : 0),
       Uniform::constant_integer("frame_opaque_at", declared.front_only    ? 2
                                                    : declared.pointwise() ? 1
                                                                           : 0),
       Uniform::constant_integer("frame_cuts_diracs", declared.cuts_diracs ? 1 : 0),
       Uniform::constant_integer("frame_segment_shading", declared.shading),
       Uniform::constant_integer("frame_neighbours", declared.neighbours && surfaces ? 1 : 0),
       Uniform::constant_integer("frame_gradient", gradient ? 1 : 0)});

  const std::string sampler = sampler_of(c, *field);
  const Field& bound = blocks != nullptr ? static_cast<const Field&>(*blocks) : *field;
  job.sampler = registry.get<SamplerPlugin>("sampler", sampler, "sampler.type").bind(bound);
  job.sampler.plugin = sampler;
  job.sampler.folder = registry.find("sampler", sampler).folder;
  job.frame.uniforms.push_back(
      Uniform::constant_integer("frame_walks", walks(job.sampler) || samples_cells(c) ? 1 : 0));
  if (shading.light_volume) {
    const auto work = light_work_of(c, registry, *field, scene.medium, options, shading, blocks);
    work->sampler = light_sampler(registry, *field, job.sampler, work->dims);
    job.light = work;
  }
  add_light_volume(job.light.get(), occupied, options, job.frame);
  if (samples_cells(c))
    add_cells(c, *field, registry.get<SamplerPlugin>("sampler", sampler).along_ray(), sampler,
              OccupiedBins(scene.medium, options, 0), job.frame);
  if (samples_faces(c) && !walks(job.sampler))
    throw InputError("sampling.type: \"faces\" ends segments at the faces of a mesh's cells, but sampler \"" + sampler +
                     "\" has none; use \"uniform\"");
  if (walks(job.sampler) && c.sampling.type == "uniform")
    scene.notes.emplace_back(
        "sampling: segments end at the faces of cells; sampling.step is not used (type \"faces\" cuts at a step too)");
  if (walks(job.sampler) && (declared.fixed_length || declared.nominal_length || (declared.neighbours && surfaces)))
    throw InputError(
        "estimator.type: estimator \"" + c.estimator.type +
        "\" needs equally spaced samples with these parameters, but sampler \"" + sampler +
        "\" ends its segments at the faces of cells; choose another estimator" +
        (declared.nominal_length ? ", or one whose tables are not those of the step (lookup \"corrected\")" : ""));
  job.estimator.plugin = c.estimator.type;
  job.estimator.folder = c.estimator.folder;
  job.estimator.uniforms = uniforms_of(c.estimator.type, c.estimator.parameters);
  Medium seen = before_opaque;
  if (declared.cuts_diracs) seen.dirac.clear();
  end_phase("frame tables");
  BinMedium bins;
  if (declared.mean_bins > 0)
    bins = bin_groups(before_opaque, layout, options.lo, options.hi, declared.mean_bins, barycentre);
  estimator.shape_bins(c.estimator.parameters, scene.step, bins);
  add_means(bins, barycentre, job.precision == Precision::fp64, job.frame);
  estimator.prepare(c.estimator.parameters,
                    {&seen, options.lo, options.hi, scene.step, job.full, options.lit_particles, job.precision,
                     c.estimator.folder, walks(job.sampler) ? longest_segment(c, *field, scene.step) : 0.0, &bins},
                    job.estimator);
  // A mean is six fetches per group; the bin of the next opaque value is one.
  job.table_fetches = declared.points * fetches_of_point(before_opaque, options) + declared.means * 6 * layout.count() +
                      (scene.medium.opaque.empty() ? 0 : 1) + job.estimator.fetches;
  end_phase("estimator tables");
  return scene;
}

}  // namespace dvrlab
