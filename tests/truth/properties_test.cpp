// Properties that hold for every medium (docs/math, section A, P4 to P6), on random hybrid media and for every
// estimator that they are promised for. P1 to P3: exact_test; P7: tests/preintegration.
#include <gtest/gtest.h>

#include <random>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

class Properties : public testing::TestWithParam<Target> {
 protected:
  FrameImage image(const json& config) const { return render(config, GetParam()).image; }
};

/// Opacity nodes over [0, 1] (times `unit`), jumps among them.
json random_nodes(std::mt19937& random, double highest, double unit = 1) {
  std::uniform_real_distribution<double> uniform(0, 1);
  json nodes = json::array();
  double v = 0;
  for (int k = 0; k < 6; ++k) {
    nodes.push_back({v * unit, highest * uniform(random)});
    if (k % 3 != 1) v += 0.05 + 0.25 * uniform(random);  // every third pair is a jump
  }
  return nodes;
}

/// Particles, selective absorption and surfaces of one colour, or of a colour per channel that is at most 1.
json random_model(std::uint32_t seed, bool one_color) {
  std::mt19937 random(seed);
  const json color = one_color ? json{{0, 0.7, 0.4, 0.9}} : json{{0, 1, 0.2, 0.5}, {1, 0.1, 1, 0.7}};
  json m = {{"type", "hybrid"},
            {"tf", "nodes"},
            {"dl_std", 0.7},
            {"dv_std", 0.3},
            {"color", color},
            {"surface", {{"opacity", random_nodes(random, 0.9)}}},
            {"scattering", {{"opacity", random_nodes(random, 0.7)}}}};
  if (!one_color)
    m["absorption"] = {{"density", random_nodes(random, 0.5)}, {"transmission_color", {{0, 0.9, 0.3, 0.6}}}};
  return m;
}

json random_ray(std::uint32_t seed, bool one_color, const json& estimator, int segments) {
  json config = ray_config(
      {{"field", "sinusoid"}, {"direction", {1, 0, 0}}, {"a", 0.5}, {"b", 0.5}, {"omega", 2.3}, {"phi", 0.4 * seed}}, 3,
      3.0 / segments);
  config["optical_model"] = random_model(seed, one_color);
  config["estimator"] = estimator;
  return config;
}

// P4: with one colour, C = c (1 - T), whatever the depth.
TEST_P(Properties, OneColourIsColourTimesOpacity) {
  for (const json& estimator :
       {json{{"type", "exact"}}, json{{"type", "approximative"}}, json{{"type", "preintegrated"}, {"table_size", 256}},
        json{{"type", "preintegrated"}, {"table_size", 256}, {"lookup", "plain"}}, json{{"type", "power_series"}},
        json{{"type", "power_series"}, {"shading", "constant"}},
        json{{"type", "power_series"}, {"shading", "nonlinear"}}}) {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      SKIP_WHEN_NOT_SUPPORTED({
        const FrameImage r = image(random_ray(seed, true, estimator, 11));
        const double color[] = {0.7, 0.4, 0.9};
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(double(r.color[c]), color[c] * (1 - double(r.trans[c])), 4e-6) << estimator.dump() << seed;
      })
    }
  }
}

// P5: the units of length and value are conventions: a world and a transfer function that are stretched alike give the
// same image.
TEST_P(Properties, UnitsDoNotMatter) {
  for (const json& estimator : {json{{"type", "direct"}}, json{{"type", "average"}}, json{{"type", "approximative"}},
                                json{{"type", "power_series"}}, json{{"type", "preintegrated"}, {"table_size", 256}},
                                json{{"type", "exact"}}}) {
    const double length = 4, value = 8;  // powers of 2: not even the rounding changes
    json config = random_ray(3, false, estimator, 16);
    json other = config;
    other["data"]["bounds"] = {{-8 * length, -8 * length, -8 * length}, {8 * length, 8 * length, 8 * length}};
    other["data"]["omega"] = 2.3 / length;
    other["data"]["a"] = 0.5 * value;
    other["data"]["b"] = 0.5 * value;
    other["camera"]["t"] = {0, 3 * length};
    other["sampling"]["step"] = 3.0 / 16 * length;
    json& m = other["optical_model"];
    m["dl_std"] = 0.7 * length;
    m["dv_std"] = 0.3 * value;
    for (const char* key :
         {"/color", "/surface/opacity", "/scattering/opacity", "/absorption/density", "/absorption/transmission_color"})
      for (json& node : m[json::json_pointer(key)]) node[0] = node[0].get<double>() * value;
    SKIP_WHEN_NOT_SUPPORTED(EXPECT_LE(largest_difference(image(config), image(other)), 2e-6) << estimator.dump())
    // Negative control: surfaces scale with the value, not with the length.
    m["dv_std"] = 0.3;
    SKIP_WHEN_NOT_SUPPORTED(EXPECT_GT(largest_difference(image(config), image(other)), 1e-3))
  }
}

