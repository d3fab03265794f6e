// Non-linear gradient interpolation (Guetat et al. 2010; docs/math B.7): the cubic through the light factors of the
// linearly interpolated gradient, integrated exactly, by 2-D tables C_0 .. C_3 and by power series.
#include <cmath>
#include <cstdio>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

class NonlinearGradient : public testing::TestWithParam<Target> {
 protected:
  FrameImage image(json config, const json& estimator) const {
    config["estimator"] = estimator;
    if (estimator["type"] != "exact") config["optical_model"].erase("tf");
    return render(config, GetParam()).image;
  }
};

constexpr double mu = 1.5, length = 2.0, side = 0.6, centre = 1.1;

/// One segment past the centre of a radial field, where the gradient turns by more than a right angle: a homogeneous
/// medium, lit from the eye.
json turning_ray() {
  json config =
      ray_config({{"field", "radial"}, {"center", {centre, side, 0}}, {"offset", 0}, {"scale", 0.5}}, length, length);
  config["optical_model"] = {{"type", "absorption_emission"},
                             {"tf", "nodes"},
                             {"shaded", true},
                             {"extinction", {{0, mu}}},
                             {"color", {{0, 0.8, 0.5, 0.2}}}};
  config["lights"] = {{{"type", "head"}}};
  config["illumination"] = {
      {{"type", "blinn_phong"}, {"ambient", 0.1}, {"diffuse", 0.7}, {"specular", 0.3}, {"shininess", 4}}};
  return config;
}

/// Its light: k and b of the interpolated gradient at place w, N.V = N.H = cos.
std::array<double, 2> light_at(double w) {
  const auto gradient = [](double l) {
    const double x = l - centre, r = std::hypot(x, side);
    return std::array<double, 2>{x / r, -side / r};
  };
  const auto g0 = gradient(0), g1 = gradient(length);
  const double x = g0[0] + (g1[0] - g0[0]) * w, y = g0[1] + (g1[1] - g0[1]) * w;
  const double cosine = std::abs(x) / std::hypot(x, y);
  return {0.1 + 0.7 * cosine, 0.3 * std::pow(cosine, 4)};
}

/// The integral of mu (k c + b) e^(-mu l) under the cubic (or under the light itself) by 4000 midpoints. `order_one`:
/// in its place the mean of mu (k c + b), attenuated as one, which is what order 1 of the power series takes.
double expected(double color, bool cubic, bool order_one = false) {
  std::array<std::array<double, 2>, 4> at;
  for (std::size_t k = 0; k < 4; ++k) at[k] = light_at(double(k) / 3);
  double sum = 0;
  constexpr int n = 4000;
  for (int i = 0; i < n; ++i) {
    const double w = (i + 0.5) / n;
    std::array<double, 2> f = light_at(w);
    if (cubic) {
      f = {0, 0};
      for (int k = 0; k < 4; ++k) {
        double basis = 1;
        for (int j = 0; j < 4; ++j)
          if (j != k) basis *= (3 * w - j) / (k - j);
        for (std::size_t part = 0; part < 2; ++part) f[part] += basis * at[std::size_t(k)][part];
      }
    }
    const double through = order_one ? -std::expm1(-mu * length) / (mu * length) : std::exp(-mu * length * w);
    sum += mu * length / n * (f[0] * color + f[1]) * through;
  }
  return sum;
}

TEST_P(NonlinearGradient, IsTheCubicOfItsFourPlaces) {
  const double color[3] = {0.8, 0.5, 0.2};
  const std::vector<json> estimators = {{{"type", "exact"}},
                                        {{"type", "power_series"}},
                                        {{"type", "power_series"}, {"order", 3}},
                                        {{"type", "preintegrated"}, {"table_size", 512}},
                                        {{"type", "preintegrated"}, {"table_size", 512}, {"lookup", "plain"}}};
  for (json estimator : estimators) {
    SKIP_WHEN_NOT_SUPPORTED({
      estimator["shading"] = "nonlinear";
      const FrameImage r = image(turning_ray(), estimator);
      estimator["shading"] = "linear";
      const FrameImage linear = image(turning_ray(), estimator);
      for (std::size_t c = 0; c < 3; ++c) {
        const bool series = estimator["type"] == "power_series", one = series && !estimator.contains("order");
        EXPECT_NEAR(r.color[c], expected(color[c], true, one), series && !one ? 2e-3 : 1e-5) << estimator.dump();
        EXPECT_GT(std::abs(linear.color[c] - expected(color[c], true, one)), 0.03) << "negative control";
      }
      EXPECT_NEAR(r.trans[0], std::exp(-mu * length), 1e-5) << estimator.dump();
    })
  }
}

