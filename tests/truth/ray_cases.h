// Configs of rays whose integral is known, for the truth tests.
#pragma once

#include <string>

#include "tests/support/reference.h"
#include "tests/support/render.h"

namespace dvrlab::test {

using nlohmann::json;

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

/// What the golden case expects.
inline RayIntegral expected(const json& golden_case) {
  RayIntegral r;
  for (std::size_t c = 0; c < 3; ++c) {
    r.I[c] = std::stod(golden_case.at("expect").at("I")[c].get<std::string>());
    r.T[c] = std::stod(golden_case.at("expect").at("T")[c].get<std::string>());
  }
  return r;
}

/// nullptr where there is no golden data.
inline const json* golden_case(const std::string& id) {
  if (golden().is_null()) return nullptr;
  for (const json& c : golden().at("cases"))
    if (c.at("id") == id) return &c;
  return nullptr;
}

/// The golden case levoy_sphere in `n` segments: shaded, a radial field, a headlight.
inline json levoy_sphere(const json& g, int n) {
  const json &ray = g.at("ray"), &shade = g.at("shade"), &params = g.at("params");
  const double D = ray.at("D");
  json config = ray_config({{"field", "radial"},
                            {"center", {ray.at("lc"), ray.at("p"), 0}},
                            {"scale", ray.at("scale")},
                            {"offset", ray.at("offset")}},
                           D, D / n);
  config["optical_model"] = {{"type", "absorption_emission"},
                             {"tf", "nodes"},
                             {"shaded", true},
                             {"opacity", params.at("alpha")},
                             {"color", params.at("color")},
                             {"dl_std", params.at("dl_std")}};
  config["lights"] = {{{"type", "head"}}};
  config["illumination"] = {{{"type", "blinn_phong"},
                             {"ambient", shade.at("ka")},
                             {"diffuse", shade.at("kd")},
                             {"specular", shade.at("ks")},
                             {"shininess", shade.at("n")}}};
  config["image"]["background"] = g.at("background");
  return config;
}

}  // namespace dvrlab::test
