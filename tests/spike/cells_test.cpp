// Sampling "cells" under an estimator that is exact on linear segments: what is left of the error is the tolerance.
// Curved rays through a grid against an integration of their own, and a golden curved ray through a formula.
#include <algorithm>
#include <cmath>
#include <random>

#include "framework/interfaces/error.h"
#include "tests/spike/spike.h"
#include "tests/spike/tets.h"
#include "tests/support/reference.h"

namespace dvrlab {
namespace {

using namespace spike;
using nlohmann::json;
using test::RayIntegral;

constexpr int side = 5;
const Vector3 entry{-0.4, 0.35, 0.7}, toward{4.9, 3.1, 2.6};

/// Random voxels, one world unit apart.
std::shared_ptr<GridField> random_grid() {
  auto grid = std::make_shared<GridField>();
  grid->dims = {side, side, side};
  grid->type = VoxelType::f32;
  auto voxels = std::make_shared<std::vector<float>>(side * side * side);
  std::mt19937 random(4);
  for (float& v : *voxels) v = static_cast<float>(random() % 1000) / 999;
  grid->voxels = {voxels, voxels->data()};
  grid->source = "random voxels of a test";
  finish_grid(*grid, "error", 0);
  return grid;
}

double trilinear(const GridField& grid, const Vector3& p) {
  std::array<int, 3> i;
  Vector3 f;
  for (std::size_t a = 0; a < 3; ++a) {
    i[a] = std::clamp(static_cast<int>(std::floor(p[a])), 0, side - 2);
    f[a] = p[a] - i[a];
  }
  double v = 0;
  for (int c = 0; c < 8; ++c) {
    const int x = c & 1, y = c >> 1 & 1, z = c >> 2;
    v += grid.at(i[0] + x, i[1] + y, i[2] + z) * (x ? f[0] : 1 - f[0]) * (y ? f[1] : 1 - f[1]) * (z ? f[2] : 1 - f[2]);
  }
  return v;
}

/// The ray's way through the box, by arc length from the entry point.
struct Way {
  std::vector<double> plane;  // where cells end, from 0 to the exit
  std::function<double(double)> v;
};
Way way_through(const GridField& grid) {
  const double n = std::hypot(toward[0], toward[1], toward[2]);
  double t0 = 0, t1 = 1e30;
  for (std::size_t a = 0; a < 3; ++a) {
    t0 = std::max(t0, (0 - entry[a]) / (toward[a] / n));
    t1 = std::min(t1, (side - 1 - entry[a]) / (toward[a] / n));
  }
  Way way{{0, t1 - t0}, [&grid, t0, n](double l) {
            Vector3 p;
            for (std::size_t a = 0; a < 3; ++a) p[a] = entry[a] + (t0 + l) * toward[a] / n;
            return trilinear(grid, p);
          }};
  for (std::size_t a = 0; a < 3; ++a)
    for (int k = 1; k < side - 1; ++k) {
      const double l = (k - entry[a]) / (toward[a] / n) - t0;
      if (l > 0 && l < t1 - t0) way.plane.push_back(l);
    }
  std::sort(way.plane.begin(), way.plane.end());
  return way;
}

const json extinction = {{0, 0.1}, {0.3, 0.05}, {0.35, 1.9}, {0.5, 0.3}, {0.5, 0.9}, {1, 0.4}};
const json color = {{0, 1, 0.2, 0.4}, {0.42, 0.1, 0.9, 0.3}, {1, 0.7, 0.5, 0.9}};

/// The integral along the way, in pieces on which the medium is smooth: between planes and where a node is crossed.
RayIntegral truth_of(const Way& way) {
  std::vector<double> cut = way.plane;
  for (std::size_t k = 0; k + 1 < way.plane.size(); ++k) {
    constexpr int steps = 4000;
    const auto at = [&](int i) { return way.plane[k] + (way.plane[k + 1] - way.plane[k]) * i / steps; };
    for (const json* nodes : {&extinction, &color})
      for (const json& node : *nodes) {
        const auto above = [&](double l) { return way.v(l) >= node[0].get<double>(); };
        for (int i = 0; i < steps; ++i) {
          double a = at(i), b = at(i + 1);
          if (above(a) == above(b)) continue;
          for (int n = 0; n < 60; ++n) (above(0.5 * (a + b)) == above(a) ? a : b) = 0.5 * (a + b);
          cut.push_back(b);
        }
      }
  }
  std::sort(cut.begin(), cut.end());
  RayIntegral sum{{}, {1, 1, 1}};
  for (std::size_t k = 0; k + 1 < cut.size(); ++k) {
    const double h = cut[k + 1] - cut[k];
    if (h < 1e-12) continue;
    const RayIntegral piece = test::integrate(
        extinction, color, [&](double l) { return way.v(cut[k] + l); }, h, 8000);
    for (std::size_t c = 0; c < 3; ++c) {
      sum.I[c] += sum.T[c] * piece.I[c];
      sum.T[c] *= piece.T[c];
    }
  }
  return sum;
}

json grid_case(double tolerance) {
  return {{"precision", "fp64"},
          {"data", {{"type", "procedural"}}},
          {"optical_model",
           {{"type", "absorption_emission"}, {"tf", "nodes"}, {"extinction", extinction}, {"color", color}}},
          {"estimator", {{"type", "exact"}}},
          {"camera", {{"type", "ray"}, {"frame", "world"}, {"origin", entry}, {"direction", toward}}},
          {"sampling", {{"type", "cells"}, {"tolerance", tolerance}, {"termination", 0}}},
          {"image", {{"size", {1, 1}}}}};
}

FrameResult render(const FrameJob& job) {
  FrameResult result;
  targets().front().session->render(job, result);
  return result;
}

double error_of(const FrameImage& image, const RayIntegral& truth) {
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c)
    worst = std::max({worst, std::fabs(image.color64.at(c) - truth.I[c]), std::fabs(image.trans64.at(c) - truth.T[c])});
  return worst;
}

// |dv| <= tolerance on a segment moves the extinction by its slope, 37 at the steepest on a twentieth of the values;
// the rest of the slopes is below 1.2 (docs/math E).
TEST(Cells, CurvedRayConvergesWithTheTolerance) {
  const auto grid = random_grid();
  const Way way = way_through(*grid);
  const RayIntegral truth = truth_of(way);
  const double loose = error_of(render(scene_of(grid_case(0.3).dump(), grid).job).image, truth);
  EXPECT_GT(loose, 1e-4) << "the comparison sees curvature";
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const FrameResult r = render(scene_of(grid_case(tolerance).dump(), grid).job);
    const double e = error_of(r.image, truth), bound = tolerance + 1e-10;
    std::printf("cells, tolerance %g: %llu segments, error %.3g, bound %.3g\n", tolerance,
                static_cast<unsigned long long>(r.counters.samples), e, bound);
    EXPECT_LE(e, bound);
  }
}

