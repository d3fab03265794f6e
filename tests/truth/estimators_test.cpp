// Estimators against golden values, their orders (docs/math, table G), and opaque media, on every backend.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

double digits(const json& text) { return std::stod(text.get<std::string>()); }

class Estimators : public GoldenOnTarget {
 protected:
  FrameImage image(json config, const json& estimator) {
    config["estimator"] = estimator;
    if (estimator["type"] != "exact") config["optical_model"].erase("tf");
    return render(config, GetParam()).image;
  }
  void expect_near(const FrameImage& image, const json& radiance, const json& transmittance, double bound,
                   const std::string& what) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(double(image.color[c]), digits(radiance[c]), bound) << what;
      EXPECT_NEAR(double(image.trans[c]), digits(transmittance[c]), bound) << what;
    }
  }
};

// The continuous tables of the golden file against 65536 bins: the remaining error is a bin's.
TEST_P(Estimators, ApproximativeIsGolden) {
  for (const char* id : {"est_absem_down", "est_hybrid_up"}) {
    const json g = golden_case(id);
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage r = image(golden_config(g, 1), {{"type", "approximative"}, {"table_size", 65536}});
      expect_near(r, g["expect"]["approx_C"], g["expect"]["T"], 2e-6, id);
      // Negative control: a table of 16 bins is seen.
      const FrameImage coarse = image(golden_config(g, 1), {{"type", "approximative"}, {"table_size", 16}});
      EXPECT_GT(largest_difference(r, coarse), 1e-5) << id;
    })
  }
}

TEST_P(Estimators, BarycentreIsGolden) {
  {
    json g = golden_case("est_hybrid_up");
    const double place = (digits(g["expect"]["barycentre"][0]) - 0.15) / 0.6;
    // Surfaces alone, lit by k that rises from 0 to 1: the radiance is that of k = 1 times the barycentre's place.
    for (const char* key : {"a_ps", "c_ps"}) g["params"].erase(key);
    g["shade"] = {{"type", "linear"}, {"k0", {0, 0, 0}}, {"k1", {1, 1, 1}}, {"b0", {0, 0, 0}}, {"b1", {0, 0, 0}}};
    json full = g;
    full["shade"]["k0"] = {1, 1, 1};
    std::vector<json> estimators = {{{"type", "approximative"}, {"table_size", 65536}},
                                    {{"type", "preintegrated"}, {"depth_table_size", 65536}}};
    if (!g["params"].contains("diracs")) estimators.push_back({{"type", "average"}, {"table_size", 65536}});
    for (json estimator : estimators) {
      estimator["shading"] = "barycentre";
      SKIP_WHEN_NOT_SUPPORTED({
        const FrameImage rising = image(golden_config(g, 1), estimator), lit = image(golden_config(full, 1), estimator);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(rising.color[c] / lit.color[c], place, 1e-5) << estimator.dump();
      })
    }
  }
}

TEST_P(Estimators, TrapezoidIsGolden) {
  for (const char* id : {"est_absem_down", "est_hybrid_up"}) {
    json g = golden_case(id);
    g["params"].erase("diracs");  // two samples cannot see them
    SKIP_WHEN_NOT_SUPPORTED({
      json config = golden_config(g, 1);
      config["estimator"] = {{"type", "average"}};
      expect_near(render(config, GetParam()).image, g["expect"]["trapezoid_C"], g["expect"]["trapezoid_T"], 2e-6, id);
    })
  }
}

struct Order {
  json estimator;
  double low, high;  // halving the step divides the error by this much
};

// Table G.1 on the ramp: the orders of the methods.
TEST_P(Estimators, OrdersOnTheRamp) {
  const std::vector<Order> orders = {{{{"type", "average"}}, 3.6, 4.4},
                                     {{{"type", "average"}, {"rule", "mean_density"}}, 3.6, 4.4},
                                     {{{"type", "average"}, {"rule", "exact_depth"}}, 3.6, 4.4},
                                     {{{"type", "average"}, {"rule", "linear_opacity"}}, 1.8, 2.2},
                                     {{{"type", "direct"}}, 3.6, 4.4},
                                     {{{"type", "approximative"}, {"table_size", 65536}}, 3.6, 4.4}};
  SKIP_WHEN_NOT_SUPPORTED({
    for (bool backwards : {false, true}) {
      const FrameImage truth = image(golden_medium_config("ramp", 1, backwards), {{"type", "exact"}});
      for (const Order& o : orders) {
        std::vector<double> e;
        for (int n : {16, 32, 64}) {
          json config = golden_medium_config("ramp", n, backwards);
          config["estimator"] = o.estimator;
          e.push_back(largest_difference(render(config, GetParam()).image, truth));
        }
        std::printf("%s: errors %.2e %.2e %.2e at N = 16, 32, 64\n", o.estimator.dump().c_str(), e[0], e[1], e[2]);
        EXPECT_GE(e[0] / e[1], o.low) << o.estimator.dump();
        EXPECT_LE(e[0] / e[1], o.high) << o.estimator.dump();
        EXPECT_GE(e[1] / e[2], o.low * 0.95) << o.estimator.dump();
      }
    }
  })
}

