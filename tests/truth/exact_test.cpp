// The exact estimator against golden values, on every backend; and what follows from exactness (docs/math, P1 to P6).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

bool straight(const json& g) { return g.at("ray").at("type") == "segment" && g.at("shade").is_null(); }

class Exact : public GoldenOnTarget {
 protected:
  FrameImage image(json config) {
    if (!config.contains("estimator")) config["estimator"] = {{"type", "exact"}};
    return render(config, GetParam()).image;
  }
};

// fp32: 2e-6. Straight segments in one piece; curved rays and lights that vary along the ray in pieces that are short
// enough, so that the bound still is the arithmetic's.
TEST_P(Exact, GoldenRays) {
  double worst = 0;
  for (const std::string& id : golden_rays()) {
    const json g = golden_case(id);
    const std::string type = g.at("ray").at("type");
    // A polyline's corners lie at multiples of 0.1.
    const int segments = straight(g) ? 1 : type == "polyline" ? 20 : type == "segment" ? 1 : 1024;
    SKIP_WHEN_NOT_SUPPORTED({
      const double e = error_of(image(golden_config(g, segments)), golden_integral(g));
      std::printf("%-18s %4d segments: error %.2e\n", id.c_str(), segments, e);
      // A curved ray's error is that of its chords, second order in their length.
      const double bound = type == "radial" || type == "sin" ? 2e-5 : 2e-6;
      EXPECT_LE(e, bound) << id;
      worst = std::max(worst, e);
    })
  }
  EXPECT_GT(worst, 0) << "no case was rendered";
}

// P3: splitting a segment anywhere changes nothing but rounding; P2: T is the same backwards.
TEST_P(Exact, SplittingChangesNothing) {
  for (const char* id : {"hybrid_up", "seg_box", "kraus_short", "wm_up", "zero_density_gap"}) {
    const json g = golden_case(id);
    for (int segments : {1, 2, 3, 7, 16, 61}) {
      SKIP_WHEN_NOT_SUPPORTED({
        EXPECT_LE(error_of(image(golden_config(g, segments)), golden_integral(g)), 4e-6) << id << " " << segments;
      })
    }
  }
}

TEST_P(Exact, TransmittanceIsSymmetric) {
  for (const char* id : {"hybrid_up", "kraus_short", "seg_peak64"}) {
    json g = golden_case(id);
    const RayIntegral there = golden_integral(g);
    std::swap(g["ray"]["v0"], g["ray"]["v1"]);
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage back = image(golden_config(g, 3));
      for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(double(back.trans[c]), there.T[c], 2e-6) << id;
    })
  }
}

// P1: without particles and emission the length of the segment does not matter.
TEST_P(Exact, DataSpaceIgnoresLengths) {
  json g = golden_case("kraus_short");
  const RayIntegral truth = golden_integral(g);
  for (double length : {0.001, 1.0, 7.5}) {
    g["ray"]["dl"] = length;
    SKIP_WHEN_NOT_SUPPORTED(EXPECT_LE(error_of(image(golden_config(g, 4)), truth), 2e-6) << length)
  }
}

// The negative control of everything above: a medium, a value or a length that is wrong by a hundredth is seen.
TEST_P(Exact, SmallFaultsAreSeen) {
  const json g = golden_case("hybrid_up");
  for (const char* where : {"/ray/v1", "/ray/dl", "/params/a_s/1/1", "/params/diracs/0/alpha"}) {
    json wrong = g;
    json& x = wrong[json::json_pointer(where)];
    x = x.get<double>() * 1.01;
    SKIP_WHEN_NOT_SUPPORTED(EXPECT_GT(error_of(image(golden_config(wrong, 1)), golden_integral(g)), 2e-5) << where)
  }
}

