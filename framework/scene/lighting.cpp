#include "framework/scene/lighting.h"

#include <algorithm>

#include "framework/interfaces/transfer_function.h"
#include "framework/scene/buffers.h"
#include "framework/scene/camera.h"
#include "framework/scene/vector.h"

namespace dvrlab {

LocalShading local_shading(const ResolvedCase& c, const Registry& registry, const Field& field, bool linear) {
  const Frame frame(field);
  LocalShading shading;
  for (const Section& s : c.lights) {
    const ParameterSet& p = s.parameters;
    Light light;
    light.color = p.vector3("color");
    if (linear) std::transform(light.color.begin(), light.color.end(), light.color.begin(), display_to_linear);
    if (s.type == "directional") {
      light.type = Light::Type::directional;
      light.position = unit_vector(p.vector3("direction"), p.path_of("direction") + ": is 0; give a direction");
    } else if (s.type == "point") {
      light.type = Light::Type::point;
      light.position = frame.point(p, "position");
    }
    shading.light.push_back(light);
  }
  for (const Section& s : c.illumination)
    registry.get<IlluminationPlugin>("illumination", s.type).shade(s.parameters, shading);
  return shading;
}

void add_shading(const LocalShading& s, double value_per_stored, KernelUnit& unit) {
  const double eps = s.gradient_eps / value_per_stored;
  const auto vec = [](const char* name, const Vector3& v) { return Uniform::vector(name, v[0], v[1], v[2]); };
  unit.uniforms.insert(
      unit.uniforms.end(),
      {Uniform::constant_integer("frame_shading", int(s.mode)), Uniform::real("frame_ambient", s.ambient),
       Uniform::real("frame_diffuse", s.diffuse), Uniform::real("frame_specular", s.specular),
       Uniform::constant_integer("frame_shininess", s.shininess),
       Uniform::constant_integer("frame_two_sided", s.two_sided ? 1 : 0),
       // Not below what fp32 can hold: a zero gradient has no normal either way.
       Uniform::real("frame_gradient_eps2", std::max(eps * eps, 1e-36)),
       Uniform::constant_integer("frame_lights", int(s.light.size())), vec("frame_m0", s.m[0]), vec("frame_m1", s.m[1]),
       vec("frame_k0", s.k[0]), vec("frame_k1", s.k[1]), vec("frame_b0", s.b[0]), vec("frame_b1", s.b[1])});
  std::vector<float> lights;
  for (const Light& l : s.light) {
    for (double x : l.position) lights.push_back(float(x));
    lights.push_back(float(int(l.type)));
    for (double x : l.color) lights.push_back(float(x));
    lights.push_back(0.0f);
  }
  unit.buffers.push_back(vec4_buffer("frame_light", std::move(lights)));
}

}  // namespace dvrlab
