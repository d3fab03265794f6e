// Full pre-integration against the exact integral: docs/math, tables G.1 and G.2, on every backend.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "framework/config/experiment.h"
#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

class Preintegrated : public GoldenOnTarget {
 protected:
  FrameImage exact(json config) {
    config["estimator"] = {{"type", "exact"}};
    return render(config, GetParam()).image;
  }
  FrameImage image(json config, int n, const char* lookup = "corrected") {
    config["estimator"] = {{"type", "preintegrated"}, {"table_size", n}, {"lookup", lookup}};
    config["optical_model"].erase("tf");
    // The grid of table G: n values from 0 to 1.
    config["optical_model"]["tf_range"] = {0, 1};
    return render(config, GetParam()).image;
  }
  /// The worst error over both directions and the numbers of segments.
  double worst(const std::string& medium, int n, const std::vector<int>& segments, const char* lookup = "corrected") {
    double e = 0;
    for (bool backwards : {false, true}) {
      const FrameImage truth = exact(golden_medium_config(medium, 1, backwards));
      for (int N : segments)
        e = std::max(e, largest_difference(image(golden_medium_config(medium, N, backwards), n, lookup), truth));
    }
    return e;
  }
};

struct Row {
  const char* medium;
  double at_256, at_1024;
};
const std::vector<int> many{16, 64, 256, 1024};
constexpr double rounding = 1024 * 0x1p-24 / 8;

// Table G.2, column `corr`, within twice its numbers; fp32 adds its roundings, a part of 2^-24 per segment.
TEST_P(Preintegrated, CorrectedLookUp) {
  for (const Row& row : {Row{"ramp", 7.0e-6, 4.7e-7}, Row{"peak", 6.1e-3, 5.2e-4}, Row{"box", 2.1e-4, 1.1e-5},
                         Row{"delta", 1.0e-3, 9.4e-4}, Row{"surfpeak", 2.3e-4, 1.7e-5}}) {
    SKIP_WHEN_NOT_SUPPORTED({
      const double a = worst(row.medium, 256, many), b = worst(row.medium, 1024, many);
      std::printf("corrected, %-8s: %.2e at n = 256 (table %.1e), %.2e at 1024 (%.1e)\n", row.medium, a, row.at_256, b,
                  row.at_1024);
      EXPECT_LE(a, 2 * row.at_256 + rounding) << row.medium;
      EXPECT_LE(b, 2 * row.at_1024 + rounding) << row.medium;
    })
  }
}

// G.1: the same for interpolated radiance and transmittance; worse by orders for surfaces.
TEST_P(Preintegrated, PlainLookUp) {
  for (const Row& row : {Row{"ramp", 5.9e-6, 3.7e-7}, Row{"peak", 1.5e-2, 1.1e-3}, Row{"box", 5.2e-3, 2.6e-4},
                         Row{"delta", 2.2e-2, 1.6e-2}, Row{"surfpeak", 4.4e-2, 7e-3}}) {
    SKIP_WHEN_NOT_SUPPORTED({
      const double a = worst(row.medium, 256, many, "plain"), b = worst(row.medium, 1024, many, "plain");
      std::printf("plain, %-8s: %.2e at n = 256 (table %.1e), %.2e at 1024 (%.1e)\n", row.medium, a, row.at_256, b,
                  row.at_1024);
      EXPECT_LE(a, 2 * row.at_256 + rounding) << row.medium;
      EXPECT_LE(b, 2 * row.at_1024 + rounding) << row.medium;
    })
  }
}

// A ramp of values: the error is the table's, whatever the step.
TEST_P(Preintegrated, IndependentOfTheStep){SKIP_WHEN_NOT_SUPPORTED({
  for (int N : {4, 13, 100, 1000}) {
    const double e = worst("smooth", 1024, {N});
    std::printf("smooth medium in %d segments: %.2e\n", N, e);
    EXPECT_LE(e, 5e-6) << N;
  }
})}

// The last segment of a ray is shorter than the table's: the corrected look-up keeps its own length.
TEST_P(Preintegrated, SegmentsOfAnotherLength){SKIP_WHEN_NOT_SUPPORTED({
  for (const char* lookup : {"corrected", "plain"}) {
    json config = golden_medium_config("ramp", 1, false);
    const FrameImage truth = exact(config);
    config["sampling"]["step"] = 0.15;  // six of 0.15 and one of 0.1
    const double e = largest_difference(image(config, 1024, lookup), truth);
    std::printf("last segment of two thirds, %s: %.2e\n", lookup, e);
    EXPECT_LE(e, 2e-4);
  }
})}