// A ray never loses nor doubles a discrete surface, wherever samples fall: also exactly on the isovalue.
TEST_P(Exact, DiscreteSurfacesAreCountedOnce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  const int trials = GetParam().name.starts_with("cpu") ? 40 : 9;  // a GPU compiles for every number of nodes
  for (int trial = 0; trial < trials; ++trial) {
    const int segments = 1 + trial % 9;
    json g = golden_case("dirac_touch");
    // Every other trial puts isovalues on samples: v = k / segments exactly.
    json diracs = json::array();
    double T = 1;
    for (int k = 1; k <= 3; ++k) {
      // Where the ray itself ends is its rounding's affair: not on 1.
      const double on_sample = std::min(std::round(uniform(random) * segments), segments - 1.0) / segments;
      const double v = trial % 2 == 0 ? on_sample : uniform(random);
      const double alpha = 0.2 + 0.6 * uniform(random);
      diracs.push_back({{"v", v}, {"alpha", alpha}, {"color", {1, 1, 1}}});
      if (v > 0) T *= 1 - alpha;  // the state changes where 0 < v <= 1
    }
    g["params"]["diracs"] = diracs;
    g["background"] = {0, 0, 0};
    for (const bool falling : {false, true}) {
      g["ray"] = {{"type", "segment"}, {"v0", falling ? 1 : 0}, {"v1", falling ? 0 : 1}, {"dl", 1}};
      json config = golden_config(g, segments);
      for (const json& estimator : {json{{"type", "exact"}}, json{{"type", "approximative"}},
                                    json{{"type", "preintegrated"}, {"table_size", 64}}}) {
        if (trial >= 6 && estimator != json{{"type", "exact"}}) continue;
        config["estimator"] = estimator;
        SKIP_WHEN_NOT_SUPPORTED({
          const FrameImage r = image(config);
          EXPECT_NEAR(r.trans[0], T, 2e-6) << estimator.dump() << segments << " " << diracs.dump() << falling;
          EXPECT_NEAR(r.color[0], 1 - T, 2e-6) << estimator.dump() << segments << falling;
        })
      }
    }
  }
}

// n discrete layers of opacity 1 - (1 - a)^(1/n) converge to the continuous surface (Yang et al. 2012, equations 2 to
// 4).
TEST_P(Exact, LayersConvergeToTheContinuousSurface) {
  json g = golden_case("kraus_short");
  g["params"] = {{"a_s", {{0.2, 0.6}, {0.8, 0.6}}}, {"c_s", {{0, 1, 0.2, 0.1}, {1, 0.1, 0.9, 0.4}}}, {"dv_std", 0.25}};
  g["ray"] = {{"type", "segment"}, {"v0", 0}, {"v1", 1}, {"dl", 1}};
  std::vector<double> error;
  SKIP_WHEN_NOT_SUPPORTED({
    const FrameImage continuous = image(golden_config(g, 1));
    for (int n : {8, 32, 128}) {
      json layers = g;
      layers["params"].erase("a_s");
      for (int k = 0; k < n; ++k) {
        const double v = (k + 0.5) / n, alpha = 1 - std::pow(1 - 0.6, 1 / (0.25 * n));
        const auto c = nodes_at(g["params"]["c_s"], v);
        layers["params"]["diracs"].push_back({{"v", v}, {"alpha", alpha}, {"color", c}});
      }
      error.push_back(largest_difference(image(golden_config(layers, 1)), continuous));
    }
  })
  std::printf("layers against the continuous surface: %.2e %.2e %.2e for n = 8, 32, 128\n", error[0], error[1],
              error[2]);
  EXPECT_LT(error[1], error[0] / 3);
  EXPECT_LT(error[2], error[1] / 3);
}

