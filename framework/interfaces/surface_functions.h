// The transfer functions of surface elements (Yang et al. 2012, sections 3 and 5): what the models hybrid and
// data_space read from their section `surface` and `dv_std`.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "framework/interfaces/transfer_function.h"

namespace dvrlab {

/// Keys that a model with surface elements declares.
inline constexpr Parameter surface_opacity_key{"surface.opacity",
                                               ParameterType::nodes,
                                               "per dv_std",
                                               "null",
                                               "1|3",
                                               "Opacity nodes of the isosurfaces within a difference dv_std of values.",
                                               Affects::pixels,
                                               "",
                                               "[[0,0.1],[1,0.6]]"};
inline constexpr Parameter surface_color_key{"surface.color",
                                             ParameterType::nodes,
                                             "",
                                             "null",
                                             "3",
                                             "Colour nodes of the isosurfaces.",
                                             Affects::pixels,
                                             "",
                                             "[[0,0.9,0.1,0.3],[1,0.1,0.8,0.6]]"};
inline constexpr Parameter surface_delta_key{
    "surface.delta",
    ParameterType::json,
    "",
    "[]",
    "a list of {\"value\": v, \"opacity\": a in [0, 1], \"color\": [r, g, b] (optional)}",
    "Discrete isosurfaces (Dirac terms), each of opacity a; without a colour of its own it has that of the colour "
    "nodes.",
    Affects::pixels,
    R"({"estimator":{"type":"exact"},"optical_model":{"tf":"nodes"}})",
    R"([{"value":0.55,"opacity":0.4,"color":[1,0.2,0.7]}])",
    "",
    R"({"type":"array","items":{"type":"object","properties":{"value":{"type":"number"},"opacity":{"type":"number","minimum":0,"maximum":1},"color":{"type":"array","items":{"type":"number"},"minItems":3,"maxItems":3}},"required":["value","opacity"],"additionalProperties":false}})"};
inline constexpr Parameter dv_std_key{"dv_std",
                                      ParameterType::number,
                                      "value",
                                      "1",
                                      "(0,inf)",
                                      "Difference of values that the surface opacity refers to, in the unit of the "
                                      "transfer functions.",
                                      Affects::pixels,
                                      "",
                                      "0.3"};

/// The surface elements of a model: tau_s, S_s, W_s, Dirac terms and opaque ranges.
class SurfaceFunctions {
 public:
  /// Reads the keys above. `shared_color` (null: white) colours what has no colour nodes of its own.
  SurfaceFunctions(const ParameterSet& p, const Curve* shared_color, const ModelContext& context);
  /// What is wrong with surface.delta, as an InputError that begins with its path: for Plugin::check.
  static void check(const ParameterSet& p);

  std::vector<const Curve*> curves() const { return {&extinction_.curve, &color_}; }
  void add_to(MediumBuilder& builder) const;

 private:
  struct Delta {
    double value, opacity;
    Vector3 color;
  };
  Extinction extinction_;
  Curve color_;
  std::vector<Delta> delta_;
  bool cap_;
};

}  // namespace dvrlab
