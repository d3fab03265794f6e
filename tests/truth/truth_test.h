// What the truth tests share: golden data or a verdict, every target, the error of an image.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/support/golden_case.h"
#include "tests/support/render.h"

namespace dvrlab::test {

using nlohmann::json;

/// The largest error of radiance and transmittance of the first pixel.
inline double error_of(const FrameImage& image, const RayIntegral& truth) {
  double worst = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    worst = std::max(worst, std::abs(double(image.color[c]) - truth.I[c]));
    worst = std::max(worst, std::abs(double(image.trans[c]) - truth.T[c]));
  }
  return worst;
}

/// A test on one target that needs the golden values.
class GoldenOnTarget : public testing::TestWithParam<Target> {
 protected:
  void SetUp() override {
    if (golden().is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  }
};

/// The target's name as a part of a test's name.
inline std::string target_name(const testing::TestParamInfo<Target>& instance) {
  std::string name = instance.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == ' ' || c == '.'; }, '_');
  return name;
}

}  // namespace dvrlab::test

#define SKIP_WHEN_NOT_SUPPORTED(...)                    \
  try {                                                 \
    __VA_ARGS__;                                        \
  } catch (const NotSupported& reason) {                \
    GTEST_SKIP() << "not supported: " << reason.what(); \
  }
