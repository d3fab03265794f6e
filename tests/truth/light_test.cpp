// Light volumes against closed forms and golden values (docs/math D), and the properties that they must have.
#include <gtest/gtest.h>

#include "tests/truth/truth_test.h"

namespace dvrlab::test {
namespace {

class Light : public testing::TestWithParam<Target> {
 protected:
  LightVolume volume(const json& config) const { return illuminate(config, GetParam()); }
};
const Target fp64{"cpu fp64", {{"type", "cpu"}}};

/// A ramp v = x in [lo, lo + side], `n` points along x, few across; a point or a directional light; direct light only.
json config_of(double lo, double side, int n, const json& extinction, const json& light, const json& pass) {
  return {{"data",
           {{"type", "procedural"},
            {"field", "ramp"},
            {"direction", {1, 0, 0}},
            {"offset", 0},
            {"scale", 1},
            {"size", {n, 5, 5}},
            {"bounds", {{lo, -0.1, -0.1}, {lo + side, 0.1, 0.1}}}}},
          {"optical_model", {{"type", "absorption_emission"}, {"extinction", extinction}, {"tf_entries", 65536}}},
          {"estimator", {{"type", "direct"}}},
          {"lights", {light}},
          {"illumination", {pass}},
          {"camera",
           {{"type", "orthographic"}, {"frame", "data"}, {"position", {0, -3, 0}}, {"up", {0, 0, 1}}, {"height", 2}}},
          {"sampling", {{"type", "uniform"}, {"step", 0.5}, {"unit", "voxel"}}},
          {"image", {{"size", {8, 8}}}}};
}
json point(double x) { return {{"type", "point"}, {"position", {x, 0, 0}}}; }
json from_right() { return {{"type", "directional"}, {"direction", {1, 0, 0}}}; }
/// Lengths in voxels of `side / (n - 1)`.
json piecewise(double segment, int samples) {
  return {{"type", "local_piecewise"},
          {"components", "direct"},
          {"segment", segment},
          {"segment_samples", samples},
          {"shadow_ratio", {1, 1, 1}}};
}

/// The value at grid point (i, 2, 2), the middle of the cross section; `channel` counts planes.
double at(const LightVolume& v, int i, int channel = 0) {
  const auto& n = v.grid.dims;
  const std::size_t index =
      (std::size_t(channel) * std::size_t(n[2]) + std::size_t(n[2] / 2)) * std::size_t(n[1]) + std::size_t(n[1] / 2);
  const std::size_t k = index * std::size_t(n[0]) + std::size_t(i);
  return v.values64 ? (*v.values64)[k] : double((*v.values)[k]);
}

double golden_light(const char* id) {
  for (const json& c : golden()["cases"])
    if (c["id"] == id) return std::stod(c["expect"]["I_d"].get<std::string>());
  throw std::runtime_error(id);
}

// A voxel at 1.35 from the light, segments of 0.25, the last one 0.10 long: golden hernell_Id_homogeneous.
TEST_P(Light, GoldenHomogeneous) {
  if (golden().is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  const double expected = golden_light("hernell_Id_homogeneous");
  json config = config_of(0, 1.5, 31, {{0, 1.7}}, point(1.4), piecewise(5, 4));  // voxel 0.05
  SKIP_WHEN_NOT_SUPPORTED(EXPECT_NEAR(at(volume(config), 1), expected, 1e-6));
  config["illumination"][0]["first_segment"] = "interpolated";
  EXPECT_NEAR(at(volume(config), 1), expected, 1e-6);
  config["precision"] = "fp64";
  EXPECT_NEAR(at(illuminate(config, fp64), 1), expected, 1e-12);
}

// tau = 0.4 + 3 x^2, the light inside the volume at 0.25, the voxel at 0.9: golden hernell_Id_point_inside.
TEST_P(Light, GoldenPointInside) {
  if (golden().is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  const double expected = golden_light("hernell_Id_point_inside");
  json tau = json::array();
  for (int k = 0; k <= 400; ++k) tau.push_back({k / 400.0, 0.4 + 3 * (k / 400.0) * (k / 400.0)});
  const json config = config_of(0, 1, 101, tau, point(0.25), piecewise(20, 80));  // voxel 0.01, segments of 0.2
  SKIP_WHEN_NOT_SUPPORTED(EXPECT_NEAR(at(volume(config), 90), expected, 2e-5));
  EXPECT_NEAR(at(volume(config), 25), 1, 1e-6) << "at the light";
  EXPECT_NEAR(at(volume(config), 10), std::exp(-(0.4 * 0.15 + std::pow(0.25, 3) - std::pow(0.1, 3))), 2e-5)
      << "on the light's other side";
}

// Two layers: 0.5 per length up to x = 1, 2 behind it, seen from the right and from the left.
TEST_P(Light, TwoLayers) {
  const json tau = {{0, 0.5}, {1, 0.5}, {1, 2}, {2, 2}};
  for (const char* pass : {"piecewise", "full"}) {
    json config =
        config_of(0, 2, 201, tau, from_right(),
                  std::string(pass) == "full" ? json{{"type", "shadow_full"}, {"step", 0.5}} : piecewise(8, 16));
    SKIP_WHEN_NOT_SUPPORTED({
      LightVolume v = volume(config);
      for (const int i : {0, 50, 100, 150, 200}) {
        const double x = i / 100.0, left = x < 1 ? 0.5 * (1 - x) + 2 : 2 * (2 - x);
        EXPECT_NEAR(at(v, i), std::exp(-left), 2e-4) << pass << " at " << x;
      }
      config["lights"][0]["direction"] = {-1, 0, 0};
      v = volume(config);
      for (const int i : {0, 50, 100, 150, 200}) {
        const double x = i / 100.0, right = x < 1 ? 0.5 * x : 0.5 + 2 * (x - 1);
        EXPECT_NEAR(at(v, i), std::exp(-right), 2e-4) << pass << " at " << x << " from the left";
      }
    })
  }
}

// Voxels on faces that the light runs along see what lies on their way, as their neighbours inside do.
TEST_P(Light, FacesAlongTheLightAreNotLit) {
  for (const char* pass : {"piecewise", "full"}) {
    const json config =
        config_of(0, 2, 21, {{0, 0.5}, {2, 0.5}}, from_right(),
                  std::string(pass) == "full" ? json{{"type", "shadow_full"}, {"step", 0.5}} : piecewise(4, 4));
    SKIP_WHEN_NOT_SUPPORTED({
      const LightVolume v = volume(config);
      for (std::size_t k = 0; k < v.values->size(); ++k)
        ASSERT_NEAR((*v.values)[k], std::exp(-0.5 * (2 - double(k % 21) / 10)), 1e-5) << pass << " at " << k;
    })
  }
}

// Surfaces take light: tau_s |dv|, Dirac terms and opaque ranges between a voxel and the light.
TEST_P(Light, SurfacesCastShadows) {
  json config = config_of(0, 1, 41, {{0, 0}}, from_right(), piecewise(6, 12));
  config["optical_model"] = {{"type", "hybrid"},
                             {"dl_std", 1},
                             {"dv_std", 0.25},
                             {"tf_entries", 65536},
                             {"surface",
                              {{"opacity", {{0, 0.5}, {1, 0.5}}},
                               {"color", {{0, 1, 1, 1}}},
                               {"delta", {{{"value", 0.51}, {"opacity", 0.75}, {"color", {1, 1, 1}}}}}}}};
  config["estimator"] = {{"type", "exact"}};
  config["optical_model"]["tf"] = "nodes";
  for (const json& pass : {piecewise(6, 12), json{{"type", "shadow_full"}}}) {
    config["illumination"] = {pass};
    SKIP_WHEN_NOT_SUPPORTED({
      const LightVolume v = volume(config);
      for (const int i : {0, 10, 20, 30, 40}) {
        const double x = i / 40.0, T = std::pow(0.5, (1 - x) / 0.25) * (x < 0.51 ? 0.25 : 1);
        EXPECT_NEAR(at(v, i), T, 2e-5) << pass["type"] << " at " << x;
      }
    })
  }
  // Opaque from 0.6 to 0.7: in front of it everything, behind it nothing.
  config = config_of(0, 1, 41, {{0, 0}}, from_right(), piecewise(6, 6));
  config["optical_model"] = {{"type", "absorption_emission"},
                             {"opacity", {{0, 0}, {0.6, 0}, {0.6, 1}, {0.7, 1}, {0.7, 0}}},
                             {"color", {{0, 1, 1, 1}}}};
  config["estimator"] = {{"type", "power_series"}};
  const LightVolume v = volume(config);
  EXPECT_EQ(at(v, 10), 0);
  EXPECT_EQ(at(v, 30), 1);
}

json scattered(double radius, int samples) {
  return {{"type", "local_piecewise"}, {"radius", radius}, {"samples", samples}, {"shadow_ratio", {1, 1, 1}}};
}
/// A cube of constant extinction tau per voxel, 33 points a side.
json cube(double tau, const json& pass) {
  json config = config_of(0, 32, 33, {{0, tau}}, from_right(), pass);
  config["data"] = {
      {"type", "procedural"}, {"field", "constant"}, {"size", {33, 33, 33}}, {"bounds", {{0, 0, 0}, {32, 32, 32}}}};
  return config;
}

// A sphere of radius R that emits everywhere: (1 - e^-tau R) / (tau R), up to the midpoint rule.
TEST_P(Light, AmbientOcclusionOfAUniformMedium) {
  const double tau = 0.2, R = 10;
  const json config = cube(tau, {{"type", "local_ambient_occlusion"},
                                 {"radius", R},
                                 {"samples", 64},
                                 {"solid", "tetrahedron"},
                                 {"subdivisions", 0}});
  SKIP_WHEN_NOT_SUPPORTED(EXPECT_NEAR(at(volume(config), 16), (1 - std::exp(-tau * R)) / (tau * R), 2e-5));
  EXPECT_NEAR(at(volume(cube(0, config["illumination"][0])), 16), 1, 1e-6) << "empty space";
}

// One direction, towards the light: both factors of what is scattered are exponentials.
TEST_P(Light, ScatteringOfAUniformMedium) {
  const double tau = 0.1, R = 8, to_exit = 16;
  json pass = scattered(R, 128);
  pass["directions_done"] = 1;
  // Between voxels an exponential is taken as linear: tau^2 / 12 too much.
  const double linear = 1 + tau * tau / 12;
  // lao: (1/R) int_0^R e^(-tau (to_exit - r)) e^(-tau r) dr = e^(-tau to_exit)
  SKIP_WHEN_NOT_SUPPORTED(EXPECT_NEAR(at(volume(cube(tau, pass)), 16), linear * std::exp(-tau * to_exit), 2e-5));
  pass["normalisation"] = "physical";
  pass["albedo"] = 0.7;
  EXPECT_NEAR(at(volume(cube(tau, pass)), 16), 0.7 * tau * R * linear * std::exp(-tau * to_exit), 2e-5);
  // Light that reaches every voxel alike: no extinction for light rays has no scattering either, so take a thin medium.
  const double thin = 1e-4;
  pass.erase("directions_done");
  pass["albedo"] = 1;
  pass["radius"] = 8;
  EXPECT_NEAR(at(volume(cube(thin, pass)), 16) / (1 - std::exp(-thin * 8)), std::exp(-thin * to_exit), 2e-3);
  json lao = scattered(8, 4);
  EXPECT_NEAR(at(volume(cube(1e-9, lao)), 16), 1, 1e-6) << "unoccluded: as much as arrives";
  EXPECT_NEAR(at(volume(cube(1e-9, lao)), 0), 1, 1e-6) << "unoccluded, at the boundary";
}

// The weights of two directions, towards the light and the farthest from it, by the phase function.
TEST_P(Light, HenyeyGreensteinWeights) {
  const double tau = 0.1, g = 0.6;
  json pass = scattered(4, 8);
  const auto after = [&](int k) {
    pass["directions_done"] = k;
    return at(volume(cube(tau, pass)), 16);
  };
  SKIP_WHEN_NOT_SUPPORTED({
    const double first = after(1);
    const double both = after(2);
    pass["phase"] = "henyey_greenstein";
    pass["g"] = g;
    const double c = -1;  // the octahedron has opposite directions
    const double w0 = std::pow(1 + g * g - 2 * g, -1.5), w1 = std::pow(1 + g * g - 2 * g * c, -1.5);
    const double second = 2 * both - first;
    EXPECT_NEAR(after(1), first, 1e-6);
    EXPECT_NEAR(after(2), (w0 * first + w1 * second) / (w0 + w1), 2e-6);
    EXPECT_GT(std::abs(after(2) - both), 1e-3) << "the weights matter here";
    pass.erase("g");
    pass["g_of_value"] = {{0, g}};
    EXPECT_NEAR(after(2), (w0 * first + w1 * second) / (w0 + w1), 2e-6);
  })
}

json cloud(const json& pass) {
  json config = cube(0, pass);
  config["data"] = {
      {"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {29, 27, 25}}, {"voxel_type", "uint8"}};
  config["optical_model"] = {{"type", "absorption_emission"},
                             {"length_unit", "voxel"},
                             {"extinction", {{0.3, 0}, {0.5, 0.3}, {0.7, 0}}},
                             {"color", {{0, 1, 0.8, 0.5}}}};
  config["lights"] = {{{"type", "directional"}, {"direction", {1, 0.4, 0.8}}}};
  return config;
}

// Refinement: after all directions, one by one or by fives, the bits of the one-shot result; and after k the same from
// scratch.
TEST_P(Light, ProgressiveIsTheOneShotResult) {
  for (const char* phase : {"isotropic", "henyey_greenstein"}) {
    json pass = scattered(6, 3);
    pass["phase"] = phase;
    SKIP_WHEN_NOT_SUPPORTED({
      const LightVolume once = volume(cloud(pass));
      pass["progressive"] = true;
      for (const int k : {1, 2, 7, 31}) {
        pass["directions_done"] = k;
        pass["progressive"] = false;
        const LightVolume scratch = volume(cloud(pass));
        pass["progressive"] = true;
        EXPECT_EQ(*volume(cloud(pass)).values, *scratch.values) << k;
        EXPECT_NE(*scratch.values, *once.values);
      }
      pass["directions_done"] = 32;
      EXPECT_EQ(*volume(cloud(pass)).values, *once.values);
    })
  }
}

// More extinction never brightens direct light or light from a sphere.
TEST_P(Light, MoreExtinctionIsDarker) {
  for (const json& pass : {piecewise(4, 4), json{{"type", "shadow_full"}}, json{{"type", "local_ambient_occlusion"}}}) {
    json config = cloud(pass);
    SKIP_WHEN_NOT_SUPPORTED({
      const LightVolume thin = volume(config);
      config["optical_model"]["extinction"] = {{0.3, 0.02}, {0.5, 0.4}, {0.7, 0.02}};
      const LightVolume thick = volume(config);
      for (std::size_t k = 0; k < thin.values->size(); ++k) ASSERT_LE((*thick.values)[k], (*thin.values)[k] + 1e-6f);
      EXPECT_LT((*thick.values)[0], (*thin.values)[0]);
    })
  }
}

// Four lights in one pass are the sum of four single ones in their colours; a fifth light makes a second pass.
TEST_P(Light, LightsAddUp) {
  json config = cloud(scattered(5, 2));
  const std::vector<json> lights = {{{"type", "directional"}, {"direction", {1, 0.4, 0.8}}, {"color", {0.3, 0.1, 0.1}}},
                                    {{"type", "point"}, {"position", {0.2, 0.1, 0.3}}, {"color", {0.1, 0.2, 0.1}}},
                                    {{"type", "point"}, {"position", {3, -2, 1}}, {"color", {0.1, 0.1, 0.4}}},
                                    {{"type", "directional"}, {"direction", {-1, 0, 0}}, {"color", {0.2, 0.2, 0.1}}}};
  config["lights"] = lights;
  SKIP_WHEN_NOT_SUPPORTED({
    const LightVolume all = volume(config);
    ASSERT_EQ(all.grid.channels, 3);
    std::vector<float> sum(all.values->size());
    // The directions follow the first light, so that single lights keep it as a black one.
    for (const json& light : lights) {
      json black = lights[0];
      black["color"] = {0, 0, 0};
      config["lights"] = {black, light};
      const LightVolume one = volume(config);
      ASSERT_EQ(one.grid.channels, 3);
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += (*one.values)[k];
    }
    for (std::size_t k = 0; k < sum.size(); ++k) ASSERT_NEAR(sum[k], (*all.values)[k], 2e-6);
  })
}

// More lights than a stage has channels: a second pass, the same sum. Local shading takes four.
TEST_P(Light, ManyLights) {
  json config = cloud(piecewise(4, 4));
  std::vector<json> lights;
  for (int k = 0; k < 6; ++k)
    lights.push_back(
        {{"type", "directional"}, {"direction", {std::cos(k), std::sin(k), 0.5}}, {"color", {0.1, 0.1, 0.1}}});
  config["lights"] = lights;
  SKIP_WHEN_NOT_SUPPORTED({
    const LightVolume all = volume(config);
    std::vector<float> sum(all.values->size());
    for (const json& light : lights) {
      config["lights"] = {light};
      const LightVolume one = volume(config);
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += (*one.values)[k];
    }
    for (std::size_t k = 0; k < sum.size(); ++k) ASSERT_NEAR(sum[k], (*all.values)[k], 2e-6);
  })
  config["lights"] = lights;
  config["illumination"].push_back({{"type", "blinn_phong"}});
  EXPECT_THROW(scene_of(config), InputError);
}

// Loops that a software GPU would cut short are refused there, and filled on the cpu.
TEST_P(Light, LongLoopsAreWholeOrRefused) {
  json config = cloud({{"type", "shadow_full"}, {"step", 0.0005}});
  config["data"]["size"] = {4, 4, 4};
  const bool gpu = !GetParam().name.starts_with("cpu");
  try {
    const LightVolume v = volume(config);
    EXPECT_FALSE(gpu && v.values->empty());
    config["illumination"][0]["step"] = 0.01;
    const LightVolume coarse = volume(config);
    for (std::size_t k = 0; k < v.values->size(); ++k) ASSERT_NEAR((*v.values)[k], (*coarse.values)[k], 1e-3);
  } catch (const NotSupported& reason) {
    EXPECT_TRUE(gpu) << reason.what();
  }
}

// RGB extinction: every channel is a grey medium of its own.
TEST_P(Light, ColouredExtinction) {
  json config = cloud(scattered(5, 2));
  const std::array<double, 3> tau{0.05, 0.2, 0.4};
  config["optical_model"]["extinction"] = {{0.3, 0, 0, 0}, {0.5, tau[0], tau[1], tau[2]}, {0.7, 0, 0, 0}};
  SKIP_WHEN_NOT_SUPPORTED({
    const LightVolume rgb = volume(config);
    ASSERT_EQ(rgb.grid.channels, 3);
    for (std::size_t c = 0; c < 3; ++c) {
      config["optical_model"]["extinction"] = {{0.3, 0}, {0.5, tau[c]}, {0.7, 0}};
      const LightVolume grey = volume(config);
      for (std::size_t k = 0; k < grey.values->size(); ++k)
        ASSERT_NEAR((*rgb.values)[c * grey.values->size() + k], (*grey.values)[k], 1e-6);
    }
  })
}

// bias, blend and a medium's opacity for light rays.
TEST_P(Light, WhatActsOfIt) {
  json pass = scattered(5, 2);
  SKIP_WHEN_NOT_SUPPORTED({
    const LightVolume plain = volume(cloud(pass));
    pass["bias"] = 0.25;
    pass["blend"] = 0.5;
    const LightVolume mixed = volume(cloud(pass));
    for (std::size_t k = 0; k < plain.values->size(); ++k)
      ASSERT_NEAR((*mixed.values)[k], 0.5 + 0.5 * (0.25 + 0.75 * (*plain.values)[k]), 1e-6);
    pass = scattered(5, 2);
    pass["light_opacity_scale"] = 0;
    for (const float x : *volume(cloud(pass)).values) ASSERT_NEAR(x, 1, 1e-6);
  })
}

// The piecewise result is close to the full one; with a coarse shadow volume less so.
TEST_P(Light, PiecewiseIsCloseToFull) {
  const auto error = [&](int ratio) {
    json pass = piecewise(4, 4);
    pass["shadow_ratio"] = {ratio, ratio, ratio};
    const LightVolume a = volume(cloud(pass)), b = volume(cloud({{"type", "shadow_full"}}));
    double sum = 0;
    for (std::size_t k = 0; k < a.values->size(); ++k) sum += std::pow((*a.values)[k] - (*b.values)[k], 2);
    return std::sqrt(sum / double(a.values->size()));
  };
  SKIP_WHEN_NOT_SUPPORTED({
    const double fine = error(1), coarse = error(8);
    std::printf("piecewise to full: rms %.4f at 1:1, %.4f at 1:8\n", fine, coarse);
    EXPECT_LT(fine, 0.03);
    EXPECT_LT(fine, coarse);
  })
}

// A ray through a lit medium: golden hernell_lit, with the light volume linear from 1 to 0.1 along the ray.
TEST_P(Light, VolumeLightsTheMedium) {
  // T_lp of a homogeneous medium is no line, so the light comes from a ramp of lights: here the factor itself is
  // checked.
  json config = cloud(piecewise(4, 4));
  config["estimator"] = {{"type", "exact"}};
  config["optical_model"]["tf"] = "nodes";
  SKIP_WHEN_NOT_SUPPORTED({
    const FrameResult lit = render(config, GetParam());
    config["illumination"][0]["blend"] = 0;
    const FrameResult unlit = render(config, GetParam());
    config["illumination"] = json::array();
    const FrameResult none = render(config, GetParam());
    EXPECT_LE(largest_difference(unlit.image, none.image), 1e-6) << "blend 0: a factor of 1";
    EXPECT_GT(largest_difference(lit.image, none.image), 0.05);
    for (std::size_t k = 0; k < lit.image.color.size(); ++k) ASSERT_LE(lit.image.color[k], none.image.color[k] + 1e-6f);
    EXPECT_EQ(lit.image.trans, none.image.trans);
  })
}

// A mesh of any kind of cells casts the light of its field: here the ramp of two layers.
TEST_P(Light, MeshesCastShadows) {
  const json tau = {{0, 0.5}, {1, 0.5}, {1, 2}, {2, 2}};
  for (const char* cells : {"tetrahedra6", "hexahedra", "wedges15"}) {
    json config = config_of(0, 2, 9, tau, from_right(), {{"type", "shadow_full"}, {"step", 0.5}, {"resolution", 101}});
    config["data"]["evaluate"] = "mesh";
    config["data"]["cells"] = cells;
    config["optical_model"]["color"] = {{0, 1, 1, 1}};
    config["camera"]["height"] = 0.1;
    config["estimator"] = {{"type", "exact"}};
    config["optical_model"]["tf"] = "nodes";
    config["sampling"] = {{"type", "faces"}, {"step", 100}};
    SKIP_WHEN_NOT_SUPPORTED({
      const LightVolume v = volume(config);
      ASSERT_EQ(v.grid.dims[0], 101);
      for (const int i : {0, 25, 75, 100}) {
        const double x = 2 * i / 100.0;
        EXPECT_NEAR(at(v, i), std::exp(-(x < 1 ? 0.5 * (1 - x) + 2 : 2 * (2 - x))), 2e-3) << cells << " at " << x;
      }
      const FrameResult lit = render(config, GetParam());
      config["illumination"] = json::array();
      EXPECT_GT(largest_difference(lit.image, render(config, GetParam()).image), 0.01);
    })
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, Light, testing::ValuesIn(targets()), target_name);

// In levels of equal steps up to the largest, each within half a step of the float; in fp64 likewise.
TEST(LightStorage, LevelsAreWithinHalfAStep) {
  json config = cloud(scattered(5, 2));
  for (const Target& target : {targets().front(), fp64}) {
    SCOPED_TRACE(target.name);
    if (target.name == fp64.name) config["precision"] = "fp64";
    config["illumination"][0]["storage"] = "float32";
    const LightVolume as_floats = illuminate(config, target);
    EXPECT_EQ(as_floats.levels, nullptr);
    config["illumination"][0]["storage"] = "unorm16";
    const LightVolume v = illuminate(config, target);
    ASSERT_NE(v.levels, nullptr);
    const float largest = *std::max_element(as_floats.values->begin(), as_floats.values->end());
    EXPECT_NEAR(double(v.unit), double(largest) / 65535, 1e-6 * double(largest) / 65535);
    EXPECT_EQ(*std::max_element(v.levels->begin(), v.levels->end()), 65535);
    std::size_t beyond = 0, apart = 0;
    for (std::size_t i = 0; i < v.values->size(); ++i) {
      const double difference = std::abs(double((*v.values)[i]) - double((*as_floats.values)[i]));
      beyond += difference > 0.5001 * double(v.unit) + 1e-7 * double(largest) ? 1 : 0;
      apart += difference > 0.1 * double(v.unit) ? 1 : 0;
    }
    EXPECT_EQ(beyond, 0u);
    EXPECT_GT(apart, 0u) << "nothing was rounded";
  }
}

// On the cpu they lie beside voxels of 8 or 16 bits, laid there when one of both changes and only then.
TEST(LightStorage, LiesBesideTheVoxels) {
  const auto laid = [](const json& config, const Target& target) {
    const FrameResult result = render(config, target);
    return std::any_of(result.times.begin(), result.times.end(),
                       [](const PhaseTime& t) { return t.phase == "light beside the voxels"; });
  };
  const Target& cpu = targets().front();
  json config = cloud(scattered(5, 2));
  config["data"]["voxel_type"] = "uint8";
  EXPECT_FALSE(laid(config, cpu)) << "floats";
  config["illumination"][0]["storage"] = "unorm16";
  EXPECT_TRUE(laid(config, cpu));
  EXPECT_FALSE(laid(config, cpu)) << "nothing changed";
  config["camera"]["position"] = {0, 3, 0.5};
  EXPECT_FALSE(laid(config, cpu)) << "a camera move";
  config["illumination"][0]["bias"] = 0.15;
  EXPECT_TRUE(laid(config, cpu)) << "another light";
  config["data"]["voxel_type"] = "int16";
  EXPECT_TRUE(laid(config, cpu)) << "other voxels";
  config["data"]["voxel_type"] = "float32";
  EXPECT_FALSE(laid(config, cpu)) << "voxels of 32 bits";
  config["data"]["voxel_type"] = "uint16";
  config["lights"][0]["color"] = {1, 0.5, 0.2};
  EXPECT_FALSE(laid(config, cpu)) << "light in colours";
}

/// Labels of the stages that were run.
std::vector<std::string> run_of(const json& config) {
  std::vector<PhaseTime> times;
  illuminate(config, targets().front(), &times);
  std::vector<std::string> run;
  for (const PhaseTime& t : times)
    if (t.seconds > 0) run.push_back(t.phase.substr(6));
  return run;
}

TEST(LightUpdates, WalksDoNotKnowWhoLooks) {
  using Run = std::vector<std::string>;
  json config = cloud({{"type", "path_traced"}, {"samples", 4}, {"orders", 1}});
  EXPECT_EQ(run_of(config), (Run{"walk", "combine"}));
  config["camera"]["position"] = {0, 3, 0.5};
  config["image"]["background"] = {0.1, 0.2, 0.3};
  config["optical_model"]["color"] = {{0, 0.2, 1, 0.5}};
  EXPECT_EQ(run_of(config), Run{}) << "a camera move, a background and a colour";
  config["illumination"][0]["bias"] = 0.2;
  EXPECT_EQ(run_of(config), Run{"combine"});
}

// Nothing is computed again that did not change: the camera, the bias, the radius, the shadow volume, a light, the
// medium.
TEST(LightUpdates, OnlyWhatChanged) {
  using Run = std::vector<std::string>;
  json config = cloud(scattered(5, 2));
  json& pass = config["illumination"][0];
  const Run all = {"segment", "shadow", "direct", "scatter", "combine"};
  pass["bias"] = 0.123;
  EXPECT_EQ(run_of(config), all);
  EXPECT_EQ(run_of(config), Run{});
  config["camera"]["position"] = {0, 3, 0.5};
  EXPECT_EQ(run_of(config), Run{}) << "a camera move";
  pass["bias"] = 0.2;
  EXPECT_EQ(run_of(config), Run{"combine"});
  config["optical_model"]["color"] = {{0, 0.2, 1, 0.5}};
  EXPECT_EQ(run_of(config), Run{}) << "a colour is no extinction";
  pass["radius"] = 6;
  EXPECT_EQ(run_of(config), (Run{"scatter", "combine"}));
  pass["shadow_ratio"] = {2, 2, 2};
  EXPECT_EQ(run_of(config), (Run{"shadow", "direct", "scatter", "combine"}));
  config["lights"][0]["direction"] = {0, 1, 0};
  EXPECT_EQ(run_of(config), all) << "a light move";
  config["optical_model"]["extinction"] = {{0.3, 0}, {0.5, 0.31}, {0.7, 0}};
  EXPECT_EQ(run_of(config), all) << "another transfer function";
  config["lights"][0] = {{"type", "head"}};
  EXPECT_EQ(run_of(config), all);
  config["camera"]["position"] = {1, 3, 0.5};
  EXPECT_EQ(run_of(config), all) << "a light that moves with the camera";
  // One direction more: the ones before it are there.
  pass["progressive"] = true;
  pass["directions_done"] = 3;
  EXPECT_EQ(run_of(config).size(), 4u) << "three directions and the result";
  pass["directions_done"] = 4;
  EXPECT_EQ(run_of(config), (Run{"scatter, directions 4 to 4", "combine"}));
}

}  // namespace
}  // namespace dvrlab::test
