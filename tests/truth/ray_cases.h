// Configs of rays whose integral is known, for the truth tests.
#pragma once

#include <string>

#include "tests/truth/truth_test.h"

namespace dvrlab::test {

/// A ray along x through a formula field, with exact transfer function nodes: the only error is the estimator's.
inline json ray_config(const json& field, double length, double step) {
  json data = {{"type", "procedural"}, {"evaluate", "formula"}, {"bounds", {{-8, -8, -8}, {8, 8, 8}}}};
  data.update(field);
  return {{"data", data},
          {"estimator", {{"type", "direct"}}},
          {"camera",
           {{"type", "ray"}, {"frame", "world"}, {"origin", {0, 0, 0}}, {"direction", {1, 0, 0}}, {"t", {0, length}}}},
          {"sampling", {{"type", "uniform"}, {"step", step}, {"unit", "world"}, {"termination", 0}}},
          {"image", {{"size", {1, 1}}}}};
}

inline json ramp_field(double v0, double v1, double length) {
  return {{"field", "ramp"}, {"direction", {1, 0, 0}}, {"offset", v0}, {"scale", (v1 - v0) / length}};
}

inline json model(const json& extinction, const json& color) {
  return {{"type", "absorption_emission"}, {"tf", "nodes"}, {"extinction", extinction}, {"color", color}};
}

/// The golden case in `n` segments, by `direct`.
inline json direct_config(const json& golden_case, int n) {
  json config = golden_config(golden_case, n);
  config["estimator"] = {{"type", "direct"}};
  return config;
}

}  // namespace dvrlab::test
