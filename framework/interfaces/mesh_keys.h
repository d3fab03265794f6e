// Keys that data plugins of meshes share.
#pragma once

#include "framework/interfaces/mesh.h"
#include "framework/interfaces/parameter_set.h"

namespace dvrlab {

inline constexpr Parameter mesh_normals_key{
    "normals",
    ParameterType::choice,
    "",
    R"("vertex_inverse_distance")",
    "cell|vertex|vertex_inverse_distance",
    "What the normals of a mesh follow: the gradient of each cell; or those at the corners, the mean of the cells "
    "around, "
    "linear between, which may weigh a cell with the inverse of its centre's distance.",
    Affects::pixels,
    R"({"optical_model":{"shaded":true},"estimator":{"shading":"linear"},"illumination":[{"type":"blinn_phong"}]})",
    R"("cell")"};

inline constexpr Parameter mesh_array_key{"array",
                                          ParameterType::text,
                                          "",
                                          R"("")",
                                          "",
                                          "Name of the array; \"\": the one that the file names as active scalars, "
                                          "else the only one. Values of cells are averaged "
                                          "to their points.",
                                          Affects::pixels};

inline constexpr Parameter mesh_component_key{
    "component",
    ParameterType::text,
    "",
    R"("")",
    "",
    "Of an array of vectors: \"0\", \"1\", ... or \"norm\"; \"\": the array has one component.",
    Affects::pixels};

inline constexpr Parameter mesh_tolerance_key{
    "tolerance",
    ParameterType::number,
    "part of the value range",
    "0.001",
    "(0,1]",
    "Cells in which the scalar is not linear are passed in segments that differ from it by so much at the most.",
    Affects::pixels,
    "",
    "0.1"};

/// A shared key with what shows it in a reader's own example: `live_in` and `live_value` of Parameter.
constexpr Parameter seen_in(Parameter key, const char* live_in, const char* live_value) {
  key.live_in = live_in;
  key.live_value = live_value;
  return key;
}

inline MeshGradient mesh_gradient(const ParameterSet& p) {
  return static_cast<MeshGradient>(p.choice_index("normals"));
}

}  // namespace dvrlab
