#include "framework/app/starter_rule.h"

#include <algorithm>
#include <cmath>

#include "framework/scene/parallel.h"
#include "framework/scene/vector.h"

namespace dvrlab {
namespace {

constexpr std::size_t otsu_bins = 256;
constexpr double rare = 0.9995;  // a share of voxels beyond it decides nothing: metal, noise

/// Voxels of each of three classes, their sum of values, and what Otsu maximises.
double between_classes(const std::vector<double>& count, const std::vector<double>& moment, std::size_t a,
                       std::size_t b) {
  const auto part = [](const std::vector<double>& sums, std::size_t from, std::size_t to) {
    return sums[to] - sums[from];
  };
  const std::size_t end = count.size() - 1, bounds[] = {0, a, b, end};
  double sum = 0;
  for (int c = 0; c < 3; ++c) {
    const double n = part(count, bounds[c], bounds[c + 1]), m = part(moment, bounds[c], bounds[c + 1]);
    if (n > 0) sum += m * m / n;
  }
  return sum;
}

/// The index box of all voxels of at least `cut`.
struct IndexBox {
  std::array<int, 3> lo{1 << 30, 1 << 30, 1 << 30}, hi{-1, -1, -1};
  void add(const std::array<int, 3>& p) {
    for (std::size_t a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], p[a]);
      hi[a] = std::max(hi[a], p[a]);
    }
  }
};

IndexBox visible_box(const GridField& grid, double cut) {
  IndexBox box;
  const auto& d = grid.dims;
  for (int k = 0; k < d[2]; ++k)
    for (int j = 0; j < d[1]; ++j)
      for (int i = 0; i < d[0]; ++i)
        if (grid.slope * grid.at(i, j, k) + grid.intercept >= cut) box.add({i, j, k});
  if (box.hi[0] < 0) box.add({0, 0, 0}), box.add({d[0] - 1, d[1] - 1, d[2] - 1});
  return box;
}

}  // namespace

ValueClasses value_classes(const Histogram& h) {
  const double first = h.first, top = std::max(h.quantile(rare), first + h.step);
  const double width = (top - first) / static_cast<double>(otsu_bins);
  std::vector<double> count(otsu_bins + 1), moment(otsu_bins + 1);  // sums up to each edge
  if (!(width > 0)) return {first, first, first};
  for (std::size_t b = 0; b < h.count.size(); ++b) {
    const double at = std::min((h.value(b) - first) / width, static_cast<double>(otsu_bins) - 1);
    count[static_cast<std::size_t>(at) + 1] += static_cast<double>(h.count[b]);
    moment[static_cast<std::size_t>(at) + 1] += static_cast<double>(h.count[b]) * at;
  }
  for (std::size_t b = 1; b <= otsu_bins; ++b) {
    count[b] += count[b - 1];
    moment[b] += moment[b - 1];
  }
  std::size_t cut = 1, dense = 2;
  double best = -1;
  for (std::size_t a = 1; a + 1 < otsu_bins; ++a) {
    for (std::size_t b = a + 1; b < otsu_bins; ++b) {
      const double value = between_classes(count, moment, a, b);
      if (value > best) best = value, cut = a, dense = b;
    }
  }
  return {first + static_cast<double>(cut) * width, first + static_cast<double>(dense) * width, top};
}

StarterView starter_view(const GridField& grid, double cut) {
  const IndexBox box = visible_box(grid, cut);
  const Vector3 middle = grid.to_world.point(times(plus(grid.lo, grid.hi), 0.5));
  const double unit = 0.5 * length(grid.to_world.vector(minus(grid.hi, grid.lo)));
  std::array<Vector3, 8> corners;
  Vector3 lo{1e300, 1e300, 1e300}, hi{-1e300, -1e300, -1e300};
  for (std::size_t c = 0; c < 8; ++c) {
    Vector3 p;
    for (std::size_t a = 0; a < 3; ++a) p[a] = (c >> a & 1) != 0 ? box.hi[a] : box.lo[a];
    corners[c] = times(minus(grid.to_world.point(p), middle), 1.0 / unit);
    for (std::size_t a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], corners[c][a]);
      hi[a] = std::max(hi[a], corners[c][a]);
    }
  }
  StarterView view;
  view.target = times(plus(lo, hi), 0.5);
  view.diagonal = unit * length(minus(corners[7], corners[0]));
  // A patient's left front is -x, +y; elsewhere the front is where y is small, as one looks along the axes.
  const Vector3 towards_camera =
      unit_vector(grid.anatomical ? Vector3{-0.55, 0.8, 0.35} : Vector3{-0.5, -0.8, 0.45}, "never 0");
  const Vector3 right = unit_vector(cross(times(towards_camera, -1), {0, 0, 1}), "never 0");
  const Vector3 up = cross(right, times(towards_camera, -1));
  // Near enough that the corners fill the image, with a margin.
  const double tangent = std::tan(0.5 * view.fov_deg * 3.14159265358979323846 / 180.0) * 0.95;
  double distance = 0;
  for (const Vector3& c : corners) {
    const Vector3 p = minus(c, view.target);
    const double across = std::max(std::fabs(dot(p, right)), std::fabs(dot(p, up)));
    distance = std::max(distance, across / tangent + dot(p, towards_camera));
  }
  view.position = plus(view.target, times(towards_camera, distance));
  view.towards_light = unit_vector(plus(plus(towards_camera, times(up, 0.6)), times(right, -0.5)), "never 0");
  return view;
}

}  // namespace dvrlab
