// Empty-space skipping is speed only: the same bits with and without, for tables as coarse as they come, whose cells
// smear what contributes over values that contribute nothing.
#include <algorithm>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

class Skipping : public testing::TestWithParam<std::string> {};

/// Light where the estimator's factors vary in a segment.
json config(json estimator) {
  const bool exact = estimator["type"] == "exact", lit = estimator.value("shading", "") == "nonlinear";
  const json light = {{"type", "blinn_phong"}};
  return {{"data", {{"type", "nrrd"}, {"file", std::string(DVRLAB_SOURCE) + "/data/engine.nrrd"}}},
          {"optical_model",
           {{"type", "absorption_emission"},
            {"tf", exact ? "nodes" : "table"},
            {"length_unit", "voxel"},
            {"shaded", lit},
            {"opacity",
             {{90, 0}, {100, 0.2}, {110, 0}, {180, 0}, {200, 0.5}, {204, 0}, {230, 0}, {230, 1}, {240, 1}, {240, 0}}},
            {"color", {{0, 0.2, 0.4, 1}, {255, 1, 0.7, 0.2}}}}},
          {"illumination", lit ? json::array({light}) : json::array()},
          {"estimator", std::move(estimator)},
          {"camera", {{"type", "perspective"}, {"position", {1.3, -2.2, 1.1}}, {"up", {0, 0, 1}}, {"fov_deg", 34}}},
          {"sampling", {{"type", "uniform"}, {"step", 0.8}, {"termination", 1e-3}}},
          {"image", {{"size", {64, 48}}}}};
}

/// Those that ask for the medium at a value, not for a table's cell: none of it is smeared.
bool pointwise(const std::string& type) { return type == "direct" || type == "rk4" || type == "exact"; }

std::vector<json> estimators_of(const std::string& type) {
  std::vector<json> list = {{{"type", type}}};
  if (type == "exact") list.push_back({{"type", type}, {"shading", "nonlinear"}});
  if (pointwise(type)) return list;
  if (type == "power_series") {
    list.push_back({{"type", type}, {"table_size", 16}, {"variant", "published"}});
    list.push_back({{"type", type}, {"table_size", 64}, {"variant", "published"}});
  }
  for (int size : {5, 16, 64}) {
    list.push_back({{"type", type}, {"table_size", size}});
    if (type == "average") list.back()["rule"] = "exact_depth";
    if (type == "power_series") {
      list.back()["order"] = 2;
      for (int order : {3, 4}) list.push_back({{"type", type}, {"table_size", size}, {"order", order}});
      list.push_back({{"type", type}, {"table_size", size}, {"order", 3}, {"shading", "nonlinear"}});
    }
    if (type == "preintegrated") {
      list.push_back({{"type", type}, {"table_size", size}, {"shading", "nonlinear"}});
      list.push_back({{"type", type}, {"table_size", size}, {"lookup", "plain"}});
      list.push_back({{"type", type}, {"table_size", 256}, {"depth_table_size", size}});
    }
  }
  return list;
}

TEST_P(Skipping, ChangesNoBit) {
  int smeared = 0;
  const json fine = config({{"type", "direct"}});
  const Scene precise = scene_of(fine);
  for (const json& estimator : estimators_of(GetParam())) {
    json c = config(estimator);
    const FrameResult with = render(c, targets().front());
    c["sampling"]["skipping"] = false;
    const FrameResult without = render(c, targets().front());
    EXPECT_EQ(differing_values(with.image, without.image), 0u) << estimator.dump();
    EXPECT_EQ(without.counters.skipped, 0u);
    if (estimator.value("table_size", 0) == 16) {
      c["sampling"]["skipping"] = true;
      for (const Target& target : targets()) {
        try {
          const FrameResult there = render(c, target);
          EXPECT_EQ(differing_values(there.image, without.image), 0u) << estimator.dump() << target.name;
          EXPECT_EQ(there.counters.skipped, with.counters.skipped) << target.name;
        } catch (const NotSupported&) {  // counted by the tests of agreement
        }
      }
    }
    if (std::min(estimator.value("table_size", 4096), estimator.value("depth_table_size", 4096)) >= 64) {
      EXPECT_GT(with.counters.skipped, 0u) << estimator.dump();
    }
    // Negative control: the macrocells that are empty to somebody who asks pointwise are not empty to coarse tables.
    c["sampling"]["skipping"] = true;
    const FrameResult wrong = render(c, targets().front(), [&](FrameJob& job) {
      for (Buffer& b : job.frame.buffers)
        for (const Buffer& other : precise.job.frame.buffers)
          if (b.name == other.name && b.name == "frame_skip_distance") b = other;
    });
    smeared += differing_values(wrong.image, without.image) > 0;
  }
  if (!pointwise(GetParam())) {
    EXPECT_GT(smeared, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Estimators, Skipping,
                         testing::Values("direct", "rk4", "exact", "average", "approximative", "power_series",
                                         "engel_1d", "kye_1d", "preintegrated"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace dvrlab::test
