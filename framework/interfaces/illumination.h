// Illumination passes. In this version they fill the parameters of local shading; passes that fill light volumes
// are lists of stages (docs/adr/0001).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/interfaces/parameter_set.h"
#include "framework/interfaces/plugin.h"

namespace dvrlab {

/// A light of the config's `lights`, in world coordinates relative to the box centre.
struct Light {
  enum class Type { head, directional, point };
  Type type = Type::head;
  Vector3 position{0, 0, 0};  // point: position; directional: unit vector towards the light
  Vector3 color{1, 1, 1};
};

/// What the local shading kernel evaluates: (m, k, b) at a point. Colours per channel.
struct LocalShading {
  enum class Mode { none, blinn_phong, prescribed };
  Mode mode = Mode::none;
  double ambient = 1, diffuse = 0, specular = 0;
  int shininess = 1;  // whole number: the power is taken by repeated squaring
  bool two_sided = true;
  double gradient_eps = 0;  // physical value per world length; below it k = ambient + diffuse, b = 0
  /// Gradient magnitudes (physical value per world length, the first below the second) between which light factors go
  /// from unlit (k = 1, b = 0) to lit: the surface scalar of Kniss et al. 2002. Nothing: lit everywhere.
  std::optional<std::array<double, 2>> surface_scalar;
  std::vector<Light> light;  // at most 4
  /// prescribed: values at the two ends of the ray, linear in arc length between
  std::array<Vector3, 2> m{}, k{}, b{};
};

class IlluminationPlugin : public Plugin {
 public:
  /// Bytes that the pass will allocate at the most. Passes of local shading hold nothing.
  virtual std::uint64_t bytes_needed(const ParameterSet& /*parameters*/) const { return 0; }
  /// Fills `shading`, which holds the lights already.
  virtual void shade(const ParameterSet& parameters, LocalShading& shading) const = 0;
};

}  // namespace dvrlab
