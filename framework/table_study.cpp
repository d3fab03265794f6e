#include "framework/table_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/config/document.h"
#include "framework/scene/case_medium.h"
#include "framework/scene/sampling.h"
#include "framework/scene/scene.h"

namespace dvrlab {
namespace {

/// A grid whose columns along z are the pairs: v0 in the upper layer, which a ray from above meets first, v1 in the
/// lower one. Two by two columns are alike, so that a ray between them finds just their value, wherever it runs.
std::shared_ptr<GridField> pairs_of(const Field& field, double length, double lo, double hi, int points) {
  auto grid = std::make_shared<GridField>();
  static_cast<Field&>(*grid) = field;  // range, slope, units: what the medium depends on
  grid->sampler = "grid";
  const int side = 2 * points;
  grid->dims = {side, side, 2};
  grid->to_world = {{field.voxel, 0, 0, 0, field.voxel, 0, 0, 0, length}, {0, 0, 0}};
  grid->lo = {0, 0, 0};
  grid->hi = {side - 1.0, side - 1.0, 1};
  grid->type = VoxelType::f32;
  const auto value = [&](int k) {
    const double u = (k / 2) / std::max(points - 1.0, 1.0);
    return static_cast<float>(lo + (hi - lo) * u);
  };
  auto voxels = std::make_shared<std::vector<float>>();
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) voxels->push_back(value(z == 1 ? x : y));
  grid->voxels = {voxels, voxels->data()};
  return grid;
}

/// The case as a view from above on its pairs.
nlohmann::json pairs_config(const ResolvedCase& c, const GridField& grid, double length, int points) {
  nlohmann::json config = c.config;
  for (const char* key : {"axes", "reference", "expect", "metrics", "clip", "lights", "illumination"})
    config.erase(key);
  const double x = grid.hi[0] * grid.voxel, unit = 0.5 * std::sqrt(2 * x * x + length * length);
  config["camera"] = {{"type", "orthographic"}, {"frame", "data"}, {"position", {0, 0, 4}},
                      {"target", {0, 0, 0}},    {"up", {0, 1, 0}}, {"height", 2 * points * grid.voxel / unit}};
  config["sampling"] = {
      {"type", "uniform"}, {"step", length}, {"unit", "world"}, {"termination", 0}, {"skipping", false}};
  config["image"] = {{"size", {points, points}}, {"space", c.image.text("space")}};
  return config;
}

ResolvedCase resolve(const nlohmann::json& config, const ResolvedCase& like, const Registry& registry) {
  return plan_experiment(parse_document(config.dump(), "table", like.base_folder), registry).cases.front().resolved;
}

FrameImage image_of(const ResolvedCase& c, const Registry& registry, const std::shared_ptr<const Field>& field) {
  Scene scene = build_scene(c, registry, field);
  FrameResult result;
  registry.get<BackendPlugin>("backend", c.backend.type)
      .open(c.backend.parameters, c.backend.folder)
      ->render(scene.job, result);
  return std::move(result.image);
}

void cost(TableStudy& study, nlohmann::json config, const ResolvedCase& c, const Registry& registry,
          const std::shared_ptr<const Field>& field, int builds) {
  std::vector<double> seconds;
  for (int k = 0; k < builds; ++k) {
    // A step that differs in its last digits: nothing that was kept from an earlier build fits.
    config["sampling"]["step"] = study.length * (1 + 1e-13 * (k + 1));
    const Scene scene = build_scene(resolve(config, c, registry), registry, field);
    const auto phase = std::find_if(scene.times.begin(), scene.times.end(),
                                    [](const PhaseTime& t) { return t.phase == "estimator tables"; });
    seconds.push_back(phase->seconds);
    study.bytes = 0;
    for (const Buffer& b : scene.job.frame.buffers)
      if (b.name == "mean_table" && b.count > 0) study.bytes += b.data ? b.bytes() : b.bytes64();
    for (const Buffer& b : scene.job.estimator.buffers) study.bytes += b.data ? b.bytes() : b.bytes64();
  }
  std::nth_element(seconds.begin(), seconds.begin() + builds / 2, seconds.end());
  study.build_seconds = seconds[static_cast<std::size_t>(builds / 2)];
}

/// Entry [v1][v0] of a picture whose top row is the highest v1.
std::size_t pixel_of(std::size_t x, std::size_t y, std::size_t points) { return (points - 1 - y) * points + x; }

void judge(TableStudy& study, const FrameImage& image, const FrameImage& exact) {
  const std::size_t n = study.value.size();
  constexpr double edges[] = {0, 0.1, 0.5, 1, 2, 5, std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k + 1 < std::size(edges); ++k) study.classes.push_back({edges[k], edges[k + 1]});
  double sum = 0;
  for (std::size_t y = 0; y < n; ++y) {
    for (std::size_t x = 0; x < n; ++x) {
      double error = 0, depth = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i = 3 * pixel_of(x, y, n) + c;
        error = std::max({error, std::abs(image.radiance(i) - exact.radiance(i)),
                          std::abs(image.transmittance(i) - exact.transmittance(i))});
        depth = std::max(depth, -std::log(std::max(exact.transmittance(i), 1e-300)));
      }
      study.error.push_back(error);
      study.depth.push_back(depth);
      study.worst = std::max(study.worst, error);
      sum += error * error;
      for (DepthClass& d : study.classes) {
        if (depth < d.from || depth >= d.to) continue;
        ++d.pairs;
        d.worst = std::max(d.worst, error);
        d.rms += error * error;
      }
    }
  }
  study.rms = std::sqrt(sum / static_cast<double>(n * n));
  for (DepthClass& d : study.classes) d.rms = d.pairs > 0 ? std::sqrt(d.rms / static_cast<double>(d.pairs)) : 0;
}

}  // namespace

