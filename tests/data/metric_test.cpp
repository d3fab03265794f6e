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