// View-independent transparency: a planar ramp of surfaces lets the same light pass at every angle, a layer of
// particles does not (Yang et al. 2012, section 3).
TEST_P(Exact, SurfacesAreTransparentFromEveryAngle) {
  json config = golden_config(golden_case("kraus_short"), 1);
  config["data"] = {{"type", "procedural"},
                    {"evaluate", "formula"},
                    {"bounds", {{-8, -8, 0}, {8, 8, 1}}},
                    {"field", "ramp"},
                    {"direction", {0, 0, 1}},
                    {"offset", 0},
                    {"scale", 1}};
  const json surfaces = {
      {"type", "data_space"}, {"tf", "nodes"}, {"dv_std", 0.5}, {"surface", {{"opacity", {{0, 0.3}, {1, 0.7}}}}}};
  const json particles = {
      {"type", "hybrid"}, {"tf", "nodes"}, {"dl_std", 0.5}, {"scattering", {{"opacity", {{0, 0.3}, {1, 0.7}}}}}};
  std::vector<double> by_surface, by_particles;
  for (double angle : {0.0, 30.0, 60.0, 80.0}) {
    const double a = angle * std::acos(-1.0) / 180;
    config["camera"] = {{"type", "ray"},
                        {"frame", "world"},
                        {"origin", {-7.9 * std::sin(a), 0, 0.5 - 7.9 * std::cos(a)}},
                        {"direction", {std::sin(a), 0, std::cos(a)}}};
    config["sampling"]["step"] = 0.25;
    SKIP_WHEN_NOT_SUPPORTED({
      config["optical_model"] = surfaces;
      by_surface.push_back(image(config).trans[0]);
      config["optical_model"] = particles;
      by_particles.push_back(image(config).trans[0]);
    })
  }
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_NEAR(by_surface[k], by_surface[0], 2e-6) << k;
    EXPECT_LT(by_particles[k], by_particles[k - 1] * 0.95) << k;
  }
}

// Software GPUs end loops after 65535 rounds in all. Either the ray is whole, or the case is refused: never half a ray.
TEST_P(Exact, ARayIsWholeOrRefused) {
  const json g = golden_case("hybrid_up");
  SKIP_WHEN_NOT_SUPPORTED({
    const double e = error_of(image(golden_config(g, 40000)), golden_integral(g));
    std::printf("hybrid_up in 40000 segments: error %.2e\n", e);
    EXPECT_LE(e, 1e-3);  // 40000 roundings of 2^-24
  })
}

// fp64 on the cpu: 1e-12 on straight segments, in one piece and in many; 1e-9 on curved rays, walked cell by cell.
TEST(ExactRefuses, TablesOfTheMedium) {
  json config = ray_config(ramp_field(0, 1, 1), 1, 0.5);
  config["optical_model"] = model({{0, 1}}, {{0, 1, 1, 1}});
  config["optical_model"]["tf"] = "table";
  config["estimator"] = {{"type", "exact"}};
  try {
    scene_of(config);
    FAIL() << "it was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("optical_model.tf"), std::string::npos) << e.what();
  }
}

TEST(ExactFp64, GoldenRays) {
  if (golden().is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  const Target cpu{"cpu", {{"type", "cpu"}}};
  const auto error = [](const FrameImage& r, const RayIntegral& truth) {
    double worst = 0;
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max({worst, std::abs(r.color64.at(c) - truth.I[c]), std::abs(r.trans64.at(c) - truth.T[c])});
    return worst;
  };
  for (const std::string& id : golden_rays()) {
    if (id == "dirac_touch") continue;  // whether a corner touches an isovalue is the last bit's affair
    const json g = golden_case(id);
    const std::string type = g.at("ray").at("type");
    const bool curved = type == "radial" || type == "sin";
    json config = golden_config(g, type == "polyline" ? 20 : 1);
    config["estimator"] = {{"type", "exact"}};
    config["precision"] = "fp64";
    if (curved) config["sampling"] = {{"type", "cells"}, {"tolerance", 1e-10}, {"termination", 0}};
    const double e = error(render(config, cpu).image, golden_integral(g));
    std::printf("fp64 %-18s: error %.2e\n", id.c_str(), e);
    EXPECT_LE(e, curved ? 1e-8 : 1e-12) << id;
    if (curved || type == "polyline") continue;
    config["sampling"]["step"] = g.at("ray").at("dl").get<double>() / 7;
    EXPECT_LE(error(render(config, cpu).image, golden_integral(g)), 1e-12) << id << " in 7 segments";
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, Exact, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
