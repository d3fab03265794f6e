// Precision fp64 and the default one show the same picture of a grid, within what rounding may change; and not the same
// bits, or it would not be computed in double.
#include <cmath>
#include <cstdio>

#include "tests/agreement/one_scan.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

double difference(const FrameImage& strict, const FrameImage& fp64) {
  double worst = 0;
  for (std::size_t k = 0; k < strict.color.size(); ++k)
    worst = std::max({worst, std::abs(double(strict.color[k]) - fp64.color64.at(k)),
                      std::abs(double(strict.trans[k]) - fp64.trans64.at(k))});
  return worst;
}

void expect_close(View view, const json& data, const std::string& what) {
  const FrameImage strict = picture(view, data);
  const double bound = bound_of(view, *field_of(view, data), *field_of(view, data));
  view.config["precision"] = "fp64";
  const FrameImage fp64 = picture(view, data);
  const double worst = difference(strict, fp64);
  std::printf("%s: fp64 and strict differ by %.3g, bound %.3g\n", what.c_str(), worst, bound);
  EXPECT_LE(worst, bound) << what;
  EXPECT_GT(worst, 1e-9) << what << ": the same rounding, so not computed in double";
}

json grid(const char* field, const char* type) {
  json data = {{"type", "procedural"}, {"field", field}, {"size", {26, 24, 22}}, {"voxel_type", type}};
  if (field == std::string("ramp")) data["direction"] = {1, 0.6, 0.4};
  return data;
}

TEST(Fp64, GridsOfEveryVoxelType) {
  for (const char* type : {"uint8", "int8", "uint16", "int16", "float32"}) {
    expect_close(view_of(grid("marschner_lobb", type), 0.2, false), grid("marschner_lobb", type),
                 std::string("marschner_lobb ") + type);
    expect_close(view_of(grid("ramp", type), 0.2, true), grid("ramp", type), std::string("shaded ramp ") + type);
  }
}

TEST(Fp64, ThreadsAndTilesChangeNoBit) {
  json config = view_of(grid("marschner_lobb", "uint8"), 0.2, false).config;
  config["data"] = grid("marschner_lobb", "uint8");
  config["precision"] = "fp64";
  const FrameImage first = render(config, Target{"cpu", {{"type", "cpu"}}}).image;
  const FrameImage second = render(config, Target{"cpu", {{"type", "cpu"}, {"threads", 1}, {"tile", 44}}}).image;
  EXPECT_EQ(first.color64, second.color64);
  EXPECT_EQ(first.trans64, second.trans64);
}

TEST(Fp64, SkippingChangesNoBit) {
  View view = view_of(grid("sphere", "float32"), 0.5, false);
  view.config["data"] = grid("sphere", "float32");
  view.config["optical_model"]["opacity"] = {{0, 0}, {0.3, 0}, {1, 0.5}};
  view.config["precision"] = "fp64";
  const Target cpu{"cpu", {{"type", "cpu"}}};
  const FrameResult all = render(view.config, cpu);
  view.config["sampling"]["skipping"] = true;
  const FrameResult some = render(view.config, cpu);
  EXPECT_GT(some.counters.skipped, 0u);
  EXPECT_EQ(all.image.color64, some.image.color64);
  EXPECT_EQ(all.image.trans64, some.image.trans64);
}

}  // namespace
}  // namespace dvrlab::test
