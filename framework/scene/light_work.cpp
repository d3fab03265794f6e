#include "framework/scene/light_work.h"

#include <algorithm>
#include <cmath>

#include "framework/interfaces/error.h"
#include "framework/scene/buffers.h"
#include "framework/scene/camera.h"
#include "framework/scene/image_setting.h"
#include "framework/scene/light_extinction.h"
#include "framework/scene/vector.h"

namespace dvrlab {
namespace {

const Section* volume_pass(const ResolvedCase& c, const Registry& registry) {
  for (const Section& s : c.illumination)
    if (registry.get<IlluminationPlugin>("illumination", s.type).fills_light_volume()) return &s;
  return nullptr;
}

/// The data's own grid, else one of `longest` points along the longest side, with cubes for cells.
std::array<int, 3> light_dims(const Field& field, int longest) {
  if (const auto* grid = dynamic_cast<const GridField*>(&field)) return grid->dims;
  Vector3 side;
  for (std::size_t a = 0; a < 3; ++a) {
    Vector3 edge{0, 0, 0};
    edge[a] = field.hi[a] - field.lo[a];
    side[a] = length(field.to_world.vector(edge));
  }
  const double cell = *std::max_element(side.begin(), side.end()) / (longest - 1);
  std::array<int, 3> dims;
  for (std::size_t a = 0; a < 3; ++a) dims[a] = std::max(2, static_cast<int>(std::lround(side[a] / cell)) + 1);
  return dims;
}

Vector3 grid_step(const Field& field, const std::array<int, 3>& dims) {
  Vector3 step;
  for (std::size_t a = 0; a < 3; ++a) step[a] = (field.hi[a] - field.lo[a]) / (dims[a] - 1);
  return step;
}

double smallest_spacing(const Field& field, const Vector3& step) {
  double smallest = 1e300;
  for (std::size_t a = 0; a < 3; ++a) {
    Vector3 edge{0, 0, 0};
    edge[a] = step[a];
    smallest = std::min(smallest, length(field.to_world.vector(edge)));
  }
  return smallest;
}

/// A head light stands at the eye, or lies in the direction that all rays come from.
Light without_head(const Light& light, const Section& camera, const Frame& frame) {
  if (light.type != Light::Type::head) return light;
  Light l = light;
  if (camera.type == "ray") {
    l.type = Light::Type::directional;
    l.position = unit_vector(times(camera.parameters.vector3("direction"), -1.0), "camera.direction: is 0");
    return l;
  }
  const Eye eye = eye_of(camera, frame);
  const bool parallel = camera.type == "orthographic" ||
                        (camera.type == "orbit" && camera.parameters.text("projection") == "orthographic");
  l.type = parallel ? Light::Type::directional : Light::Type::point;
  l.position = parallel ? eye.back : eye.position;
  return l;
}

Uniform vec(const char* name, const Vector3& v) { return Uniform::vector(name, v[0], v[1], v[2]); }

void add_sources(const LightSetting& s, const Field& field, KernelUnit& unit) {
  const Affine inverse = s.to_world.inverse();
  std::vector<double> source;
  int points = 0;
  for (std::size_t l = 0; l < s.light.size(); ++l) {
    const Light& light = s.light[l];
    const bool point = light.type == Light::Type::point;
    if (point) points |= 1 << l;
    const Vector3 place = point ? inverse.point(light.position) : s.sampler_direction(light.position);
    source.insert(source.end(),
                  {place[0], place[1], place[2], 0, light.position[0], light.position[1], light.position[2], 0});
  }
  const auto& m = s.to_world.m;
  const auto& i = inverse.m;
  unit.uniforms.insert(
      unit.uniforms.end(),
      {vec("light_lo", field.lo), vec("light_hi", field.hi), Uniform::vector("light_world_x", m[0], m[1], m[2]),
       Uniform::vector("light_world_y", m[3], m[4], m[5]), Uniform::vector("light_world_z", m[6], m[7], m[8]),
       Uniform::vector("light_sampler_x", i[0], i[1], i[2]), Uniform::vector("light_sampler_y", i[3], i[4], i[5]),
       Uniform::vector("light_sampler_z", i[6], i[7], i[8]), Uniform::integer("light_points", points)});
  unit.buffers.push_back(vec4_buffer("light_source", std::move(source)));
}

void add_points(const LightSetting& s, const Field& field, KernelUnit& unit) {
  Vector3 scale;
  for (std::size_t a = 0; a < 3; ++a) scale[a] = (s.dims[a] - 1) / (field.hi[a] - field.lo[a]);
  const auto plane = static_cast<int>(s.points(1).points());
  constexpr double nudge = 1.0 / 256;  // voxels: behind a face, whatever was rounded
  unit.uniforms.insert(unit.uniforms.end(),
                       {Uniform::integer("light_points_nx", s.dims[0]), Uniform::integer("light_points_ny", s.dims[1]),
                        Uniform::integer("light_points_nz", s.dims[2]), Uniform::integer("light_points_plane", plane),
                        vec("light_points_lo", field.lo), vec("light_points_scale", scale),
                        Uniform::real("light_nudge", nudge * s.voxel)});
  add_blocks(s.blocks, unit);
}

/// How many of the medium's bins before one may contribute, and two more entries, as medium_shaded_sum has them.
std::vector<int> lit_sums(const OccupiedBins& occupied, const MediumTableOptions& o) {
  std::vector<int> sum{0};
  const auto value = [&](int entry) { return o.lo + (o.hi - o.lo) * entry / (o.entries - 1); };
  for (int b = 0; b + 1 < o.entries; ++b) sum.push_back(sum.back() + (occupied.empty(value(b), value(b + 1)) ? 0 : 1));
  sum.push_back(sum.back());
  sum.push_back(sum.back());
  return sum;
}

}  // namespace

Vector3 LightSetting::sampler_direction(const Vector3& world) const { return to_world.inverse().vector(world); }

int LightSetting::channels_from(int first_light) const {
  return rgb ? 3 : std::min(lights_per_volume(), static_cast<int>(light.size()) - first_light);
}

LightGrid light_points(const std::array<int, 3>& dims, const BlockedField* blocks, int channels) {
  if (blocks == nullptr) return {dims, channels};
  constexpr int row = BlockedField::row;
  return {{row, static_cast<int>(blocks->samples / row), 1}, channels, true};
}

std::uint64_t LightWork::bytes() const {
  // The light volume itself has three numbers per point at the most.
  std::uint64_t numbers = light_points(dims, blocks.get(), 3).numbers();
  for (std::size_t k = 0; k < plan.stages.size(); ++k) {
    const LightStage& s = plan.stages[k];
    // Of a chain of one kernel two are there at once: the one that is filled and the one before it.
    const bool chained = std::any_of(s.reads.begin(), s.reads.end(), [&](const StageRead& r) {
      return r.stage >= 0 && plan.stages[std::size_t(r.stage)].kernel == s.kernel;
    });
    const bool dropped = chained && k + 1 < plan.stages.size() && plan.stages[k + 1].kernel == s.kernel;
    if (!dropped) numbers += s.grid.numbers();
  }
  return numbers * sizeof(float);
}

bool fills_light_volume(const ResolvedCase& c, const Registry& registry) { return volume_pass(c, registry) != nullptr; }

std::shared_ptr<LightWork> light_work(const ResolvedCase& c, const Registry& registry, const Field& field,
                                      const Medium& medium, const MediumTableOptions& options,
                                      const LocalShading& shading, double value_per_stored, double value_of_zero,
                                      std::shared_ptr<const BlockedField> blocks) {
  const Section* pass = volume_pass(c, registry);
  if (pass == nullptr) return nullptr;
  const auto& plugin = registry.get<IlluminationPlugin>("illumination", pass->type);
  const Frame frame(field);
  LightSetting setting;
  setting.dims = light_dims(field, plugin.resolution(pass->parameters));
  setting.blocks = blocks.get();
  setting.to_world = field.to_world;
  setting.to_world.t = minus(setting.to_world.t, frame.centre());
  setting.box_diagonal = length(field.to_world.vector(minus(field.hi, field.lo)));
  setting.voxel = smallest_spacing(field, grid_step(field, setting.dims));
  for (const Light& light : shading.light) setting.light.push_back(without_head(light, c.camera, frame));
  setting.rgb = medium.terms().rgb();
  setting.value_lo = value_per_stored * options.lo + value_of_zero;
  setting.value_hi = value_per_stored * options.hi + value_of_zero;
  setting.entries = options.entries;
  setting.largest_tau = largest_extinction(medium, options);
  setting.surfaces = medium.terms().surfaces() || !medium.dirac.empty() || !medium.opaque.empty();
  setting.seed = static_cast<std::uint32_t>(c.top.integer("seed"));
  setting.local_shading = shading.mode != LocalShading::Mode::none;
  setting.image_size = rays_of_image(c);
  setting.image = [&] { return image_setting(c, field, medium, options); };

  auto work = std::make_shared<LightWork>();
  work->plan = plugin.plan(pass->parameters, setting);
  for (LightStage& s : work->plan.stages) s.folder = pass->folder;
  work->rays.plugin = "light";
  add_sources(setting, field, work->rays);
  add_points(setting, field, work->rays);
  add_light_extinction(medium, options, work->plan.opacity_scale, setting.voxel, work->rays);
  work->lo = field.lo;
  work->hi = field.hi;
  work->dims = setting.dims;
  work->blocks = std::move(blocks);
  work->rgb = setting.rgb;
  // Beside local shading, which has the lights' colours already, the volume says what part of the light arrives.
  Vector3 sum{0, 0, 0};
  for (const Light& l : setting.light) sum = plus(sum, l.color);
  for (const Light& l : setting.light) {
    Vector3 color = l.color;
    if (shading.mode != LocalShading::Mode::none)
      for (std::size_t ch = 0; ch < 3; ++ch)
        color[ch] = sum[ch] > 0 ? color[ch] / sum[ch] : 1.0 / static_cast<double>(setting.light.size());
    work->color.push_back(color);
  }
  return work;
}

void add_light_volume(const LightWork* work, const OccupiedBins& occupied, const MediumTableOptions& options,
                      KernelUnit& unit) {
  const auto at = [&](std::size_t a) { return work != nullptr ? work->dims[a] : 2; };
  const LightGrid points = work != nullptr ? light_points(work->dims, work->blocks.get(), 1) : LightGrid{};
  Vector3 lo{0, 0, 0}, scale{1, 1, 1};
  for (std::size_t a = 0; work != nullptr && a < 3; ++a) {
    lo[a] = work->lo[a];
    scale[a] = (work->dims[a] - 1) / (work->hi[a] - work->lo[a]);
  }
  unit.uniforms.insert(
      unit.uniforms.end(),
      {Uniform::constant_integer("frame_lit", work != nullptr ? light_planes(*work) : 0),
       Uniform::integer("frame_light_nx", at(0)), Uniform::integer("frame_light_ny", at(1)),
       Uniform::integer("frame_light_nz", at(2)), vec("frame_light_lo", lo), vec("frame_light_scale", scale),
       Uniform::integer("frame_light_plane", static_cast<int>(points.points())),
       Uniform::constant_integer("frame_light_stored", work != nullptr ? static_cast<int>(work->plan.storage) : 0),
       Uniform::real("frame_light_unit", 1)});
  std::vector<int> kept{0};
  if (work != nullptr) kept = lit_sums(occupied, options);
  const std::uint64_t count = work != nullptr ? kept.size() : 0;
  unit.buffers.push_back(make_buffer("medium_lit_sum", Element::i32, std::move(kept), count));
  // One of the two is filled by the session (BackendSession::render).
  unit.buffers.push_back(make_buffer("frame_light_levels", Element::u16, std::vector<std::uint16_t>(8), 0));
  Buffer volume = make_buffer("frame_light_volume", Element::f32, std::vector<float>(8), 0);
  volume.data64 = make_buffer("", Element::f32, std::vector<double>(8), 0).data;
  unit.buffers.push_back(std::move(volume));
}

}  // namespace dvrlab
