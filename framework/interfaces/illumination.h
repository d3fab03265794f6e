// Illumination passes: they fill the parameters of local shading, or plan the stages that fill a light volume.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "framework/interfaces/field.h"
#include "framework/interfaces/light_stage.h"
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
  bool light_volume = false;  // a pass fills one: its value is a factor of m, k and b
};

/// The case's camera, and what it sees of the medium: for a pass that finds the image itself.
struct ImageSetting {
  KernelUnit rays;  // frame_* of framework/kernel/ray.kernel
  /// Per entry of light_tau, per world length: the source that is lit and the extinction (r, g, b, tau); the source
  /// that sends by itself (r, g, b, 0).
  std::vector<double> lit, emitted;
  Vector3 background{0, 0, 0};
  bool glows_without_extinction = false;
};

/// What a pass of light volumes is told beside its own parameters.
struct LightSetting {
  std::array<int, 3> dims;               // of the light volume: the grid of the data, where they have one
  const BlockedField* blocks = nullptr;  // whose samples the light volume has instead
  Affine to_world;                       // sampler coordinates -> world relative to the box centre
  double voxel;                          // smallest spacing of that grid, world units
  double box_diagonal;                   // no way to a light is longer in the box
  std::vector<Light> light;              // directional and point lights; at least one
  bool rgb;                   // extinction differs between channels: one light per volume, a channel per colour
  double value_lo, value_hi;  // values of the first and the last entry of light_tau, in the transfer functions' unit
  int entries;                // of light_tau
  Vector3 largest_tau;        // per channel and world length
  bool surfaces;              // some extinction has no length: surfaces, Dirac terms, opaque ranges
  std::uint32_t seed;         // of the case
  bool local_shading;         // a pass of local shading stands beside
  std::array<int, 2> image_size;                  // rays
  std::function<ImageSetting()> image = nullptr;  // made for who asks

  /// Sampler coordinates per world length of a unit direction in the world.
  Vector3 sampler_direction(const Vector3& world) const;
  /// Lights whose depths one stage finds at once.
  int lights_per_volume() const { return rgb ? 1 : 4; }
  int channels_from(int first_light) const;
  /// The points of the light volume, and of what stages find for each of them.
  LightGrid points(int channels) const { return light_points(dims, blocks, channels); }
};

class IlluminationPlugin : public Plugin {
 public:
  /// Fills `shading`, which holds the lights already. A pass of light volumes leaves it alone.
  virtual void shade(const ParameterSet& /*parameters*/, LocalShading& /*shading*/) const {}
  /// True for a pass that fills a light volume: then plan() is called.
  virtual bool fills_light_volume() const { return false; }
  /// The light volume's grid for data that has none of its own: points along the longest side of the box.
  virtual int resolution(const ParameterSet& /*parameters*/) const { return 128; }
  /// The stages that fill the light volume. Throws InputError naming the key for what cannot be.
  virtual LightPlan plan(const ParameterSet& /*parameters*/, const LightSetting& /*setting*/) const { return {}; }
};

}  // namespace dvrlab