TableStudy study_table(const ResolvedCase& c, const Registry& registry, const Field& field, int points, int builds) {
  std::vector<std::string> notes;
  TableStudy study;
  study.length = step_of(c, field, notes);
  const MediumTableOptions range = table_options(c, field);
  const auto grid = pairs_of(field, study.length, range.lo, range.hi, points);
  const nlohmann::json config = pairs_config(c, *grid, study.length, points);
  nlohmann::json exact = config;
  exact["estimator"] = {{"type", "exact"}};
  exact["optical_model"]["tf"] = "nodes";
  exact["precision"] = "fp64";
  exact["backend"] = {{"type", "cpu"}};
  for (int k = 0; k < points; ++k)
    study.value.push_back(field.slope * (range.lo + (range.hi - range.lo) * k / std::max(points - 1.0, 1.0)) +
                          field.intercept);
  cost(study, config, c, registry, grid, builds);
  judge(study, image_of(resolve(config, c, registry), registry, grid),
        image_of(resolve(exact, c, registry), registry, grid));
  return study;
}

FrameImage error_picture(const TableStudy& study) {
  // Every two decades from 1e-8 on: black, blue, green, orange, white.
  constexpr std::array<Vector3, 5> ramp = {
      {{0, 0, 0}, {0.15, 0.25, 0.7}, {0.1, 0.65, 0.4}, {0.95, 0.6, 0.1}, {1, 1, 1}}};
  const std::size_t n = study.value.size();
  FrameImage image;
  image.width = image.height = static_cast<int>(n);
  image.color.resize(3 * n * n);
  image.trans.assign(3 * n * n, 0.0f);
  for (std::size_t y = 0; y < n; ++y) {
    for (std::size_t x = 0; x < n; ++x) {
      const double decades = std::clamp(std::log10(std::max(study.error[y * n + x], 1e-30)) + 8, 0.0, 8.0) / 2;
      const auto k = std::min<std::size_t>(static_cast<std::size_t>(decades), 3);
      for (std::size_t c = 0; c < 3; ++c)
        image.color[3 * pixel_of(x, y, n) + c] =
            static_cast<float>(ramp[k][c] + (ramp[k + 1][c] - ramp[k][c]) * (decades - static_cast<double>(k)));
    }
  }
  return image;
}

}  // namespace dvrlab