// Splitting at extrema keeps the total variation, which the surface terms integrate: to rounding at every tolerance.
TEST(Cells, TotalVariationIsExact) {
  const auto grid = random_grid();
  const Way way = way_through(*grid);
  const auto variation = [&](const json& config) {
    const FrameJob job = scene_of(config.dump(), grid).job;
    double sum = 0, last = way.v(0);
    for (const ProbeSegment& q : targets().front().session->probe(job, 0, 0)) {
      sum += std::fabs(q.value - last);
      last = q.value;
    }
    return sum;
  };
  double truth = 0;
  for (std::size_t k = 0; k + 1 < way.plane.size(); ++k) {
    constexpr int points = 200000;
    const double from = way.plane[k], h = (way.plane[k + 1] - from) / points;
    for (int i = 0; i < points; ++i) truth += std::fabs(way.v(from + h * (i + 1)) - way.v(from + h * i));
  }
  json uniform = grid_case(1);
  uniform["sampling"] = {{"type", "uniform"}, {"step", 0.05}, {"unit", "world"}, {"termination", 0}};
  EXPECT_GT(std::fabs(variation(uniform) - truth), 1e-5) << "samples at equal distances miss extrema";
  for (const double tolerance : {0.3, 1e-4}) {
    const double e = std::fabs(variation(grid_case(tolerance)) - truth);
    std::printf("cells, tolerance %g: total variation %.9g, error %.3g, bound 1e-10\n", tolerance, truth, e);
    EXPECT_LE(e, 1e-10);
  }
}

TEST(Cells, AnEmptyCellIsOneSegment) {
  const auto grid = random_grid();
  const Way way = way_through(*grid);
  const std::size_t cells = way.plane.size() - 1;
  json config = grid_case(1e-6);
  config["optical_model"]["extinction"] = {{0, 0}, {2, 0}, {3, 1}};  // beyond the data
  EXPECT_EQ(render(scene_of(config.dump(), grid).job).counters.samples, cells);
  config["optical_model"]["extinction"] = extinction;
  EXPECT_GT(render(scene_of(config.dump(), grid).job).counters.samples, 20 * cells);
}

