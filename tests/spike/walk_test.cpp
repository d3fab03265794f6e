// A sampler that walks from face to face and yields segments of variable length, with holes: on every target.
#include <algorithm>
#include <cmath>

#include "tests/spike/spike.h"
#include "tests/spike/tets.h"

namespace dvrlab {
namespace {

using namespace spike;
using nlohmann::json;

json ray_case(double length, double y, double z) {
  return {
      {"data", {{"type", "procedural"}}},
      {"optical_model", {{"type", "absorption_emission"}, {"tf", "nodes"}, {"length_unit", "world"}}},
      {"estimator", {{"type", "exact"}}},
      {"camera",
       {{"type", "ray"}, {"frame", "world"}, {"origin", {-1, y, z}}, {"direction", {1, 0, 0}}, {"t", {0, length + 2}}}},
      {"sampling", {{"type", "uniform"}, {"step", length}, {"unit", "world"}, {"termination", 0}}},
      {"image", {{"size", {4, 4}}}}};
}

double value(const json& text) { return std::stod(text.get<std::string>()); }

// However the walk cuts the ray, an exact estimator gives the segment's golden numbers.
TEST(SpikeWalk, GoldenRampThroughManyTetrahedra) {
  const json g = golden("seg_ramp_up");
  if (g.is_null()) GTEST_SKIP() << "not supported: no data (" DVRLAB_GOLDEN ")";
  const double dl = g["ray"]["dl"], v0 = g["ray"]["v0"], v1 = g["ray"]["v1"];
  const auto field =
      make_tets({{0, -1, -1}, {dl, 1, 1}, {5, 4, 3}, [&](const Vector3& p) { return v0 + (v1 - v0) * p[0] / dl; }});
  double worst = 0;
  for (const double y : {0.31, -0.77}) {
    json config = ray_case(dl, y, 0.12);
    config["optical_model"]["extinction"] = g["params"]["tau"];
    config["optical_model"]["color"] = g["params"]["color"];
    const FrameResult r = render_everywhere("walk, ramp", scene_of(config.dump(), field).job);
    EXPECT_GE(r.counters.samples, 16u * 8u) << "segments";
    for (std::size_t c = 0; c < 3; ++c) {
      worst = std::max(worst, std::fabs(double(r.image.color[c]) - value(g["expect"]["I"][c])));
      worst = std::max(worst, std::fabs(double(r.image.trans[c]) - value(g["expect"]["T"][c])));
    }
  }
  std::printf("walk, ramp: worst error %.3g, bound 2e-6\n", worst);
  EXPECT_LE(worst, 2e-6);
}

// Five boxes in a row, two of them missing: a homogeneous medium of three fifths of the length. A Dirac term whose
// value lies between the sides of a hole is not crossed in the hole.
TEST(SpikeWalk, HolesAreNoMatter) {
  const double length = 1.0, tau = 1.3;
  const TetBlock block{{0, -1, -1},
                       {length, 1, 1},
                       {5, 1, 1},
                       [](const Vector3& p) { return p[0] < 0.5 ? 0.2 : 0.8; },
                       [](int i, int, int) { return i != 1 && i != 2; }};
  json config = ray_case(length, 0.3, 0.1);
  config["optical_model"] = {{"type", "hybrid"},
                             {"tf", "nodes"},
                             {"scattering", {{"opacity", {{0, 1 - std::exp(-tau)}}}, {"color", {{0, 0.5, 0.6, 0.7}}}}},
                             {"surface", {{"delta", {{{"value", 0.5}, {"opacity", 0.95}}}}}}};
  const FrameResult r = render_everywhere("walk, holes", scene_of(config.dump(), make_tets(block)).job);
  const double t = std::exp(-tau * 0.6 * length), color[3] = {0.5, 0.6, 0.7};
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(r.image.trans[c], t, 2e-6);
    EXPECT_NEAR(r.image.color[c], color[c] * (1 - t), 2e-6);
  }
}

// The same walk in double, by an estimator without constants of fp32.
TEST(SpikeWalk, HolesInFp64) {
  const double tau = 1.3;
  const TetBlock block{{0, -1, -1},
                       {1, 1, 1},
                       {5, 1, 1},
                       [](const Vector3&) { return 0.5; },
                       [](int i, int, int) { return i != 1 && i != 2; }};
  json config = ray_case(1.0, 0.3, 0.1);
  config["optical_model"]["extinction"] = {{0, tau}};
  config["optical_model"]["color"] = {{0, 0.5, 0.6, 0.7}};
  config["estimator"] = {{"type", "direct"}};
  const double t = std::exp(-tau * 0.6), color[3] = {0.5, 0.6, 0.7};
  FrameJob job = scene_of(config.dump(), make_tets(block)).job;
  BackendSession& cpu = *targets().front().session;
  FrameResult fp32, fp64;
  cpu.render(job, fp32);
  job.precision = Precision::fp64;
  cpu.render(job, fp64);
  EXPECT_EQ(fp64.counters.samples, fp32.counters.samples);
  double worst = 0, worst32 = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    worst =
        std::max({worst, std::fabs(fp64.image.trans64[c] - t), std::fabs(fp64.image.color64[c] - color[c] * (1 - t))});
    worst32 = std::max(worst32, std::fabs(double(fp32.image.trans[c]) - t));
  }
  std::printf("walk, holes in fp64: worst error %.3g, bound 1e-14; fp32 %.3g\n", worst, worst32);
  EXPECT_LE(worst, 1e-14);
  EXPECT_GT(worst32, 1e-10) << "the comparison does not see fp32";
}

TEST(SpikeWalk, SameBitsOnAPerspectiveView) {
  const TetBlock block{{-1, -1, -1},
                       {1, 1, 1},
                       {3, 3, 3},
                       [](const Vector3& p) { return 0.5 + 0.3 * std::sin(3 * p[0] + p[1]) + 0.2 * p[2] * p[1]; },
                       [](int i, int j, int k) { return (i + 2 * j + 3 * k) % 5 != 0; }};
  json config = json::parse(R"({
    "data": { "type": "procedural" },
    "optical_model": { "type": "absorption_emission", "tf": "nodes", "length_unit": "world", "shaded": true,
                       "extinction": [[0, 0], [0.3, 0.2], [0.5, 4], [0.6, 0.3], [1, 2]],
                       "color": [[0, 0.2, 0.5, 0.9], [1, 1, 0.6, 0.2]] },
    "estimator": { "type": "exact" },
    "lights": [ { "type": "head" } ], "illumination": [ { "type": "blinn_phong" } ],
    "camera": { "type": "perspective", "frame": "data", "position": [1.5, -2.0, 1.2], "up": [0, 0, 1], "fov_deg": 40 },
    "clip": [ { "normal": [1, 0.2, 0], "offset": 0.6 } ],
    "sampling": { "type": "uniform", "step": 0.1, "unit": "world" },
    "image": { "size": [70, 61], "background": [0.1, 0.2, 0.3] } })");
  const auto field = make_tets(block);
  const FrameResult exact = render_everywhere("walk, exact lit", scene_of(config.dump(), field).job, 2);
  EXPECT_GT(exact.counters.samples, 10000u);
  config["optical_model"]["shaded"] = false;
  render_everywhere("walk, exact plain", scene_of(config.dump(), field).job, 2);
  config["estimator"] = {{"type", "direct"}};
  render_everywhere("walk, direct plain", scene_of(config.dump(), field).job, 2);
  config["optical_model"]["shaded"] = true;
  render_everywhere("walk, direct lit", scene_of(config.dump(), field).job, 2);
}

}  // namespace
}  // namespace dvrlab