// P4: with one colour, C = c (1 - T) for everything that knows the depth; P6: C <= 1 - T.
TEST_P(Estimators, OneColourIsExact) {
  for (const char* medium : {"peak", "box"}) {
    json config = golden_medium_config(medium, 5, false);
    config["optical_model"]["color"] = {{0, 0.9, 0.4, 0.2}};
    SKIP_WHEN_NOT_SUPPORTED({
      for (const json& estimator : {json{{"type", "exact"}}, json{{"type", "approximative"}}}) {
        const FrameImage r = image(config, estimator);
        const double color[3] = {0.9, 0.4, 0.2};
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(r.color[c], color[c] * (1 - r.trans[c]), 2e-6) << medium << estimator.dump();
      }
    })
  }
}

// ---- opaque media ------------------------------------------------------------------------------------------------

// Particles of extinction 0.5 and colour a up to the value 0.5, where something opaque of colour b begins.
json opaque_wall(bool backwards, int segments, const char* opaque, double where) {
  json config = golden_medium_config("ramp", segments, backwards);
  config["optical_model"] = {
      {"type", "hybrid"},
      {"opaque", opaque},
      {"dl_std", 2},
      {"scattering", {{"opacity", {{0, 0.632120558828557678}}}, {"color", {{0, 0.2, 0.6, 1.0}}}}},
      {"surface", {{"color", {{0, 1, 0.5, 0.1}}}}}};
  config["data"]["offset"] = backwards ? 1 : 0;
  config["data"]["scale"] = backwards ? -1 : 1;
  config["optical_model"]["surface"]["delta"] = {{{"value", where}, {"opacity", 1}}};
  config["image"]["background"] = {9, 9, 9};
  return config;
}

// An opaque isosurface ends the ray where it stands: wherever samples fall, in both directions, for every estimator
// that sees what lies between samples; and never twice.
TEST_P(Estimators, OpaqueIsosurfaceEndsTheRay) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.1, 0.9);
  SKIP_WHEN_NOT_SUPPORTED({
    for (int trial = 0; trial < 12; ++trial) {
      const int segments = 1 + trial % 5;
      const bool backwards = trial % 3 == 0;
      // 0.5 lies on a sample when the number of segments is even.
      const double where = trial % 2 == 0 ? 0.5 : uniform(random), way = backwards ? 1 - where : where;
      for (const char* estimator : {"exact", "approximative", "average", "preintegrated"}) {
        json config = opaque_wall(backwards, segments, "interval", where);
        config["estimator"] = {{"type", estimator}};
        if (estimator == std::string("exact")) config["optical_model"]["tf"] = "nodes";
        const FrameImage r = render(config, GetParam()).image;
        const double T = std::exp(-0.5 * way), a[3] = {0.2, 0.6, 1.0}, b[3] = {1, 0.5, 0.1};
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_EQ(r.trans[c], 0.0f) << estimator;
          EXPECT_NEAR(r.color[c], a[c] * (1 - T) + b[c] * T, 2e-6) << estimator << " " << segments << " " << where;
        }
      }
    }
  })
}

