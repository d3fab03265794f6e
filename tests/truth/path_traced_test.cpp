// Random walks against closed forms, and the approximations of light against random walks.
#include <gtest/gtest.h>

#include "tests/truth/truth_test.h"

namespace dvrlab::test {
namespace {

const Target cpu{"cpu", {{"type", "cpu"}}};

/// A cube of constant extinction tau per voxel, `n` points a side; light from the right.
json cube(double tau, int n, const json& pass) {
  const double side = n - 1;
  return {{"data",
           {{"type", "procedural"},
            {"field", "constant"},
            {"size", {n, n, n}},
            {"bounds", {{0, 0, 0}, {side, side, side}}}}},
          {"optical_model", {{"type", "absorption_emission"}, {"extinction", {{0, tau}}}}},
          {"estimator", {{"type", "direct"}}},
          {"lights", {{{"type", "directional"}, {"direction", {1, 0, 0}}}}},
          {"illumination", {pass}},
          {"camera", {{"type", "orthographic"}, {"position", {0, -3, 0}}, {"up", {0, 0, 1}}, {"height", 2}}},
          {"sampling", {{"type", "uniform"}, {"step", 0.5}, {"unit", "voxel"}}},
          {"image", {{"size", {8, 8}}}}};
}
json walks(int samples, const json& more) { return patched({{"type", "path_traced"}, {"samples", samples}}, more); }

/// Mean of (a - b) / error, its deviation from 0 in standard errors of the mean, and the root of its mean square.
struct Pull {
  double mean, spread;
};
template <class Truth>
Pull pull(const LightVolume& v, Truth truth) {
  double sum = 0, square = 0, count = 0;
  for (std::size_t k = 0; k < v.values->size(); ++k) {
    if (!((*v.error)[k] > 0)) continue;
    const double z = (double((*v.values)[k]) - truth(k)) / double((*v.error)[k]);
    sum += z;
    square += z * z;
    ++count;
  }
  return {sum / std::sqrt(count), std::sqrt(square / count)};
}

// Albedo 1 in light from all around: whatever is scattered stays, so every walk brings exactly the light of the
// surroundings.
TEST(PathTraced, WhiteFurnace) {
  for (const char* phase : {"isotropic", "henyey_greenstein"}) {
    const json pass = walks(16, {{"environment", 1}, {"components", "scattered"}, {"phase", phase}});
    json config = cube(0.4, 9, pass);
    config["lights"][0]["color"] = {1, 1, 1};
    config["lights"][0]["direction"] = {1, 0.3, 0.2};
    // The light itself is taken away by the difference to the same walks without surroundings.
    const LightVolume with = illuminate(config, cpu);
    config["illumination"][0]["environment"] = 0;
    const LightVolume without = illuminate(config, cpu);
    for (std::size_t k = 0; k < with.values->size(); ++k)
      ASSERT_NEAR((*with.values)[k] - (*without.values)[k], 1, 2e-5) << phase;
    config["illumination"][0]["environment"] = 1;
    config["illumination"][0]["albedo"] = 0.9;
    EXPECT_LT((*illuminate(config, cpu).values)[364], (*with.values)[364] - 0.05) << "absorption is seen";
  }
}

// Direct light: the transmittance, within the error that the result states.
TEST(PathTraced, DirectLightIsTheTransmittance) {
  const double tau = 0.15;
  const int n = 11;
  const LightVolume v = illuminate(cube(tau, n, walks(256, {{"components", "direct"}})), cpu);
  const Pull p = pull(v, [&](std::size_t k) { return std::exp(-tau * (n - 1 - double(k % n))); });
  std::printf("direct light: mean %.2f standard errors off, spread %.3f of the stated\n", p.mean, p.spread);
  EXPECT_LT(std::abs(p.mean), 4);
  EXPECT_NEAR(p.spread, 1, 0.1) << "the stated error is the error";
  const Pull wrong = pull(v, [&](std::size_t k) { return std::exp(-1.05 * tau * (n - 1 - double(k % n))); });
  EXPECT_GT(std::abs(wrong.mean), 6) << "negative control: 5 % more extinction";
}

// One scattering in a medium so thin that nothing is dimmed: albedo tau times the mean way out of the box.
TEST(PathTraced, OneScatteringInAThinMedium) {
  const double tau = 1e-3;
  const int n = 9;
  const LightVolume v =
      illuminate(cube(tau, n, walks(65536, {{"components", "scattered"}, {"orders", 1}, {"albedo", 0.5}})), cpu);
  // The mean distance from the centre of a cube of side 1 to its surface, over all directions: 0.610687.
  const std::size_t centre = (4 * 9 + 4) * 9 + 4;
  const double expected = 0.5 * tau * 8 * 0.610687;
  EXPECT_NEAR((*v.values)[centre], expected, 4 * (*v.error)[centre] + 0.01 * expected);
  EXPECT_LT((*v.error)[centre], 0.1 * expected);
}

json cloud(const json& pass) {
  json config = cube(0, 11, pass);
  config["data"] = {{"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {13, 12, 11}}};
  config["optical_model"] = {{"type", "absorption_emission"},
                             {"length_unit", "voxel"},
                             {"extinction", {{0.2, 0.02}, {0.5, 0.12}, {0.8, 0.02}}}};
  config["lights"] = {{{"type", "directional"}, {"direction", {1, 0.4, 0.8}}}};
  return config;
}

// `physical` with a radius beyond the volume is one scattering, up to its own midpoint rule and directions. Segments
// reach to the light, so that no transmittance is interpolated on the way.
TEST(PathTraced, PhysicalScatteringIsOneOrder) {
  for (const char* phase : {"isotropic", "henyey_greenstein"}) {
    json pass = {{"type", "local_piecewise"},
                 {"normalisation", "physical"},
                 {"albedo", 0.8},
                 {"radius", 24},
                 {"samples", 96},
                 {"subdivisions", 3},
                 {"segment", 30},
                 {"segment_samples", 96},
                 {"shadow_ratio", {1, 1, 1}},
                 {"weights", "solid_angle"},
                 {"phase", phase}};
    const LightVolume fine = illuminate(cloud(pass), cpu);
    const json random = walks(2048, {{"components", "scattered"}, {"orders", 1}, {"albedo", 0.8}, {"phase", phase}});
    const LightVolume truth = illuminate(cloud(random), cpu);
    double worst = 0, outside = 0;
    for (std::size_t k = 0; k < truth.values->size(); ++k) {
      const double z = std::abs(double((*truth.values)[k]) - double((*fine.values)[k])) / double((*truth.error)[k]);
      worst = std::max(worst, z);
      outside += z > 3 ? 1 : 0;
    }
    outside /= double(truth.values->size());
    std::printf("%s: %.2f %% of the voxels beyond 3 standard errors (chance: 0.27 %%), worst %.1f\n", phase,
                100 * outside, worst);
    EXPECT_LT(outside, 0.02);
    const auto mean_pull = [&](const LightVolume& v) {
      return pull(truth, [&](std::size_t k) { return double((*v.values)[k]); }).mean;
    };
    pass["albedo"] = 0.76;
    const double right = mean_pull(fine), wrong = mean_pull(illuminate(cloud(pass), cpu));
    std::printf("%s: all voxels together %.1f standard errors off, with 5 %% less albedo %.1f\n", phase, right, wrong);
    EXPECT_LT(std::abs(right), 0.25 * std::abs(wrong)) << "negative control: 5 % less albedo";
  }
}

// Light that is scattered once more: the sum of two orders, up to what voxels and directions leave.
TEST(PathTraced, TwoOrdersAreTheIterated) {
  json pass = {{"type", "local_piecewise"},
               {"normalisation", "physical"},
               {"albedo", 0.8},
               {"radius", 24},
               {"samples", 48},
               {"subdivisions", 2},
               {"segment", 30},
               {"segment_samples", 96},
               {"shadow_ratio", {1, 1, 1}},
               {"weights", "solid_angle"},
               {"orders", 2}};
  const json random = walks(2048, {{"components", "scattered"}, {"orders", 2}, {"albedo", 0.8}});
  const LightVolume truth = illuminate(cloud(random), cpu);
  const auto relative = [&](const LightVolume& v) {
    double difference = 0, sum = 0;
    for (std::size_t k = 0; k < truth.values->size(); ++k) {
      difference += double((*v.values)[k]) - double((*truth.values)[k]);
      sum += double((*truth.values)[k]);
    }
    return difference / sum;
  };
  const double two = relative(illuminate(cloud(pass), cpu));
  pass["orders"] = 1;
  const double one = relative(illuminate(cloud(pass), cpu));
  std::printf("two orders: %.2f %% off, one order instead: %.1f %%\n", 100 * two, 100 * one);
  EXPECT_LT(std::abs(two), 0.02);
  EXPECT_LT(one, -0.1) << "negative control: the second order is seen";
}

// More walks, a smaller error: by the square root of their number.
TEST(PathTraced, TheErrorFallsWithTheRoot) {
  const auto rms = [&](int samples) {
    double square = 0;
    const LightVolume v = illuminate(cloud(walks(samples, {{"albedo", 0.9}})), cpu);
    for (const float e : *v.error) square += double(e) * double(e);
    return std::sqrt(square);
  };
  EXPECT_NEAR(rms(64) / rms(1024), 4, 0.6);
}

TEST(PathTraced, SaysWhatItCannotDo) {
  json config = cloud(walks(4, {}));
  config["optical_model"] = {
      {"type", "data_space"}, {"dv_std", 0.2}, {"surface", {{"opacity", {{0, 0.5}}}, {"color", {{0, 1, 1, 1}}}}}};
  EXPECT_THROW(scene_of(config), InputError);
  config = cloud(walks(4, {}));
  config["lights"] = json::array();
  EXPECT_THROW(scene_of(config), InputError);
}

// ---- walks that begin at the camera ---------------------------------------------------------------------------------

struct Traced {
  FrameImage image;
  double error_rms = 0;
};
Traced traced(json config, const json& pass) {
  config["illumination"] = {patched(pass, {{"target", "image"}})};
  const FrameResult r = render(config, cpu);
  for (const auto& [name, value] : r.light)
    if (name == "error_rms") return {r.image, value};
  throw std::logic_error("no standard error");
}
double mean_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += double(a[k]) - double(b[k]);
  return sum / double(a.size());
}

TEST(PathTracedImage, DirectLightAndTransmittanceAreThoseOfTheMarch) {
  json config = cube(0.15, 11, {{"type", "shadow_full"}, {"step", 0.5}});
  config["sampling"] = {{"type", "uniform"}, {"step", 0.25}, {"unit", "voxel"}, {"termination", 0}};
  config["image"] = {{"size", {12, 12}}, {"background", {0.2, 0.5, 0.1}}};
  config["optical_model"]["emission"] = {{0, 0.01, 0.02, 0.03}};
  config["lights"][0]["color"] = {1, 0.8, 0.6};
  const FrameImage marched = render(config, cpu).image;
  const Traced t = traced(config, walks(1024, {{"components", "direct"}}));
  const double pixels = 144;
  std::printf("mean difference %.1e of radiance, %.1e of transmittance; stated error of a pixel %.1e\n",
              mean_difference(t.image.color, marched.color), mean_difference(t.image.trans, marched.trans),
              t.error_rms);
  EXPECT_LT(std::abs(mean_difference(t.image.color, marched.color)), 4 * t.error_rms / std::sqrt(pixels));
  EXPECT_LT(std::abs(mean_difference(t.image.trans, marched.trans)), 4 * 0.5 / std::sqrt(pixels * 1024));
  double square = 0;
  for (std::size_t k = 0; k < t.image.color.size(); ++k) {
    const double d = double(t.image.color[k]) - double(marched.color[k]);
    square += d * d;
  }
  EXPECT_NEAR(std::sqrt(square / (3 * pixels)) / t.error_rms, 1, 0.15) << "the stated error is the error";
  config["optical_model"]["extinction"] = {{0, 0.165}};
  EXPECT_GT(std::abs(mean_difference(t.image.color, render(config, cpu).image.color)),
            6 * t.error_rms / std::sqrt(pixels))
      << "negative control: 10 % more extinction";
}

TEST(PathTracedImage, WhiteFurnace) {
  json config = cube(0.3, 9, json::object());
  const json pass = walks(64, {{"environment", 1}, {"components", "scattered"}});
  const FrameImage with = traced(config, pass).image;
  const FrameImage without = traced(config, patched(pass, {{"environment", 0}})).image;
  double largest = 0;
  for (std::size_t k = 0; k < with.color.size(); ++k) {
    ASSERT_NEAR(with.color[k] - without.color[k], 1 - with.trans[k], 2e-5);
    largest = std::max(largest, double(with.color[k]));
  }
  EXPECT_GT(largest, 0.5);
}

// The volume of the same walks, marched, and a pass that approximates it.
TEST(PathTracedImage, AgreesWithTheVolumeAndWithOneOrderOfLocalPiecewise) {
  json config = cube(0.2, 11, walks(2048, {{"components", "scattered"}, {"orders", 1}, {"albedo", 0.8}}));
  config["sampling"] = {{"type", "uniform"}, {"step", 0.25}, {"unit", "voxel"}, {"termination", 0}};
  const FrameImage by_volume = render(config, cpu).image;
  const Traced t = traced(config, walks(2048, {{"components", "scattered"}, {"orders", 1}, {"albedo", 0.8}}));
  const double error = t.error_rms / 8;  // of the mean over 8 x 8 pixels
  EXPECT_LT(std::abs(mean_difference(t.image.color, by_volume.color)), 5 * error);
  config["illumination"] = {{{"type", "local_piecewise"},
                             {"normalisation", "physical"},
                             {"albedo", 0.8},
                             {"radius", 18},
                             {"samples", 36},
                             {"subdivisions", 2},
                             {"segment", 2},
                             {"segment_samples", 8},
                             {"shadow_ratio", {1, 1, 1}}}};
  const FrameImage approximated = render(config, cpu).image;
  double mean = 0;
  for (const float x : t.image.color) mean += double(x) / double(t.image.color.size());
  std::printf("one order: mean %.4f, local piecewise off by %.1e, the volume by %.1e, error %.1e\n", mean,
              mean_difference(approximated.color, t.image.color), mean_difference(by_volume.color, t.image.color),
              error);
  EXPECT_LT(std::abs(mean_difference(approximated.color, t.image.color)), 0.03 * mean + 3 * error);
}

TEST(PathTracedImage, RefusesWhatItCannotSee) {
  const auto refused = [](const json& change, const char* word) {
    json config = patched(cube(0.2, 5, walks(4, {{"target", "image"}})), change);
    try {
      render(config, cpu);
      ADD_FAILURE() << word;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find("illumination[0].target"), std::string::npos) << e.what();
    }
  };
  refused({{"optical_model", {{"extinction", {{0, 0.1, 0.2, 0.3}}}}}}, "same for all colours");
  refused({{"illumination", {walks(4, {{"target", "image"}}), {{"type", "blinn_phong"}}}}}, "local shading");
  refused({{"optical_model", {{"extinction", {{0, 0}}}, {"emission", {{0, 1, 1, 1}}}}}}, "glows");
  EXPECT_THROW(probe(cube(0.2, 5, walks(4, {{"target", "image"}})), 1, 1), NotSupported);
}

}  // namespace
}  // namespace dvrlab::test