// Light factors that vary inside a segment: front and back parts; and everything at once, RGB extinction included.
TEST_P(Preintegrated, WeightedPartsAreGolden) {
  for (const char* id : {"hybrid_shaded_up", "hybrid_up", "hernell_lit", "pure_emission", "kraus_short"}) {
    const json g = golden_case(id);
    SKIP_WHEN_NOT_SUPPORTED({
      const RayIntegral truth = golden_integral(g);
      // A table's ratio belongs to its own length: beside a Dirac term, where segments are cut, they must not be deep.
      for (int N : {g["params"].contains("diracs") ? 3 : 1, 10}) {
        const FrameImage r = image(golden_config(g, N), 1024);
        double e = 0;
        for (std::size_t c = 0; c < 3; ++c)
          e = std::max({e, std::abs(r.color[c] - truth.I[c]), std::abs(r.trans[c] - truth.T[c])});
        std::printf("%s in %d segments: %.2e\n", id, N, e);
        EXPECT_LE(e, N == 3 ? 2e-3 : 2e-4) << id;
      }
    })
  }
}

// The error falls with the square of the number of values.
TEST_P(Preintegrated, SecondOrderInTheTable){SKIP_WHEN_NOT_SUPPORTED({
  const double a = worst("peak", 256, many), b = worst("peak", 1024, many);
  std::printf("peak: %.2e at 256, %.2e at 1024 values\n", a, b);
  EXPECT_GE(a / b, 8);
  EXPECT_LE(a / b, 30);
})}

// The printed equation 22 counts surfaces negative where the value falls: light comes out that never went in. The
// published slide diverges with the depth that it has removed (preintegration.Negative.LiteralSlideIsFound), not here.
TEST_P(Preintegrated, PublishedVariantsShowTheirFaults) {
  json g = golden_case("kraus_short");
  g["ray"] = {{"type", "segment"}, {"v0", 0.1}, {"v1", 0.9}, {"dl", 1}};
  json falling = g;
  std::swap(falling["ray"]["v0"], falling["ray"]["v1"]);
  for (const char* variant : {"corrected", "published", "published_slide"}) {
    const json estimator = {{"type", "preintegrated"}, {"lookup", "plain"}, {"table_size", 160}, {"variant", variant}};
    SKIP_WHEN_NOT_SUPPORTED({
      json up = golden_config(g, 1), down = golden_config(falling, 1);
      up["estimator"] = estimator;
      down["estimator"] = estimator;
      const double T_up = render(up, GetParam()).image.trans[0], T_down = render(down, GetParam()).image.trans[0];
      if (variant == std::string("published")) {
        EXPECT_GT(T_down, 1);
        EXPECT_NEAR(T_down, 1 / T_up, 0.1 / T_up);
      } else {
        EXPECT_NEAR(T_down, T_up, 0.1 * T_up) << variant;  // the slide has not gone far here
      }
    })
  }
}

// A table that is updated in part gives the image of a new one, but for the last bit of an entry.
TEST(PreintegratedUpdates, PartOfATable) {
  const auto image_of = [](double peak, const char* update) {
    json config =
        ray_config({{"field", "sinusoid"}, {"direction", {1, 0, 0}}, {"a", 0.5}, {"b", 0.5}, {"omega", 3}}, 4, 0.3);
    config["optical_model"] =
        model({{0, 0.3}, {0.6, 0.4}, {0.65, peak}, {0.7, 0.4}, {1, 0.5}}, {{0, 1, 0.5, 0.2}, {1, 0.1, 0.6, 1}});
    config["estimator"] = {{"type", "preintegrated"}, {"table_size", 300}, {"update", update}};
    return render(config, targets().front()).image;
  };
  image_of(3, "full");
  const FrameImage partial = image_of(5, "partial");
  for (const double other : {7.0, 8.0}) image_of(other, "full");  // nothing of the first tables is kept
  const FrameImage full = image_of(5, "full");
  EXPECT_LE(largest_difference(partial, full), 3e-7);
  EXPECT_GT(largest_difference(image_of(3, "full"), full), 1e-2) << "the edit does not show";
}

TEST(PreintegratedRefuses, Fp64WhenTheConfigIsChecked) {
  json config = ray_config(ramp_field(0, 1, 1), 1, 0.5);
  config["optical_model"] = model({{0, 1}}, {{0, 1, 1, 1}});
  config["estimator"] = {{"type", "preintegrated"}};
  config["precision"] = "fp64";
  try {
    plan_experiment(parse_document(config.dump(), "test.json", ""), registry());
    FAIL() << "it was accepted";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("precision"), std::string::npos) << e.what();
  }
}

TEST(PreintegratedRefuses, PublishedVariantsElsewhere) {
  const auto refusal = [](const json& estimator) {
    json config = ray_config(ramp_field(0, 1, 1), 1, 0.5);
    config["optical_model"] = model({{0, 1}}, {{0, 1, 1, 1}});
    config["estimator"] = estimator;
    config["estimator"]["type"] = "preintegrated";
    try {
      render(config, targets().front());
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal({{"variant", "published"}}).find("set lookup to \"plain\""), std::string::npos);
  EXPECT_NE(refusal({{"variant", "published"}, {"lookup", "plain"}}).find("at most 512"), std::string::npos);
  EXPECT_EQ(refusal({{"variant", "published"}, {"lookup", "plain"}, {"table_size", 32}}), "");
}

INSTANTIATE_TEST_SUITE_P(Targets, Preintegrated, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
