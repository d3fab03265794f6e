// Orbit views are cameras that could be written by hand, and lights may stand in the camera's axes.
#include "framework/scene/camera.h"

#include <cmath>
#include <cstdio>

#include "framework/config/experiment.h"
#include "framework/scene/lighting.h"
#include "framework/scene/orbit.h"
#include "framework/scene/vector.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;
const Target& scalar = targets()[0];

json scene_config(const json& camera, const json& lights = {{{"type", "head"}}}) {
  return {{"data", {{"type", "procedural"}, {"field", "marschner_lobb"}, {"size", {16, 18, 14}}}},
          {"optical_model",
           {{"type", "absorption_emission"}, {"extinction", {{0, 0}, {0.5, 1}, {1, 8}}}, {"shaded", true}}},
          {"estimator", {{"type", "direct"}}},
          {"lights", lights},
          {"illumination", {{{"type", "blinn_phong"}, {"ambient", 0.1}, {"diffuse", 0.6}, {"specular", 0.3}}}},
          {"camera", camera},
          {"image", {{"size", {24, 20}}}}};
}

json orbit(const json& keys) {
  json c = {{"type", "orbit"}};
  c.update(keys);
  return c;
}

ParameterSet camera_of(const json& camera) {
  const Experiment e = plan_experiment(parse_document(scene_config(camera).dump(), "test.json", "."), registry());
  return e.cases.front().resolved.camera.parameters;
}

void expect_near(const Vector3& a, const Vector3& b, double bound) {
  EXPECT_LE(length(minus(a, b)), bound) << testing::PrintToString(a) << " and " << testing::PrintToString(b);
}

// Quarter turns about z from the direction of x, seen from above against the clock.
TEST(Orbit, CircleStandsWhereItsAnglesSay) {
  const Vector3 quarters[] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  for (int view = 0; view < 4; ++view) {
    const json keys = {{"views", 4}, {"view", view}, {"elevation_deg", 0}};
    expect_near(orbit_direction(camera_of(orbit(keys))), quarters[view], 1e-15);
  }
  const double h = std::sqrt(0.5);
  const json up = {{"view", 0}, {"elevation_deg", 45}, {"start_deg", 90}};
  expect_near(orbit_direction(camera_of(orbit(up))), {0, h, h}, 1e-15);
  const json about_x = {{"view", 0}, {"elevation_deg", 0}, {"axis", {2, 0, 0}}};
  expect_near(orbit_direction(camera_of(orbit(about_x))), {0, 1, 0}, 1e-15);
}

// Each of n views owns 4 pi / n of the sphere: the mean direction is 0 up to that, and the nearest neighbours are
// about as far apart as in the densest packing, sqrt(8 pi / (sqrt(3) n)); a Fibonacci lattice has at least 3/4 of it.
TEST(Orbit, SphereIsCoveredEvenly) {
  const int n = 100;
  std::vector<Vector3> views;
  Vector3 sum{0, 0, 0};
  for (int view = 0; view < n; ++view) {
    const json keys = {{"path", "sphere"}, {"views", n}, {"view", view}};
    views.push_back(orbit_direction(camera_of(orbit(keys))));
    EXPECT_NEAR(length(views.back()), 1.0, 1e-14);
    EXPECT_LT(std::abs(views.back()[2]), 1.0) << "no view looks along the axis";
    sum = plus(sum, views.back());
  }
  double nearest = 4;
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) nearest = std::min(nearest, length(minus(views[i], views[k])));
  const double densest = std::sqrt(8 * M_PI / (std::sqrt(3.0) * n));
  std::printf("nearest views %.3f apart, densest packing %.3f, mean direction %.2g\n", nearest, densest,
              length(sum) / n);
  EXPECT_GT(nearest, 0.75 * densest);
  EXPECT_LT(length(sum) / n, 1.0 / n);
}

json by_hand(const json& orbit_keys, const std::string& type) {
  const ParameterSet p = camera_of(orbit(orbit_keys));
  const Vector3 target = p.vector3("target"), position = plus(target, times(orbit_direction(p), p.number("distance")));
  return {{"type", type}, {"position", position}, {"target", target}, {"up", p.vector3("axis")}};
}

TEST(Orbit, ViewIsTheCameraWrittenByHand) {
  for (const std::string projection : {"perspective", "orthographic"}) {
    const json keys = {{"projection", projection}, {"views", 7},     {"view", 3}, {"target", {0.1, -0.2, 0.05}},
                       {"axis", {0.2, 0.1, 1}},    {"distance", 2.5}};
    json next = keys;
    next["view"] = 4;
    const FrameImage a = render(scene_config(orbit(keys)), scalar).image;
    // In the frame "data" both multiply the same numbers by the half diagonal, in another order: one rounding in fp64,
    // far below what the uniforms in fp32 can hold.
    EXPECT_LT(largest_difference(a, render(scene_config(by_hand(keys, projection)), scalar).image), 1e-5) << projection;
    EXPECT_GT(largest_difference(a, render(scene_config(orbit(next)), scalar).image), 0.01) << "negative control";
  }
}

