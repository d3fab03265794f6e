#include "framework/scene/camera.h"

#include <cmath>

#include "framework/scene/buffers.h"
#include "framework/scene/orbit.h"
#include "framework/scene/vector.h"

namespace dvrlab {

Frame::Frame(const Field& field) {
  const Vector3 middle = times(plus(field.lo, field.hi), 0.5);
  centre_ = field.to_world.point(middle);
  half_diagonal_ = 0.5 * length(field.to_world.vector(minus(field.hi, field.lo)));
}

double Frame::unit(const ParameterSet& s) const { return s.text("frame") == "data" ? half_diagonal_ : 1.0; }

Vector3 Frame::point(const ParameterSet& s, const std::string& name) const {
  const Vector3 p = s.vector3(name);
  return s.text("frame") == "data" ? times(p, half_diagonal_) : minus(p, centre_);
}

namespace {

/// Ray of pixel (x, y): origin + x origin_x + y origin_y, likewise the direction. World, relative to the centre.
struct AffineRays {
  Vector3 origin{}, origin_x{}, origin_y{};
  Vector3 direction{}, direction_x{}, direction_y{};
  double t0 = 0, t1 = 1e30;
};

Eye looking(const ParameterSet& p, const Vector3& position, const Vector3& target, const char* up) {
  const Vector3 forward =
      unit_vector(minus(target, position), p.path_of("target") + ": equals camera.position; give another point");
  Eye e;
  e.position = position;
  e.back = times(forward, -1.0);
  e.right = unit_vector(cross(forward, p.vector3(up)),
                        p.path_of(up) + ": is 0 or parallel to the view direction; give another direction");
  e.up = cross(e.right, forward);
  return e;
}

AffineRays perspective(const ParameterSet& p, const Eye& eye, int width, int height) {
  AffineRays r;
  const double half = std::tan(p.number("fov_deg") * 3.14159265358979323846 / 360.0), aspect = double(width) / height;
  r.origin = eye.position;
  r.direction_x = times(eye.right, 2.0 * half * aspect / width);
  r.direction_y = times(eye.up, -2.0 * half / height);
  r.direction =
      minus(plus(times(eye.right, half * aspect * (1.0 / width - 1.0)), times(eye.up, half * (1.0 - 1.0 / height))),
            eye.back);
  return r;
}

AffineRays orthographic(const ParameterSet& p, const Eye& eye, const Frame& frame, int width, int height) {
  AffineRays r;
  const double half = 0.5 * p.number("height") * frame.unit(p), aspect = double(width) / height;
  r.direction = times(eye.back, -1.0);
  r.origin_x = times(eye.right, 2.0 * half * aspect / width);
  r.origin_y = times(eye.up, -2.0 * half / height);
  r.origin = plus(eye.position, plus(times(eye.right, half * aspect * (1.0 / width - 1.0)),
                                     times(eye.up, half * (1.0 - 1.0 / height))));
  return r;
}

AffineRays single_ray(const ParameterSet& p, const Frame& frame) {
  AffineRays r;
  r.origin = frame.point(p, "origin");
  r.direction = unit_vector(p.vector3("direction"), p.path_of("direction") + ": is 0; give a direction");
  const nlohmann::json& t = p.json("t");
  r.t0 = t[0].get<double>() * frame.unit(p);
  if (!t[1].is_null()) r.t1 = t[1].get<double>() * frame.unit(p);
  return r;
}

AffineRays rays_of(const Section& camera, const Frame& frame, int width, int height) {
  const ParameterSet& p = camera.parameters;
  if (camera.type == "ray") return single_ray(p, frame);
  const Eye eye = eye_of(camera, frame);
  const bool parallel =
      camera.type == "orthographic" || (camera.type == "orbit" && p.text("projection") == "orthographic");
  return parallel ? orthographic(p, eye, frame, width, height) : perspective(p, eye, width, height);
}

Uniform vec(const char* name, const Vector3& v) { return Uniform::vector(name, v[0], v[1], v[2]); }

}  // namespace

Eye eye_of(const Section& camera, const Frame& frame) {
  const ParameterSet& p = camera.parameters;
  if (camera.type == "ray")
    throw InputError(p.path_of("type") +
                     ": a ray camera has no axes of its own; use perspective, orthographic or orbit");
  const Vector3 target = frame.point(p, "target");
  if (camera.type != "orbit") return looking(p, frame.point(p, "position"), target, "up");
  const Vector3 position = plus(target, times(orbit_direction(p), p.number("distance") * frame.unit(p)));
  return looking(p, position, target, "axis");
}

void add_camera(const Section& camera, const Field& field, int width, int height, KernelUnit& unit) {
  const Frame frame(field);
  const AffineRays r = rays_of(camera, frame, width, height);
  const Affine to_grid = field.to_world.inverse();
  const auto& m = to_grid.m;
  unit.uniforms.insert(
      unit.uniforms.end(),
      {vec("frame_origin", to_grid.point(plus(r.origin, frame.centre()))),
       vec("frame_origin_x", to_grid.vector(r.origin_x)), vec("frame_origin_y", to_grid.vector(r.origin_y)),
       vec("frame_world_origin", r.origin), vec("frame_world_origin_x", r.origin_x),
       vec("frame_world_origin_y", r.origin_y), vec("frame_direction", r.direction),
       vec("frame_direction_x", r.direction_x), vec("frame_direction_y", r.direction_y),
       Uniform::vector("frame_to_grid_x", m[0], m[1], m[2]), Uniform::vector("frame_to_grid_y", m[3], m[4], m[5]),
       Uniform::vector("frame_to_grid_z", m[6], m[7], m[8]), Uniform::real("frame_t0", r.t0),
       Uniform::real("frame_t1", r.t1), vec("frame_lo", field.lo), vec("frame_hi", field.hi)});
}

void add_clipping(const std::vector<Section>& planes, const Field& field, KernelUnit& unit) {
  const Frame frame(field);
  std::vector<double> plane, lit;
  for (const Section& s : planes) {
    const ParameterSet& p = s.parameters;
    const Vector3 n = unit_vector(p.vector3("normal"), p.path_of("normal") + ": is 0; give a direction");
    // The offset is measured from the frame's origin; the kernel's coordinates start at the centre.
    const double origin = p.text("frame") == "data" ? 0.0 : dot(n, frame.centre());
    const double offset = p.number("offset") * frame.unit(p) - origin;
    plane.insert(plane.end(), {n[0], n[1], n[2], offset});
    if (p.text("clip_normal") != "plane") continue;
    lit.insert(lit.end(), {n[0], n[1], n[2], offset, 1.0 / (p.number("clip_depth") * field.voxel), 0, 0, 0});
  }
  unit.uniforms.push_back(Uniform::constant_integer("frame_planes", int(planes.size())));
  unit.buffers.push_back(vec4_buffer("frame_plane", std::move(plane)));
  unit.uniforms.push_back(Uniform::constant_integer("frame_clip_normals", int(lit.size() / 8)));
  unit.buffers.push_back(vec4_buffer("frame_clip_normal", std::move(lit)));
}

}  // namespace dvrlab