// P6: without emission, with colours and light factors of at most 1, no more light comes than is taken away. Colours
// reach 1 in one channel or another, and light factors go from 1 to less along the ray, so the bound is near.
TEST_P(Properties, NoMoreLightThanOpacity) {
  const json light = {
      {"type", "prescribed"}, {"m0", {1, 1, 1}}, {"m1", {1, 0.5, 1}}, {"k0", {1, 0.4, 1}}, {"k1", {0.7, 1, 1}}};
  for (const json& estimator :
       {json{{"type", "direct"}}, json{{"type", "average"}}, json{{"type", "average"}, {"rule", "mean_density"}},
        json{{"type", "approximative"}}, json{{"type", "power_series"}},
        json{{"type", "power_series"}, {"shading", "nonlinear"}}, json{{"type", "preintegrated"}, {"table_size", 256}},
        json{{"type", "exact"}}}) {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      json config = random_ray(seed, false, estimator, 7);
      config["optical_model"]["color"] = {{0, 1, 0.2, 1}, {1, 1, 1, 1}};
      config["optical_model"].erase("absorption");  // takes light without giving any: the bound would be far away
      if (seed % 2 == 0) config["illumination"] = {light};
      SKIP_WHEN_NOT_SUPPORTED({
        const FrameImage r = image(config);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_LE(double(r.color[c]), 1 - double(r.trans[c]) + 4e-6) << estimator.dump() << seed;
        if (seed % 2 == 1) {
          EXPECT_NEAR(double(r.color[2]), 1 - double(r.trans[2]), 4e-6) << "the bound is met";
        }
      })
    }
  }
  // Negative control: without the self-attenuation of a segment (alpha_over_m false) there may be more.
  json config = random_ray(1, true, {{"type", "approximative"}, {"alpha_over_m", false}}, 1);
  config["optical_model"]["dl_std"] = 0.05;
  config["optical_model"]["color"] = {{0, 1, 1, 1}};
  SKIP_WHEN_NOT_SUPPORTED({
    const FrameImage r = image(config);
    EXPECT_GT(double(r.color[0]), 1.1);
  })
}

// Every pixel of an image of emitting particles and surfaces is affine in 1 / dl_std, and its depth in 1 / dv_std (Yang
// et al. 2012, figures 9 and 10: the global parameters act on one kind of content each).
TEST_P(Properties, PixelsAreAffineInTheInverseOfTheStandards) {
  json config = {
      {"data", {{"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {24, 24, 24}}}},
      {"optical_model",
       {{"type", "hybrid"},
        {"length_unit", "voxel"},
        {"surface", {{"opacity", {{0.3, 0}, {0.5, 0.4}, {0.7, 0}}}, {"color", {{0, 1, 0.5, 0.2}}}}},
        {"emission", {{"intensity", {{0.2, 0}, {0.9, 0.3}}}, {"color", {{0, 0.2, 0.4, 1}}}}}}},
      {"estimator", {{"type", "preintegrated"}, {"table_size", 256}}},
      {"camera", {{"type", "perspective"}, {"position", {1.3, -2.2, 1.1}}, {"up", {0, 0, 1}}, {"fov_deg", 30}}},
      {"sampling", {{"type", "uniform"}, {"step", 1}, {"termination", 0}}},
      {"image", {{"size", {24, 20}}}}};
  const auto of = [&](double dl, double dv) {
    config["optical_model"]["dl_std"] = dl;
    config["optical_model"]["dv_std"] = dv;
    return image(config);
  };
  SKIP_WHEN_NOT_SUPPORTED({
    const FrameImage a = of(4, 0.2), b = of(12, 0.2), c = of(600, 0.2), d = of(4, 1), e = of(4, 40);
    // where b lies between a and c on the line in 1 / dl_std; d between a and e in 1 / dv_std
    const double w = (1.0 / 12 - 1.0 / 600) / (1.0 / 4 - 1.0 / 600), u = (1 - 1.0 / 40) / (5 - 1.0 / 40);
    double largest = 0, curved = 0;
    for (std::size_t i = 0; i < a.color.size(); ++i) {
      EXPECT_NEAR(double(b.color[i]), w * a.color[i] + (1 - w) * c.color[i], 3e-6 * (1 + a.color[i]));
      EXPECT_EQ(a.trans[i], c.trans[i]) << "emission takes no light";
      const auto depth = [i](const FrameImage& f) { return -std::log(double(f.trans[i])); };
      EXPECT_NEAR(depth(d), u * depth(a) + (1 - u) * depth(e), 3e-6 * (1 + depth(a) / a.trans[i] * 1e-1));
      largest = std::max(largest, depth(a));
      curved = std::max(curved, std::abs(double(d.color[i]) - (u * a.color[i] + (1 - u) * e.color[i])));
    }
    EXPECT_GT(largest, 1) << "there is something to see";
    EXPECT_GT(curved, 1e-2) << "negative control: radiance is not affine in 1 / dv_std";
  })
}

INSTANTIATE_TEST_SUITE_P(Targets, Properties, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
