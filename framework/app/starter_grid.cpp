#include <algorithm>
#include <cmath>
#include <mutex>
#include <string_view>
#include <vector>

#include "framework/app/starter_kinds.h"
#include "framework/app/starter_text.h"
#include "framework/app/starter_view.h"
#include "framework/app/value_classes.h"
#include "framework/interfaces/error.h"
#include "framework/report/number_text.h"
#include "framework/scene/parallel.h"
#include "framework/scene/vector.h"

namespace dvrlab {
namespace {

/// What can be seen at first.
struct Visible {
  std::vector<Vector3> points;  // world; their convex hull holds all that is visible
  double diagonal = 0;          // of the box around it, world units
  double box_voxels = 0;        // grid points in that box
};

/// The first and the last visible grid point of every row: their convex hull holds all others. Index coordinates.
std::vector<Vector3> visible_points(const GridField& grid, double cut) {
  const int nx = grid.dims[0], ny = grid.dims[1];
  const auto rows = static_cast<std::uint64_t>(ny) * static_cast<std::uint64_t>(grid.dims[2]);
  const auto visible = [&](int i, int j, int k) { return grid.slope * grid.at(i, j, k) + grid.intercept >= cut; };
  std::vector<Vector3> points;
  std::mutex guard;
  parallel_ranges(rows, 64, [&](std::uint64_t begin, std::uint64_t end) {
    std::vector<Vector3> mine;
    for (std::uint64_t row = begin; row < end; ++row) {
      const int j = static_cast<int>(row % static_cast<std::uint64_t>(ny));
      const int k = static_cast<int>(row / static_cast<std::uint64_t>(ny));
      int first = 0, last = nx - 1;
      while (first < nx && !visible(first, j, k)) ++first;
      if (first == nx) continue;
      while (!visible(last, j, k)) --last;
      for (int i : {first, last}) mine.push_back({double(i), double(j), double(k)});
    }
    const std::lock_guard lock(guard);
    points.insert(points.end(), mine.begin(), mine.end());
  });
  if (points.empty()) points = {grid.lo, grid.hi};
  return points;
}

Visible visible_in(const GridField& grid, double cut) {
  Visible v{visible_points(grid, cut)};
  Vector3 lo = v.points.front(), hi = lo;
  for (Vector3& p : v.points) {
    for (std::size_t a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], p[a]);
      hi[a] = std::max(hi[a], p[a]);
    }
    p = grid.to_world.point(p);
  }
  const Vector3 size = minus(hi, lo);
  v.diagonal = length(grid.to_world.vector(size));
  v.box_voxels = (size[0] + 1) * (size[1] + 1) * (size[2] + 1);
  return v;
}

/// What is chosen from the data.
struct Choice {
  Histogram histogram;
  ValueClasses value;
  Visible visible;
  double soft_opacity = 0;  // of a hundredth of the visible diagonal
};

/// Rays through the middle should see into the soft material, whether it fills the box (a head) or not (a tree): the
/// opacity at which this much light passes along a mean path.
double soft_opacity(const Histogram& h, const ValueClasses& c, double box_voxels) {
  constexpr double passes = 0.4, mean_path = 58;  // hundredths of a cube's diagonal, 1 / sqrt(3)
  const double soft = static_cast<double>(h.at_least(c.cut) - h.at_least(c.dense));
  const double path = std::max(mean_path * soft / box_voxels, 1.0);
  return std::clamp(1.0 - std::pow(passes, 1.0 / path), 0.02, 0.12);
}

Choice choose(const GridField& grid) {
  Choice c;
  c.histogram = histogram_of(grid);
  if (c.histogram.count.size() < 2)
    throw InputError(grid.source + ": every voxel has the value " + number_text(c.histogram.first) +
                     "; there is nothing to make a picture of");
  c.value = value_classes(c.histogram);
  c.visible = visible_in(grid, c.value.cut);
  c.soft_opacity = soft_opacity(c.histogram, c.value, c.visible.box_voxels);
  return c;
}

