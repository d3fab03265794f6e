// Metrics against values worked out by hand.
#include "framework/interfaces/metric.h"

#include <cmath>
#include <limits>

#include "tests/data/test_data.h"

namespace dvrlab {
namespace {

using Values = std::vector<std::pair<std::string, double>>;

Values compare(const std::string& metric, const FrameImage& image, const FrameImage& reference,
               const nlohmann::json& values = nlohmann::json::object()) {
  return test::registry()
      .get<MetricPlugin>("metric", metric)
      .compare(test::parameters("metric", metric, values), image, reference);
}

double value(const Values& values, const std::string& name) {
  for (const auto& [n, x] : values)
    if (n == name) return x;
  ADD_FAILURE() << "no value " << name;
  return 0;
}

// 2 x 1 pixels; errors 0.1, 0.2 in red, 0.3 in green of the second pixel.
const FrameImage reference{2, 1, {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f}, {0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f}};
const FrameImage image{2, 1, {0.6f, 0.5f, 0.5f, 0.3f, 0.8f, 0.5f}, {0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.75f}};

TEST(Rmse, ByHand) {
  const Values v = compare("rmse", image, reference);
  EXPECT_EQ(v.front().first, "rmse");
  EXPECT_NEAR(value(v, "rmse.r"), std::sqrt(0.05 / 2), 1e-7);
  EXPECT_NEAR(value(v, "rmse.g"), std::sqrt(0.09 / 2), 1e-7);
  EXPECT_EQ(value(v, "rmse.b"), 0);
  EXPECT_NEAR(value(v, "rmse"), std::sqrt(0.14 / 6), 1e-7);
}

TEST(Psnr, ByHand) {
  const Values v = compare("psnr", image, reference, {{"peak", 2}});
  EXPECT_EQ(v.front().first, "psnr");
  EXPECT_NEAR(value(v, "psnr"), 10 * std::log10(4 / (0.14 / 6)), 1e-5);
  EXPECT_NEAR(value(v, "psnr.r"), 10 * std::log10(4 / 0.025), 1e-5);
  EXPECT_EQ(value(v, "psnr.b"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(value(v, "psnr.mean_db"), std::numeric_limits<double>::infinity());
  FrameImage grey = reference;
  for (float& x : grey.color) x += 0.125f;
  EXPECT_DOUBLE_EQ(value(compare("psnr", grey, reference), "psnr"), 10 * std::log10(64.0));
  EXPECT_DOUBLE_EQ(value(compare("psnr", grey, reference), "psnr.mean_db"), 10 * std::log10(64.0));
  EXPECT_EQ(value(compare("psnr", reference, reference), "psnr"), std::numeric_limits<double>::infinity());
}

TEST(Bias, ByHand) {
  const Values v = compare("bias", image, reference);
  EXPECT_EQ(v.front().first, "bias");
  EXPECT_NEAR(value(v, "bias.r"), (0.1 - 0.2) / 2, 1e-7);
  EXPECT_NEAR(value(v, "bias.g"), 0.3 / 2, 1e-7);
  EXPECT_NEAR(value(v, "bias"), 0.2 / 6, 1e-7);
  EXPECT_NEAR(value(v, "bias.depth"), (std::log(0.25) - std::log(0.75)) / 6, 1e-7);
  EXPECT_EQ(value(v, "bias.opaque"), 0);
  FrameImage opaque = image;
  opaque.trans[5] = 0;  // has no finite depth: left out
  EXPECT_EQ(value(compare("bias", opaque, reference), "bias.depth"), 0);
  EXPECT_NEAR(value(compare("bias", opaque, reference), "bias.opaque"), 1.0 / 6, 1e-12);
}

TEST(Transmittance, RiseAndFall) {
  const Values v = compare("transmittance", image, reference), back = compare("transmittance", reference, image);
  EXPECT_EQ(v.front().first, "transmittance");
  EXPECT_EQ(value(v, "transmittance"), 0.5);
  EXPECT_EQ(value(v, "transmittance.rise"), 0.5);
  EXPECT_EQ(value(v, "transmittance.fall"), 0);
  EXPECT_EQ(value(back, "transmittance.rise"), 0);
  EXPECT_EQ(value(back, "transmittance.fall"), 0.5);
  EXPECT_NEAR(value(v, "transmittance.mean"), 0.5 / 6, 1e-12);
  FrameImage spoilt = image;
  spoilt.trans[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isnan(value(compare("transmittance", spoilt, reference), "transmittance")));
}

// A flat half, and a half with a checkerboard of the reference's: only the flat windows count.
TEST(RegionVariance, CountsHomogeneousWindowsOnly) {
  const int n = 12;
  FrameImage flat{n, n, std::vector<float>(3 * n * n, 0.5f), std::vector<float>(3 * n * n, 0.0f)}, noisy = flat;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      for (int c = 0; c < 3; ++c) {
        const std::size_t i = std::size_t(3 * (y * n + x) + c);
        if (x >= n / 2) flat.color[i] = (x + y) % 2 == 0 ? 0.2f : 0.8f;
        noisy.color[i] = (x + y) % 2 == 0 ? 0.4f : 0.6f;
      }
  const nlohmann::json keys = {{"radius", 1}, {"threshold", 0.01}, {"opacity", 0.5}};
  const Values v = compare("region_variance", noisy, flat, keys);
  // nine pixels, five of one kind: mean m = +-0.1 / 9, mean square 0.01
  EXPECT_NEAR(value(v, "region_variance"), 0.01 - 0.01 / 81, 1e-7);
  EXPECT_NEAR(value(v, "region_variance.reference"), 0, 1e-12);
  EXPECT_NEAR(value(v, "region_variance.area"), 4.0 * 10 / (n * n), 1e-12);
  EXPECT_NEAR(value(v, "region_variance.relative"), (0.01 - 0.01 / 81) / (0.25 + 0.01 / 81), 1e-6);
  FrameImage background = flat;
  for (float& t : background.trans) t = 1;
  EXPECT_TRUE(std::isnan(value(compare("region_variance", noisy, background, keys), "region_variance")));
}

// Images in fp64 are measured in fp64.
TEST(Metrics, TakeTheBestPrecision) {
  FrameImage a = reference, b = reference;
  for (FrameImage* f : {&a, &b}) {
    f->color64.assign(6, 0.5);
    f->trans64.assign(6, 0.25);
  }
  a.color64[1] += 1e-12;
  EXPECT_NEAR(value(compare("max_abs", a, b), "max_abs"), 1e-12, 1e-15);
  EXPECT_NEAR(value(compare("rmse", a, b), "rmse"), 1e-12 / std::sqrt(6), 1e-15);
  EXPECT_NEAR(value(compare("psnr", a, b), "psnr"), 240 + 10 * std::log10(6), 1e-3);
}

TEST(MaxAbs, FindsThePixel) {
  const Values v = compare("max_abs", image, reference);
  EXPECT_EQ(v.front().first, "max_abs");
  EXPECT_EQ(value(v, "max_abs"), 0.5);
  EXPECT_EQ(value(v, "max_abs.transmittance"), 0.5);
  EXPECT_NEAR(value(v, "max_abs.radiance"), 0.3, 1e-7);
  EXPECT_EQ(value(v, "max_abs.x"), 1);
  EXPECT_EQ(value(v, "max_abs.y"), 0);
  EXPECT_EQ(value(compare("max_abs", reference, reference), "max_abs"), 0);
  FrameImage broken = reference;
  broken.color[1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(value(compare("max_abs", broken, reference), "max_abs"), std::numeric_limits<double>::infinity());
}

TEST(Metrics, RefuseOtherSizes) {
  const FrameImage tall{1, 2, reference.color, reference.trans};
  for (const std::string metric : {"psnr", "rmse", "max_abs"})
    EXPECT_THROW(compare(metric, tall, reference), InputError);
}

}  // namespace
}  // namespace dvrlab