// Opaque entries: a range between neighbours, one table bin for an isolated one, an isosurface, or a cap.
TEST_P(Estimators, OpaqueEntries) {
  json config = golden_medium_config("ramp", 64, false);
  config["data"]["offset"] = 0;
  config["data"]["scale"] = 1;
  config["optical_model"] = {{"type", "absorption_emission"},
                             {"dl_std", 0.01},
                             {"opacity", {{0, 0}, {0.4, 0}, {0.4, 1}, {0.6, 1}, {0.6, 0}}},
                             {"color", {{0, 1, 0, 0}, {0.5, 1, 0, 0}, {0.5, 0, 1, 0}}}};
  config["image"]["background"] = {0, 0, 1};
  SKIP_WHEN_NOT_SUPPORTED({
    for (const char* opaque : {"interval", "dirac", "cap"}) {
      config["optical_model"]["opaque"] = opaque;
      for (const char* estimator : {"approximative", "average", "direct", "exact", "preintegrated"}) {
        config["estimator"] = {{"type", estimator}};
        config["optical_model"]["tf"] = estimator == std::string("exact") ? "nodes" : "table";
        const FrameImage r = render(config, GetParam()).image;
        const double bound = opaque == std::string("cap") ? 0.05 : 2e-6;  // the wall is where a sample is
        EXPECT_NEAR(r.color[0], 1, bound) << opaque << " " << estimator;
        EXPECT_NEAR(r.color[1], 0, bound) << opaque << " " << estimator;
        if (opaque != std::string("cap")) {
          EXPECT_EQ(r.trans[0], 0.0f) << estimator;
        }
      }
    }
  })
}

// An isolated opaque entry: one table bin of opaque values, or an isosurface; either ends the ray for who sees the ends
// of segments. Who samples their middle is refused the isosurface, unless a pulse stands for it.
TEST_P(Estimators, IsolatedOpaqueEntries) {
  json config = golden_medium_config("ramp", 64, false);
  config["optical_model"] = {{"type", "hybrid"},
                             {"dv_std", 1e6},
                             {"surface", {{"opacity", {{0.4, 0}, {0.5, 1}, {0.6, 0}}}, {"color", {{0, 0.2, 1, 0.4}}}}}};
  for (const char* opaque : {"interval", "dirac"}) {
    config["optical_model"]["opaque"] = opaque;
    for (const char* estimator : {"approximative", "average", "preintegrated"}) {
      config["estimator"] = {{"type", estimator}};
      SKIP_WHEN_NOT_SUPPORTED({
        const FrameImage r = render(config, GetParam()).image;
        EXPECT_EQ(r.trans[0], 0.0f) << opaque << estimator;
        EXPECT_NEAR(r.color[1], 1, 1e-4) << opaque << estimator;
      })
    }
  }
  config["estimator"] = {{"type", "direct"}};
  try {
    render(config, GetParam());
    ADD_FAILURE() << "direct does not see the isosurface and was not refused";
  } catch (const NotSupported&) {
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("isosurface of opacity 1"), std::string::npos) << e.what();
  }
  config["estimator"]["approximate_dirac"] = 0.1;  // several samples wide
  SKIP_WHEN_NOT_SUPPORTED(EXPECT_EQ(render(config, GetParam()).image.trans[0], 0.0f))
  config["optical_model"]["surface"] = {{"delta", {{{"value", 0.5}, {"opacity", 0.5}}}}};
  config["estimator"]["approximate_dirac"] = 1e-12;
  try {
    render(config, GetParam());
    ADD_FAILURE() << "a pulse that fp32 cannot resolve was accepted";
  } catch (const NotSupported&) {
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("narrower than fp32"), std::string::npos) << e.what();
  }
}

