// Opaque prediction (Lee and Shin 2013, section 4.2; docs/math B.6): the first opaque value on the way ends the ray, in
// both directions, for every estimator that sees the ends of segments; where there is none it changes nothing.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

class OpaquePredictions : public testing::TestWithParam<Target> {};

struct Wall {
  double v0, v1;
  std::array<double, 3> color;
};

std::vector<Wall> random_walls(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> ends;
  for (int k = 0; k < 2 * count; ++k) ends.push_back(0.02 + 0.96 * uniform(random));
  std::sort(ends.begin(), ends.end());
  std::vector<Wall> walls;
  for (int k = 0; k < count; ++k) {
    const double a = ends[std::size_t(2 * k)], b = ends[std::size_t(2 * k + 1)];
    if (b > a) walls.push_back({a, b, {uniform(random), uniform(random), uniform(random)}});
  }
  return walls;
}

/// A medium that is opaque in the walls and empty elsewhere.
json walls_model(const std::vector<Wall>& walls) {
  json opacity = {{0, 0}}, color = {{0, 0, 0, 0}};
  for (const Wall& w : walls) {
    opacity.insert(opacity.end(), {{w.v0, 0}, {w.v0, 1}, {w.v1, 1}, {w.v1, 0}});
    for (double v : {w.v0, w.v1}) color.push_back({v, w.color[0], w.color[1], w.color[2]});
  }
  return {{"type", "absorption_emission"}, {"opacity", opacity}, {"color", color}};
}

/// The wall that the way from v0 to v1 meets first; null for none.
const Wall* first_wall(const std::vector<Wall>& walls, double v0, double v1) {
  const Wall* first = nullptr;
  double nearest = 2;
  for (const Wall& w : walls) {
    const bool meets = std::min(v0, v1) <= w.v1 && std::max(v0, v1) >= w.v0;
    const double entrance = v1 >= v0 ? std::max(w.v0, v0) : std::min(w.v1, v0);
    if (meets && std::abs(entrance - v0) < nearest) {
      first = &w;
      nearest = std::abs(entrance - v0);
    }
  }
  return first;
}

TEST_P(OpaquePredictions, NeverMissTheFirstWall) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  int met = 0, falling = 0, lost = 0;
  // A GPU compiles a shader for every number of walls.
  const bool gpu = GetParam().backend["type"] != "cpu";
  for (int trial = 0; trial < (gpu ? 16 : 60); ++trial) {
    const std::vector<Wall> walls = random_walls(random, gpu ? 1 + 9 * (trial % 2) : 1 + trial % 20);
    const double v0 = uniform(random), v1 = uniform(random);
    const Wall* first = first_wall(walls, v0, v1);
    json config = ray_config(ramp_field(v0, v1, 1), 1, 1.0 / (1 + trial % 7));
    config["optical_model"] = walls_model(walls);
    config["image"]["background"] = {9, 9, 9};
    for (const char* estimator : {"approximative", "power_series", "engel_1d", "kye_1d", "preintegrated", "exact"}) {
      config["estimator"] = {{"type", estimator}};
      config["optical_model"]["tf"] = estimator == std::string("exact") ? "nodes" : "table";
      if (estimator == std::string("preintegrated")) config["estimator"]["table_size"] = 64;
      // In front of a wall lies nothing, but tables smear its own capped extinction over a bin before it.
      config["optical_model"]["tf_entries"] = 65536;
      SKIP_WHEN_NOT_SUPPORTED({
        const FrameImage r = render(config, GetParam()).image;
        if (first == nullptr) {
          EXPECT_EQ(r.trans[0], 1.0f) << estimator << " " << trial;
          continue;
        }
        EXPECT_EQ(r.trans[0], 0.0f) << estimator << " " << trial;
        // Only the table's colours in the bin of the wall's edge may differ.
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(r.color[c], first->color[c], 0.02) << estimator << " " << trial;
        ++met;
        if (estimator == std::string("exact")) continue;
        // Negative control: the prediction as published loses a wall that a falling segment meets.
        config["estimator"]["opaque_prediction"] = "published";
        const FrameImage published = render(config, GetParam()).image;
        const bool inside = first->v0 <= v0 && v0 <= first->v1;
        if (v1 < v0 && !inside) {
          ++falling;
          lost += published.trans[0] != 0.0f || largest_difference(published, r) > 0.02;
        } else if (v1 > v0) {
          EXPECT_EQ(differing_values(published, r), 0u) << estimator << " " << trial;
        }
      })
    }
  }
  std::printf("%d walls met; published: %d of %d falling segments lose theirs\n", met, lost, falling);
  EXPECT_GT(met, 40);
  EXPECT_GT(lost, falling / 2);
}

// Without opaque values the switch has nothing to say: the same bits.
TEST_P(OpaquePredictions, ChangeNothingWithoutOpaqueValues) {
  json config = ray_config(
      {{"field", "sinusoid"}, {"direction", {1, 0, 0}}, {"a", 0.5}, {"b", 0.45}, {"omega", 9}, {"phi", 0.3}}, 3, 0.17);
  config["optical_model"] = {{"type", "absorption_emission"},
                             {"opacity", {{0.1, 0}, {0.4, 0.6}, {0.5, 0.9}, {0.8, 0.1}}},
                             {"color", {{0, 0.2, 0.4, 1}, {1, 1, 0.7, 0.2}}}};
  for (const char* estimator : {"approximative", "power_series", "engel_1d", "kye_1d", "preintegrated"}) {
    config["estimator"] = {{"type", estimator}};
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage both = render(config, GetParam()).image;
      for (const char* other : {"published", "off"}) {
        config["estimator"]["opaque_prediction"] = other;
        EXPECT_EQ(differing_values(both, render(config, GetParam()).image), 0u) << estimator << " " << other;
      }
    })
  }
}

// With the prediction off an opaque range is a medium of the given extinction.
TEST_P(OpaquePredictions, OffTakesTheMaximumExtinction) {
  json config = ray_config(ramp_field(0, 1, 1), 1, 0.25);
  config["optical_model"] = {{"type", "absorption_emission"},
                             {"opacity", {{0, 0}, {0.25, 0}, {0.25, 1}, {0.5, 1}, {0.5, 0}}},
                             {"color", {{0, 0.5, 1, 0.25}}},
                             {"tf_range", {0, 1}},
                             {"tf_entries", 4097}};
  for (const char* estimator : {"approximative", "power_series", "preintegrated"}) {
    config["estimator"] = {{"type", estimator}, {"opaque_prediction", "off"}, {"max_extinction", 6}};
    if (estimator == std::string("preintegrated")) config["estimator"]["table_size"] = 1025;
    SKIP_WHEN_NOT_SUPPORTED({
      const FrameImage r = render(config, GetParam()).image;
      const double T = std::exp(-6 * 0.25), color[3] = {0.5, 1, 0.25};
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(r.trans[c], T, 1e-5) << estimator;
        EXPECT_NEAR(r.color[c], color[c] * (1 - T), 1e-5) << estimator;
      }
    })
  }
}

INSTANTIATE_TEST_SUITE_P(Targets, OpaquePredictions, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
