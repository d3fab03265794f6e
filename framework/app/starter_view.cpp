#include "framework/app/starter_view.h"

#include <algorithm>
#include <cmath>

#include "framework/scene/vector.h"

namespace dvrlab {
namespace {

constexpr double margin = 0.92;  // part of the image's half height that the shape takes

using Points = std::vector<Vector3>;

struct Box {
  Vector3 lo{1e300, 1e300, 1e300}, hi{-1e300, -1e300, -1e300};
  explicit Box(const Points& points) {
    for (const Vector3& p : points) {
      for (std::size_t a = 0; a < 3; ++a) {
        lo[a] = std::min(lo[a], p[a]);
        hi[a] = std::max(hi[a], p[a]);
      }
    }
  }
};

/// Moves the target into the middle of the picture of `points` and the camera as near as the margin allows.
struct Fit {
  Vector3 towards, right, up, target;
  double tangent, distance = 0;

  void step_back(const Points& points) {
    distance = 0;
    for (const Vector3& point : points) {
      const Vector3 p = minus(point, target);
      const double across = std::max(std::fabs(dot(p, right)), std::fabs(dot(p, up)));
      distance = std::max(distance, across / tangent + dot(p, towards));
    }
  }
  void centre(const Points& points) {
    double lo[2] = {1e300, 1e300}, hi[2] = {-1e300, -1e300};
    for (const Vector3& point : points) {
      const Vector3 p = minus(point, target);
      const double depth = distance - dot(p, towards), at[2] = {dot(p, right) / depth, dot(p, up) / depth};
      for (int a = 0; a < 2; ++a) {
        lo[a] = std::min(lo[a], at[a]);
        hi[a] = std::max(hi[a], at[a]);
      }
    }
    target =
        plus(target, plus(times(right, 0.5 * (lo[0] + hi[0]) * distance), times(up, 0.5 * (lo[1] + hi[1]) * distance)));
  }
};

}  // namespace

StarterView starter_view(std::vector<Vector3> points, const Field& field) {
  StarterView view;
  const Vector3 middle = field.to_world.point(times(plus(field.lo, field.hi), 0.5));
  const double unit = 0.5 * length(field.to_world.vector(minus(field.hi, field.lo)));
  for (Vector3& p : points) p = times(minus(p, middle), 1.0 / unit);
  const Box box(points);
  const double degree = 3.14159265358979323846 / 180.0;
  const Vector3 towards = field.anatomical ? Vector3{-0.55, 0.8, 0.3} : Vector3{-0.5, -0.8, 0.45};
  Fit fit{};
  fit.towards = times(towards, 1.0 / length(towards));
  fit.right = cross({0, 0, 1}, fit.towards);
  fit.right = times(fit.right, 1.0 / length(fit.right));
  fit.up = cross(fit.towards, fit.right);
  fit.target = times(plus(box.lo, box.hi), 0.5);
  fit.tangent = std::tan(0.5 * view.fov_deg * degree) * margin;
  fit.step_back(points);
  for (int i = 0; i < 4; ++i) {  // perspective moves the middle a little each time
    fit.centre(points);
    fit.step_back(points);
  }
  view.target = fit.target;
  view.position = plus(fit.target, times(fit.towards, fit.distance));
  const Vector3 light = plus(fit.towards, plus(times(fit.up, 0.6), times(fit.right, -0.5)));
  view.towards_light = times(light, 1.0 / length(light));
  return view;
}

}  // namespace dvrlab
