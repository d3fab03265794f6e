// The `my_metric` metric on images whose difference is known.
#include "framework/interfaces/metric.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

double headline(const std::string& of, const FrameImage& a, const FrameImage& b) {
  const PluginEntryInfo& e = registry().find("metric", "my_metric");
  const ParameterSet values("metric", {e.descriptor->parameters[0]}, {{"of", of}});
  return registry().get<MetricPlugin>("metric", "my_metric").compare(values, a, b).at(0).second;
}

TEST(MyMetric, MeanOfAllDifferences) {
  const FrameImage a{2, 1, {0, 0, 0, 1, 1, 1}, {1, 1, 1, 1, 1, 1}};
  FrameImage b = a;
  EXPECT_EQ(headline("radiance", a, b), 0);
  b.color[4] = 0.25f;
  EXPECT_DOUBLE_EQ(headline("radiance", a, b), 0.75 / 6);
  EXPECT_EQ(headline("transmittance", a, b), 0) << "only the radiance differs";
}

}  // namespace
}  // namespace dvrlab::test