/// The image of an oblique orthographic camera, lit from `lights`.
FrameImage lit(const json& lights, const json& position) {
  return render(scene_config({{"type", "orthographic"}, {"position", position}, {"up", {0, 1, 0.2}}}, lights), scalar)
      .image;
}

json directional(const json& direction, const std::string& frame = "camera") {
  return {{{"type", "directional"}, {"frame", frame}, {"direction", direction}}};
}

// Parallel rays: the direction back to the eye is that of a head light. Along an axis both are exact. Else the kernel
// scales the head light's direction to length 1 twice: rsqrt is good to 2 ulp, so L differs by at most 2 ulp and three
// roundings, 5 * 2^-23 = 6e-7. Light changes k by at most (diffuse + shininess * specular) of that and the
// radiance by no more than k, colours being at most 1.
TEST(CameraFrame, DirectionBackToTheEyeIsAHeadLight) {
  const json head = {{{"type", "head"}}};
  EXPECT_EQ(differing_values(lit(directional({0, 0, 1}), {0, 0, 3}), lit(head, {0, 0, 3})), 0u);
  const FrameImage oblique = lit(head, {1.2, -2.0, 0.9});
  const double difference = largest_difference(lit(directional({0, 0, 1}), {1.2, -2.0, 0.9}), oblique);
  const int shininess = 20;  // the default
  std::printf("camera-frame light against head light: at most %.2g\n", difference);
  EXPECT_LE(difference, (0.6 + shininess * 0.3) * 6e-7);
  EXPECT_GT(largest_difference(lit(directional({1, 0, 0}), {1.2, -2.0, 0.9}), oblique), 0.01) << "from the right";
  EXPECT_GT(largest_difference(lit(directional({0, 0, 1}, "world"), {1.2, -2.0, 0.9}), oblique), 0.01) << "from above";
}

LocalShading shading_of(const json& config) {
  const Experiment e = plan_experiment(parse_document(config.dump(), "test.json", "."), registry());
  const ResolvedCase& c = e.cases.front().resolved;
  FormulaField box;
  box.lo = {-3, -4, 0};
  box.hi = {3, 4, 24};  // half the diagonal is 13
  return local_shading(c, registry(), box, false);
}

// An eye on the x axis that looks at the origin with z up has y on its right.
TEST(CameraFrame, AxesAreRightUpAndTowardsTheEye) {
  const json camera = {{"type", "perspective"}, {"position", {3, 0, 0}}, {"up", {0, 0, 1}}};
  expect_near(shading_of(scene_config(camera, directional({1, 0, 0}))).light[0].position, {0, 1, 0}, 1e-15);
  expect_near(shading_of(scene_config(camera, directional({0, 2, 0}))).light[0].position, {0, 0, 1}, 1e-15);
  expect_near(shading_of(scene_config(camera, directional({0, 0, 5}))).light[0].position, {1, 0, 0}, 1e-15);
}

// The unit is that of the camera's frame, the origin is the eye.
TEST(CameraFrame, PointLightMovesWithTheEye) {
  const auto point = [](const json& camera, const json& position) {
    const json light = {{{"type", "point"}, {"frame", "camera"}, {"position", position}}};
    return shading_of(scene_config(camera, light)).light[0].position;
  };
  json camera = {{"type", "perspective"}, {"frame", "data"}, {"position", {3, 0, 0}}, {"up", {0, 0, 1}}};
  expect_near(point(camera, {0, 0, 0}), {39, 0, 0}, 1e-13);
  expect_near(point(camera, {1, 2, -1}), {26, 13, 26}, 1e-13);
  camera["frame"] = "world";  // the box's centre is (0, 0, 12); places are relative to it
  camera["target"] = {0, 0, 0};
  expect_near(point(camera, {1, 2, -1}), {2, 1, -10}, 1e-13);
}

TEST(CameraFrame, LightTurnsWithTheViewsOfAnOrbit) {
  for (int view = 0; view < 4; ++view) {
    const json keys = {{"views", 4}, {"view", view}, {"elevation_deg", 0}};
    const Vector3 eye = orbit_direction(camera_of(orbit(keys)));
    expect_near(shading_of(scene_config(orbit(keys), directional({0, 0, 1}))).light[0].position, eye, 1e-14);
    expect_near(shading_of(scene_config(orbit(keys), directional({1, 0, 0}))).light[0].position, cross({0, 0, 1}, eye),
                1e-14);
  }
}

TEST(CameraFrame, NeedsACameraWithAxes) {
  const json ray = {{"type", "ray"}, {"origin", {0, 0, 3}}, {"direction", {0, 0, -1}}};
  std::string refused;
  try {
    shading_of(scene_config(ray, directional({0, 0, 1})));
  } catch (const InputError& e) {
    refused = e.what();
  }
  EXPECT_NE(refused.find("test.json:1:"), std::string::npos) << refused;
  EXPECT_NE(refused.find("lights[0].frame: a ray camera has no right and up"), std::string::npos) << refused;
  EXPECT_EQ(refused.find('\n'), std::string::npos) << "one line";
  EXPECT_NO_THROW(shading_of(scene_config(ray, directional({0, 0, 1}, "world"))));
}

}  // namespace
}  // namespace dvrlab::test
