#include "tests/agreement/one_scan.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace dvrlab::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const Target cpu{"cpu", {{"type", "cpu"}}};
constexpr double unit_roundoff = 0x1p-24;  // of fp32
constexpr double camera_distance = 1.85;   // from the centre, in half diagonals

const GridField& grid_of(const Scene& scene) { return dynamic_cast<const GridField&>(*scene.field); }

}  // namespace

View view_of(const json& data, double opacity, bool shaded) {
  json any = {{"data", data},
              {"optical_model", {{"type", "absorption_emission"}, {"opacity", {{0, 0}}}, {"color", {{0, 1, 1, 1}}}}},
              {"estimator", {{"type", "direct"}}},
              {"camera", {{"type", "perspective"}, {"position", {2, 0, 0}}}},
              {"image", {{"size", {8, 8}}}}};
  const Scene scene = scene_of(any);
  const GridField& g = grid_of(scene);
  const double a = g.slope * g.stored_min + g.intercept, b = g.slope * g.stored_max + g.intercept;
  const Vector3 middle{0.5 * g.hi[0], 0.5 * g.hi[1], 0.5 * g.hi[2]};
  const Vector3 centre = g.to_world.point(middle), half = g.to_world.vector(middle);
  const double radius = std::hypot(half[0], half[1], half[2]);
  View v{any, 0.5, opacity, shaded};
  v.config.erase("data");
  v.config["optical_model"] = {{"type", "absorption_emission"},
                               {"length_unit", "world"},
                               {"dl_std", g.voxel},
                               {"opacity", {{a, 0}, {b, opacity}}},
                               {"color", {{a, 0.1, 0.2, 0.9}, {b, 1, 0.7, 0.1}}},
                               {"shaded", shaded}};
  if (shaded) {
    v.config["illumination"] = {{{"type", "blinn_phong"}, {"ambient", 0.2}, {"diffuse", 0.8}, {"specular", 0}}};
    v.config["lights"] = {{{"type", "directional"}, {"frame", "world"}, {"direction", {1, -0.5, 0.8}}}};
  }
  v.config["camera"] = {{"type", "perspective"},
                        {"frame", "world"},
                        {"position", {centre[0] + 1.1 * radius, centre[1] + 1.3 * radius, centre[2] + 0.7 * radius}},
                        {"target", centre},
                        {"up", {0, 0, 1}},
                        {"fov_deg", 50}};
  v.config["sampling"] = {
      {"type", "uniform"}, {"step", v.step * g.voxel}, {"unit", "world"}, {"termination", 0}, {"skipping", false}};
  v.config["image"] = {{"size", {96, 80}}};
  return v;
}

FrameImage picture(const View& view, const json& data) {
  json config = view.config;
  config["data"] = data;
  return render(config, cpu).image;
}

namespace {

double distance(const Vector3& x, const Vector3& y) { return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]); }

/// Of the box, in the world.
std::vector<Vector3> corners(const GridField& g) {
  std::vector<Vector3> all;
  for (int n = 0; n < 8; ++n)
    all.push_back(g.to_world.point({n & 1 ? g.hi[0] : 0, n & 2 ? g.hi[1] : 0, n & 4 ? g.hi[2] : 0}));
  return all;
}

/// How far two grids place the box's corners from each other, in world units: files round their affines.
double affine_difference(const GridField& a, const GridField& b) {
  double worst = 0;
  for (const Vector3& x : corners(a)) {
    double nearest = 1e300;
    for (const Vector3& y : corners(b)) nearest = std::min(nearest, distance(x, y));
    worst = std::max(worst, nearest);
  }
  return worst;
}

/// Differences of neighbouring voxels: the largest first one along any axis, the largest difference of neighbouring
/// central differences, and the smallest central difference along the axis where that is largest.
struct Steepness {
  double first = 0, second = 0, least = 0;
};

Steepness steepness_of(const GridField& g) {
  Steepness s;
  const auto value = [&](const std::array<int, 3>& x) { return g.slope * g.at(x[0], x[1], x[2]); };
  const auto central = [&](std::array<int, 3> x, std::size_t c) {
    std::array<int, 3> a = x, b = x;
    a[c] = std::max(0, x[c] - 1);
    b[c] = std::min(g.dims[c] - 1, x[c] + 1);
    return (value(b) - value(a)) / (b[c] - a[c]);
  };
  std::array<double, 3> least{1e300, 1e300, 1e300};
  for (std::array<int, 3> x{}; x[2] < g.dims[2]; ++x[2])
    for (x[1] = 0; x[1] < g.dims[1]; ++x[1])
      for (x[0] = 0; x[0] < g.dims[0]; ++x[0])
        for (std::size_t c = 0; c < 3; ++c) {
          least[c] = std::min(least[c], std::fabs(central(x, c)));
          for (std::size_t d = 0; d < 3; ++d) {
            std::array<int, 3> y = x;
            if (++y[d] >= g.dims[d]) continue;
            if (c == d) s.first = std::max(s.first, std::fabs(value(y) - value(x)));
            s.second = std::max(s.second, std::fabs(central(y, c) - central(x, c)));
          }
        }
  s.least = *std::max_element(least.begin(), least.end());
  return s;
}

}  // namespace