// The value is linear to the tolerance here anyway: what must be found is the bend of the light factors.
TEST(Cells, LightFactorsAreLinearToTheTolerance) {
  const auto grid = random_grid();
  const auto image = [&](double tolerance) {
    json config = grid_case(tolerance);
    config["optical_model"]["shaded"] = true;
    config["optical_model"]["extinction"] = {{0, 0.8}};
    config["optical_model"]["color"] = {{0, 1, 1, 1}};
    config["lights"] = {{{"type", "directional"}, {"direction", {1, -0.4, 0.8}}}};
    config["illumination"] = {{{"type", "blinn_phong"}, {"diffuse", 0.7}, {"specular", 0.4}, {"shininess", 8}}};
    return render(scene_of(config.dump(), grid).job);
  };
  const FrameResult truth = image(1e-8);
  for (const double tolerance : {1e-1, 1e-3, 1e-5}) {
    const FrameResult r = image(tolerance);
    double e = 0;
    for (std::size_t c = 0; c < 3; ++c) e = std::max(e, std::fabs(r.image.color64[c] - truth.image.color64[c]));
    std::printf("cells, shaded, tolerance %g: %llu segments, error %.3g, bound %.3g\n", tolerance,
                static_cast<unsigned long long>(r.counters.samples), e, tolerance);
    EXPECT_LE(e, tolerance) << "k and b are off by the tolerance at the most, and their weights sum to less than 1";
    EXPECT_LT(r.counters.samples, truth.counters.samples);
    if (tolerance > 0.01) {
      EXPECT_GT(e, 1e-5) << "the comparison sees the bend";
    }
  }
}

// The golden shaded radial field, by its formula.
TEST(Cells, GoldenLevoySphere) {
  const json g = golden("levoy_sphere");
  if (g.is_null()) GTEST_SKIP() << "not supported: no data (" DVRLAB_GOLDEN ")";
  RayIntegral truth;
  for (std::size_t c = 0; c < 3; ++c) {
    truth.I[c] = std::stod(g["expect"]["I"][c].get<std::string>());
    truth.T[c] = std::stod(g["expect"]["T"][c].get<std::string>());
  }
  const json &ray = g["ray"], &shade = g["shade"], &params = g["params"];
  for (const double tolerance : {1e-3, 1e-5, 1e-7, 1e-9}) {
    json config = grid_case(tolerance);
    config["data"] = {{"type", "procedural"},
                      {"evaluate", "formula"},
                      {"field", "radial"},
                      {"bounds", {{-8, -8, -8}, {8, 8, 8}}},
                      {"center", {ray["lc"], ray["p"], 0}},
                      {"scale", ray["scale"]},
                      {"offset", ray["offset"]}};
    config["camera"] = {
        {"type", "ray"}, {"frame", "world"}, {"origin", {0, 0, 0}}, {"direction", {1, 0, 0}}, {"t", {0, ray["D"]}}};
    config["optical_model"] = {{"type", "absorption_emission"},
                               {"tf", "nodes"},
                               {"shaded", true},
                               {"opacity", params["alpha"]},
                               {"color", params["color"]},
                               {"dl_std", params["dl_std"]}};
    config["lights"] = {{{"type", "head"}}};
    config["illumination"] = {{{"type", "blinn_phong"},
                               {"ambient", shade["ka"]},
                               {"diffuse", shade["kd"]},
                               {"specular", shade["ks"]},
                               {"shininess", shade["n"]}}};
    config["image"]["background"] = g["background"];
    const FrameResult r = render(scene_of(config.dump()).job);
    const double e = error_of(r.image, truth), bound = 30 * tolerance;
    std::printf("cells, levoy_sphere, tolerance %g: %llu segments, error %.3g, bound %.3g\n", tolerance,
                static_cast<unsigned long long>(r.counters.samples), e, bound);
    EXPECT_LE(e, bound);
  }
}

TEST(Cells, SamplersThatCannotAreRefused) {
  const TetBlock block{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}, [](const Vector3& p) { return p[0]; }};
  try {
    scene_of(grid_case(1e-3).dump(), make_tets(block));
    FAIL() << "expected InputError";
  } catch (const InputError& e) {
    for (const char* word : {"sampling.type", "spike_tets", "\"uniform\""})
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << word << " is not in: " << e.what();
  }
}

}  // namespace
}  // namespace dvrlab