// Half a pair, and what no transfer function gives.
TEST(HybridRefuses, WhatCannotBeMeant) {
  const auto refusal = [](const json& parts) {
    json config = ray_config(ramp_field(0, 1, 1), 1, 0.5);
    config["optical_model"] = {{"type", "hybrid"}, {"scattering", {{"opacity", {{0, 0.5}}}}}};
    config["optical_model"].merge_patch(parts);
    try {
      render(config, targets().front());
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  const auto expect = [&](const json& parts, const char* words) {
    EXPECT_NE(refusal(parts).find(words), std::string::npos) << refusal(parts);
  };
  EXPECT_EQ(refusal(json::object()), "");
  expect({{"emission", {{"color", {{0, 1, 1, 1}}}}}}, "colours nothing without emission.intensity");
  expect({{"surface", {{"color", {{0, 1, 1, 1}}}}}}, "colours nothing without surface.opacity");
  expect({{"scattering", {{"color", {{0, 1, -1, 1}}}}}}, "is negative");
  expect({{"absorption", {{"density", {{0, 0.5}}}, {"transmission_color", {{0, 3, 1, 1}}}}}},
         "transmission_color: more than 1");
}

TEST(EstimatorsRefuse, EmissionInAveragesOfChromaticity) {
  json config = ray_config(ramp_field(0, 1, 1), 1, 0.5);
  config["optical_model"] = {{"type", "hybrid"}, {"emission", {{"intensity", {{0, 1}}}}}};
  config["estimator"] = {{"type", "average"}};
  EXPECT_NEAR(render(config, targets().front()).image.color[0], 1, 1e-5);
  config["estimator"]["rule"] = "mean_density";
  EXPECT_THROW(render(config, targets().front()), InputError);
}

// Full pre-integration holds every kind of content at once, whichever look-up.
TEST(EstimatorsAccept, AllContentsInPlainTables) {
  json config = ray_config(ramp_field(0, 1, 1), 1, 0.25);
  config["optical_model"] = {{"type", "hybrid"},
                             {"surface", {{"opacity", {{0, 0.3}, {1, 0.5}}}}},
                             {"scattering", {{"opacity", {{0, 0.3}, {1, 0.5}}}}},
                             {"emission", {{"intensity", {{0, 0.2}}}}},
                             {"absorption", {{"density", {{0, 0.4}}}, {"transmission_color", {{0, 0.9, 0.5, 0.1}}}}}};
  config["illumination"] = {{{"type", "prescribed"}, {"m1", {0.5, 0.5, 0.5}}, {"k1", {0.2, 0.4, 0.6}}}};
  config["estimator"] = {{"type", "preintegrated"}, {"table_size", 200}};
  const FrameImage corrected = render(config, targets().front()).image;
  config["estimator"]["lookup"] = "plain";
  EXPECT_LE(largest_difference(render(config, targets().front()).image, corrected), 1e-4);
}

// ---- direct ------------------------------------------------------------------------------------------------------

// Equation 11 loses the surface where the value turns round between two equal neighbours; the total variation keeps it.
TEST_P(Estimators, TotalVariationKeepsTheExtremum) {
  json config = golden_config(golden_case("kraus_polyline"), 1);
  config["data"]["node"] = {{0, 0.2}, {1, 0.8}, {2, 0.2}};
  config["optical_model"] = {{"type", "data_space"}, {"dv_std", 1}, {"surface", {{"opacity", {{0, 0.5}}}}}};
  config["camera"]["t"] = {0, 2};
  config["sampling"]["step"] = 2.0 / 3;  // the middle sample sits on the extremum
  const double T = std::pow(0.5, 1.2);   // |dv| = 1.2 in all
  SKIP_WHEN_NOT_SUPPORTED({
    config["estimator"] = {{"type", "direct"}, {"total_variation", true}};
    EXPECT_NEAR(render(config, GetParam()).image.trans[0], T, 2e-6);
    config["estimator"]["total_variation"] = false;
    EXPECT_GT(render(config, GetParam()).image.trans[0], 1.2 * T) << "equation 11 as printed";
  })
}

// A pulse of vanishing width in place of a Dirac term converges to it, on a step that resolves it.
TEST_P(Estimators, PulsesConvergeToDiracs) {
  const json g = golden_case("est_hybrid_up");
  SKIP_WHEN_NOT_SUPPORTED({
    const FrameImage truth = image(golden_config(g, 1), {{"type", "exact"}});
    std::vector<double> e;
    for (double width : {0.1, 0.025, 0.00625}) {
      json config = golden_config(g, 2000);
      config["estimator"] = {{"type", "direct"}, {"approximate_dirac", width}};
      e.push_back(largest_difference(render(config, GetParam()).image, truth));
    }
    std::printf("pulses: error %.2e %.2e %.2e for widths 0.1, 0.025, 0.00625\n", e[0], e[1], e[2]);
    EXPECT_LT(e[1], e[0] / 2);
    EXPECT_LT(e[2], e[1] / 2);
  })
}

TEST(EstimatorsRefuse, DiracTermsThatSamplesCannotSee) {
  if (golden().is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  for (const char* estimator : {"direct", "average"}) {
    json config = golden_config(golden_case("est_hybrid_up"), 4);
    config["estimator"] = {{"type", estimator}};
    try {
      scene_of(config);
      FAIL() << estimator << " takes Dirac terms";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("Dirac"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("approximate_dirac"), std::string::npos) << e.what();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, Estimators, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
