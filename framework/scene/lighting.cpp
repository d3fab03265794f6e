#include "framework/scene/lighting.h"

#include <algorithm>
#include <optional>

#include "framework/interfaces/error.h"
#include "framework/interfaces/transfer_function.h"
#include "framework/scene/buffers.h"
#include "framework/scene/camera.h"
#include "framework/scene/vector.h"

namespace dvrlab {

namespace {

/// The direction or point of key `name` in the camera's axes: x right, y up, z towards the eye.
Vector3 along(const Eye& eye, const Vector3& v) {
  return plus(plus(times(eye.right, v[0]), times(eye.up, v[1])), times(eye.back, v[2]));
}

/// Where the light's own frame is the camera's: nothing for the other frames.
std::optional<Eye> eye_for(const Section& light, const Section& camera, const Frame& frame) {
  const ParameterSet& p = light.parameters;
  if (p.text("frame") != "camera") return std::nullopt;
  if (camera.type == "ray")
    throw InputError(p.path_of("frame") +
                     ": a ray camera has no right and up that \"camera\" could mean; use \"world\" or \"data\", or "
                     "another camera");
  return eye_of(camera, frame);
}

void place_light(const Section& s, const Section& camera, const Frame& frame, Light& light) {
  const ParameterSet& p = s.parameters;
  const std::optional<Eye> eye = eye_for(s, camera, frame);
  if (s.type == "directional") {
    const Vector3 direction = eye ? along(*eye, p.vector3("direction")) : p.vector3("direction");
    light.type = Light::Type::directional;
    light.position = unit_vector(direction, p.path_of("direction") + ": is 0; give a direction");
  } else {
    light.type = Light::Type::point;
    light.position = eye ? plus(eye->position, times(along(*eye, p.vector3("position")), frame.unit(camera.parameters)))
                         : frame.point(p, "position");
  }
}

}  // namespace

LocalShading local_shading(const ResolvedCase& c, const Registry& registry, const Field& field, bool linear) {
  const Frame frame(field);
  LocalShading shading;
  for (const Section& s : c.lights) {
    const ParameterSet& p = s.parameters;
    Light light;
    light.color = p.vector3("color");
    if (linear) std::transform(light.color.begin(), light.color.end(), light.color.begin(), display_to_linear);
    if (s.type != "head") place_light(s, c.camera, frame, light);
    shading.light.push_back(light);
  }
  for (const Section& s : c.illumination) {
    const auto& pass = registry.get<IlluminationPlugin>("illumination", s.type);
    pass.shade(s.parameters, shading);
    shading.light_volume = shading.light_volume || pass.fills_light_volume();
  }
  return shading;
}

void add_shading(const LocalShading& s, double value_per_stored, KernelUnit& unit) {
  const double eps = s.gradient_eps / value_per_stored;
  const auto [unlit, lit] = s.surface_scalar.value_or(std::array{0.0, 1.0});
  const auto vec = [](const char* name, const Vector3& v) { return Uniform::vector(name, v[0], v[1], v[2]); };
  unit.uniforms.insert(
      unit.uniforms.end(),
      {Uniform::constant_integer("frame_shading", int(s.mode)), Uniform::real("frame_ambient", s.ambient),
       Uniform::real("frame_diffuse", s.diffuse), Uniform::real("frame_specular", s.specular),
       Uniform::constant_integer("frame_shininess", s.shininess),
       Uniform::constant_integer("frame_two_sided", s.two_sided ? 1 : 0),
       // Not below what fp32 can hold: a zero gradient has no normal either way.
       Uniform::real("frame_gradient_eps2", std::max(eps * eps, 1e-36)),
       Uniform::constant_integer("frame_surface_scalar", s.surface_scalar ? 1 : 0),
       Uniform::real("frame_unlit_gradient", unlit / value_per_stored),
       Uniform::real("frame_lit_scale", value_per_stored / (lit - unlit)),
       Uniform::constant_integer("frame_lights", int(s.light.size())), vec("frame_m0", s.m[0]), vec("frame_m1", s.m[1]),
       vec("frame_k0", s.k[0]), vec("frame_k1", s.k[1]), vec("frame_b0", s.b[0]), vec("frame_b1", s.b[1])});
  std::vector<double> lights;
  for (const Light& l : s.light) {
    lights.insert(lights.end(), l.position.begin(), l.position.end());
    lights.push_back(int(l.type));
    lights.insert(lights.end(), l.color.begin(), l.color.end());
    lights.push_back(0.0);
  }
  unit.buffers.push_back(vec4_buffer("frame_light", std::move(lights)));
}

}  // namespace dvrlab