/// Particles and narrow layers under a light that the gradient turns, in a few deep and shallow segments.
json layers(int segments) {
  json config = turning_ray();
  config["sampling"]["step"] = length / segments;
  config["optical_model"]["extinction"] = {{0, 0.2}, {0.35, 0.3}, {0.4, 3}, {0.45, 0.5}, {0.6, 1}};
  config["optical_model"]["color"] = {{0, 0.2, 0.4, 1}, {0.4, 1, 0.6, 0.1}, {0.6, 0.3, 0.9, 0.4}};
  return config;
}

TEST_P(NonlinearGradient, TablesAndSeriesFollowTheExactIntegral) {
  for (int segments : {4, 12}) {
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage exact = image(layers(segments), {{"type", "exact"}, {"shading", "nonlinear"}});
      const auto error = [&](json estimator) {
        estimator["shading"] = "nonlinear";
        return largest_difference(image(layers(segments), estimator), exact);
      };
      const double table = error({{"type", "preintegrated"}, {"table_size", 2048}});
      const double plain = error({{"type", "preintegrated"}, {"table_size", 2048}, {"lookup", "plain"}});
      const double one = error({{"type", "power_series"}});
      const double three = error({{"type", "power_series"}, {"order", 3}});
      const double published = error({{"type", "power_series"}, {"order", 3}, {"variant", "published_gradient"}});
      std::printf("%d segments: 2-D %.1e, plain %.1e, order 1 %.1e, order 3 %.1e; equation 24 as printed %.1e\n",
                  segments, table, plain, one, three, published);
      EXPECT_LE(table, 6e-5);
      EXPECT_LE(plain, 1e-4);
      EXPECT_LE(three, segments == 4 ? 2e-3 : 3e-5);
      EXPECT_LE(one, segments == 4 ? 3e-2 : 3e-3);
      EXPECT_LT(three, one);
      EXPECT_GT(published, 20 * three) << "the sign error of equation 24";
    })
  }
}

// Dirac terms cut the segment: its pieces have their parts of the cubic.
TEST_P(NonlinearGradient, PiecesBetweenDiracTermsKeepTheCubic) {
  json config = turning_ray();
  config["optical_model"] = {{"type", "hybrid"},
                             {"tf", "nodes"},
                             {"scattering", {{"opacity", {{0, 0.3}}}, {"color", {{0, 0.8, 0.5, 0.2}}}}},
                             {"surface",
                              {{"opacity", {{0.2, 0}, {0.4, 0.5}, {0.6, 0}}},
                               {"delta", {{{"value", 0.5}, {"opacity", 0.4}}, {{"value", 0.42}, {"opacity", 0.2}}}}}},
                             {"dv_std", 0.2}};
  config["sampling"]["step"] = length / 3;
  SKIP_WHEN_NOT_SUPPORTED({
    const FrameImage exact = image(config, {{"type", "exact"}, {"shading", "nonlinear"}});
    const FrameImage linear = image(config, {{"type", "exact"}, {"shading", "linear"}});
    EXPECT_GT(largest_difference(linear, exact), 2e-3);
    for (json estimator : {json{{"type", "preintegrated"}, {"table_size", 2048}}, json{{"type", "power_series"}}}) {
      // What a ratio of another length and order 1 leave, linear light has too.
      estimator["shading"] = "linear";
      const double rest = largest_difference(image(config, estimator), linear);
      estimator["shading"] = "nonlinear";
      const double error = largest_difference(image(config, estimator), exact);
      std::printf("%s: %.1e under linear light, %.1e under the cubic\n", estimator.dump().c_str(), rest, error);
      EXPECT_LE(rest, 3e-3) << estimator.dump();
      EXPECT_LE(error, 2 * rest + 1e-5) << estimator.dump();
    }
  })
}

INSTANTIATE_TEST_SUITE_P(Targets, NonlinearGradient, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