// Ramps around the thresholds: sharp steps would show every noisy voxel.
std::string opacity_nodes(const Choice& c) {
  const double lowest = c.histogram.first, highest = c.histogram.last();
  const ValueClasses& v = c.value;
  const double ramp = 0.25 * (v.dense - v.cut), soft = c.soft_opacity;
  return "[" + node_text(lowest, "0") + ", " + node_text(std::max(lowest, v.cut - 0.5 * ramp), "0") + ", " +
         node_text(v.cut + ramp, number_text(soft, 3)) + ",\n                " +
         node_text(v.dense - 0.5 * ramp, number_text(1.2 * soft, 3)) + ", " +
         node_text(0.5 * (v.dense + v.top), "0.6") + ", " + node_text(highest, "0.8") + "]";
}

std::string color_nodes(const ValueClasses& v) {
  return "[" + node_text(v.cut, "0.80, 0.42, 0.28") + ", " + node_text(0.5 * (v.cut + v.dense), "0.93, 0.68, 0.45") +
         ",\n              " + node_text(v.dense, "0.98, 0.86, 0.66") + ", " + node_text(v.top, "1.00, 0.97, 0.90") +
         "]";
}

/// The config, with what is chosen from the data between dollar signs.
constexpr std::string_view form = R"(// A first picture of $name$, made from its histogram. Edit and render it again:
//   dvrlab render THIS_FILE -o image.png
// Every key: dvrlab describe absorption_emission, dvrlab describe camera.perspective, ...
{
  "data": $data$,
  // Values are physical, $lowest$ to $highest$ here (dvrlab info shows how often each occurs).
  "optical_model": {
    "type": "absorption_emission",
    "shaded": true,
    // [value, opacity] of $dl_std$ $unit$ of material, a hundredth of what is visible. Linear between.
    // Background is below $cut$, dense material begins at $dense$.
    "dl_std": $dl_std$,
    "opacity": $opacity$,
    // [value, red, green, blue]
    "color": $color$
  },
  "estimator": { "type": "direct" },
  // The light comes from the upper left of the first view; another one: { "type": "head" } shines from the eye.
  "lights": [{ "type": "directional", "frame": "data", "direction": $towards_light$ }],
  "illumination": [{ "type": "blinn_phong", "ambient": 0.35, "diffuse": 0.75, "specular": 0.2, "shininess": 20 }],
  // Coordinates of the frame "data": the origin is the centre of the data's box, the unit half its diagonal;
  // $axes$
  "camera": { "type": "perspective", "frame": "data", "position": $position$,
              "target": $target$, "up": [0, 0, 1], "fov_deg": $fov_deg$ },
  // Half a voxel between samples; smaller is slower and more exact.
  "sampling": { "type": "uniform", "step": 0.5, "unit": "voxel" },
  "image": { "size": [640, 640], "background": [0.05, 0.06, 0.08] },
  // cpu, vulkan or opengl: the same bits
  "backend": { "type": "cpu" }
}
)";

}  // namespace

std::string grid_starter_words(const GridField& grid) {
  const ValueClasses c = choose(grid).value;
  return "values below " + number_text(c.cut) + " are background, those around " +
         number_text(0.5 * (c.cut + c.dense)) + " translucent, those from " + number_text(c.dense) + " dense";
}

std::string grid_starter_config(const LoadedData& data, const GridField& grid, const std::string& folder) {
  const Choice chosen = choose(grid);
  const StarterView view = starter_view(chosen.visible.points, grid);
  return filled(form, {{"name", file_name_of(data)},
                       {"data", data_section_in(folder, data)},
                       {"lowest", number_text(chosen.histogram.first)},
                       {"highest", number_text(chosen.histogram.last())},
                       {"dl_std", number_text(chosen.visible.diagonal / 100, 3)},
                       {"unit", unit_text(grid)},
                       {"cut", number_text(chosen.value.cut)},
                       {"dense", number_text(chosen.value.dense)},
                       {"opacity", opacity_nodes(chosen)},
                       {"color", color_nodes(chosen.value)},
                       {"towards_light", vector_text(view.towards_light)},
                       {"axes", axes_text(grid)},
                       {"position", vector_text(view.position)},
                       {"target", vector_text(view.target)},
                       {"fov_deg", number_text(view.fov_deg)}});
}

}  // namespace dvrlab