// The bound. A coordinate of a sample is o + t d in fp32, o rounded, d from three products, t from an integer times
// the step: at most 8 roundings of numbers up to R voxels, the way from the camera to the far end of the box, in each
// of the two pictures. It moves the sample by `shift` per axis, so the value by dv <= 3 shift * steepest + 8 roundings
// of the interpolation. With an extinction of slope s_m per voxel, a colour of slope s_c and the length L of the ray
// in voxels the radiance int c m T dl changes by at most (s_c + 2 s_m L) dv, as c <= 1 and int m T dl <= 1; the
// transmittance by less. A rounded number of steps adds or drops a piece of 1/1024 step; each of N steps composites
// with 4 roundings. Shading (diffuse 0.8) adds the turn of the normal: the change of the gradient over its length, in
// the world longer by at most `ratio`, the condition of the affine.
double bound_of(const View& view, const GridField& a, const GridField& b) {
  const Steepness steep = steepness_of(a);
  const Affine inverse = a.to_world.inverse();
  double diagonal = 0, column = 0, row = 0;
  for (const Vector3& x : corners(a))
    for (const Vector3& y : corners(a)) diagonal = std::max(diagonal, distance(x, y));
  for (std::size_t c = 0; c < 3; ++c) {
    column = std::max(column, std::hypot(a.to_world.m[c], a.to_world.m[3 + c], a.to_world.m[6 + c]));
    row = std::max(row, std::hypot(inverse.m[3 * c], inverse.m[3 * c + 1], inverse.m[3 * c + 2]));
  }
  const double L = diagonal / a.voxel, ratio = 3 * column * row;
  const double R = (0.5 * camera_distance + 1) * diagonal * row;
  const double range = a.slope * (a.stored_max - a.stored_min);
  const double shift = 2 * 8 * unit_roundoff * R + affine_difference(a, b) * row;
  const double dv = 3 * shift * steep.first + 2 * 8 * unit_roundoff * range;
  const double extinction = -std::log(1 - view.opacity), s_m = extinction / range, s_c = 0.9 / range;
  double bound = (s_c + 2 * s_m * L) * dv + extinction * view.step / 1024 + 4 * unit_roundoff * L / view.step;
  if (view.shaded)
    bound += 0.8 * 2 * ratio * (9 * shift * steep.second + 16 * unit_roundoff * steep.first) / steep.least;
  return bound;
}

std::string scratch(const std::string& name) {
  static const struct Folder {
    fs::path path = fs::temp_directory_path() / ("dvrlab_orientation_" + std::to_string(::getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() {
      std::error_code ignored;
      fs::remove_all(path, ignored);
    }
  } folder;
  return (folder.path / name).string();
}

json reordered(const GridField& g, const std::array<int, 3>& order, bool turned) {
  static constexpr const char* types[] = {"uint8", "int8", "uint16", "int16", "float"};
  std::array<std::size_t, 3> axis;
  Vector3 origin{};
  for (std::size_t c = 0; c < 3; ++c) {
    axis[c] = static_cast<std::size_t>(std::abs(order[c]) - 1);
    if (order[c] < 0 && turned) origin[axis[c]] = g.hi[axis[c]];
  }
  static int count = 0;  // every file has a name of its own: the scene keeps fields by name
  const std::string file = scratch("order_" + std::to_string(++count) + ".nrrd");
  std::ofstream out(file, std::ios::binary);
  out.precision(17);
  out << "NRRD0004\ntype: " << types[static_cast<int>(g.type)] << "\ndimension: 3\nsizes: " << g.dims[axis[0]] << ' '
      << g.dims[axis[1]] << ' ' << g.dims[axis[2]] << "\nspace: right-anterior-superior\nspace directions:";
  for (std::size_t c = 0; c < 3; ++c) {
    const double sign = order[c] < 0 && turned ? -1 : 1;
    const auto& m = g.to_world.m;
    out << " (" << sign * m[axis[c]] << ',' << sign * m[3 + axis[c]] << ',' << sign * m[6 + axis[c]] << ')';
  }
  const Vector3 first = g.to_world.point(origin);
  out << "\nspace origin: (" << first[0] << ',' << first[1] << ',' << first[2]
      << ")\nencoding: raw\nendian: little\n\n";
  const std::size_t size = g.bytes() / g.count();
  std::array<int, 3> i{}, n;
  for (i[2] = 0; i[2] < g.dims[axis[2]]; ++i[2])
    for (i[1] = 0; i[1] < g.dims[axis[1]]; ++i[1])
      for (i[0] = 0; i[0] < g.dims[axis[0]]; ++i[0]) {
        for (std::size_t c = 0; c < 3; ++c) n[axis[c]] = order[c] < 0 ? g.dims[axis[c]] - 1 - i[c] : i[c];
        const auto at = (std::size_t(n[2]) * std::size_t(g.dims[1]) + std::size_t(n[1])) * std::size_t(g.dims[0]) +
                        std::size_t(n[0]);
        out.write(static_cast<const char*>(g.voxels.get()) + at * size, static_cast<std::streamsize>(size));
      }
  return {{"type", "nrrd"}, {"file", file}};
}

std::shared_ptr<const GridField> field_of(const View& view, const json& data) {
  json config = view.config;
  config["data"] = data;
  return std::dynamic_pointer_cast<const GridField>(scene_of(config).field);
}

void expect_same(const View& view, const json& a, const json& b, const std::string& what) {
  const FrameImage reference = picture(view, a);
  const auto field = field_of(view, a), other = field_of(view, b);
  const double bound = bound_of(view, *field, *other), worst = largest_difference(reference, picture(view, b));
  EXPECT_LE(worst, bound) << what;
  // Negative control: the same voxels, one axis backwards, with the affine of the other direction.
  double least = 1e300;
  for (const std::array<int, 3>& order : {std::array{-1, 2, 3}, {1, -2, 3}, {1, 2, -3}})
    least = std::min(least, largest_difference(reference, picture(view, reordered(*other, order, false))));
  EXPECT_GT(least, 10 * bound) << what << ": a mirrored scan is not noticed";
  std::printf("%s: worst difference %.3g, bound %.3g; mirrored along one axis: at least %.3g\n", what.c_str(), worst,
              bound, least);
}

}  // namespace dvrlab::test
