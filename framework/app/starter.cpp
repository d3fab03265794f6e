#include "framework/app/starter.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "framework/app/starter_view.h"
#include "framework/app/value_classes.h"
#include "framework/interfaces/error.h"
#include "framework/report/number_text.h"

namespace dvrlab {
namespace {

const GridField& grid_of(const LoadedData& data) {
  const auto* grid = dynamic_cast<const GridField*>(data.field.get());
  if (grid == nullptr)
    throw InputError(data.field->source +
                     ": a starter config is made from a histogram of voxels, and this data has none");
  return *grid;
}

std::string vector(const Vector3& v) {
  std::string text;
  for (double x : v) text += (text.empty() ? "[" : ", ") + number_text(std::fabs(x) < 5e-4 ? 0 : x, 3);
  return text + "]";
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

/// Relative where the file lies near the config, so that both can be moved together.
std::string path_in(const std::string& folder, const std::string& file) {
  const std::string absolute = std::filesystem::weakly_canonical(file).string();
  const std::string relative = std::filesystem::proximate(absolute, folder).string();
  return relative.starts_with("../../../") ? absolute : relative;
}

/// What is chosen from the data.
struct Choice {
  Histogram histogram;
  ValueClasses value;
  StarterView view;
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

Choice choose(const LoadedData& data) {
  const GridField& grid = grid_of(data);
  Choice c;
  c.histogram = histogram_of(grid);
  if (c.histogram.count.size() < 2)
    throw InputError(grid.source + ": every voxel has the value " + number_text(c.histogram.first) +
                     "; there is nothing to make a picture of");
  c.value = value_classes(c.histogram);
  c.view = starter_view(grid, c.value.cut);
  c.soft_opacity = soft_opacity(c.histogram, c.value, c.view.box_voxels);
  return c;
}

std::string node(double value, const std::string& rest) { return "[" + number_text(value) + ", " + rest + "]"; }

// Ramps around the thresholds: sharp steps would show every noisy voxel.
std::string opacity_nodes(const Choice& c) {
  const double lowest = c.histogram.first, highest = c.histogram.last();
  const ValueClasses& v = c.value;
  const double ramp = 0.25 * (v.dense - v.cut), soft = c.soft_opacity;
  return "[" + node(lowest, "0") + ", " + node(std::max(lowest, v.cut - 0.5 * ramp), "0") + ", " +
         node(v.cut + ramp, number_text(soft, 3)) + ",\n                " +
         node(v.dense - 0.5 * ramp, number_text(1.2 * soft, 3)) + ", " + node(0.5 * (v.dense + v.top), "0.6") + ", " +
         node(highest, "0.8") + "]";
}

std::string color_nodes(const ValueClasses& v) {
  return "[" + node(v.cut, "0.80, 0.42, 0.28") + ", " + node(0.5 * (v.cut + v.dense), "0.93, 0.68, 0.45") +
         ",\n              " + node(v.dense, "0.98, 0.86, 0.66") + ", " + node(v.top, "1.00, 0.97, 0.90") + "]";
}

/// The config, with what is chosen from the data between dollar signs.
constexpr std::string_view form = R"(// A first picture of $name$, made from its histogram. Edit and render it again:
//   dvrlab render THIS_FILE -o image.png
// Every key: dvrlab describe absorption_emission, dvrlab describe camera.perspective, ...
{
  "data": { "type": $type$, "file": $file$ },
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

std::string filled(const std::map<std::string, std::string, std::less<>>& words) {
  std::string text;
  for (std::size_t at = 0;;) {
    const std::size_t open = form.find('$', at);
    text += form.substr(at, open - at);
    if (open == std::string_view::npos) return text;
    const std::size_t close = form.find('$', open + 1);
    text += words.find(form.substr(open + 1, close - open - 1))->second;
    at = close + 1;
  }
}

}  // namespace

std::string starter_words(const LoadedData& data) {
  const ValueClasses c = choose(data).value;
  return "values below " + number_text(c.cut) + " are background, those around " +
         number_text(0.5 * (c.cut + c.dense)) + " translucent, those from " + number_text(c.dense) +
         " dense; seen from the left front, above" + (data.field->anatomical ? "" : ", with the file's z axis up");
}

std::string starter_config(const LoadedData& data, const std::string& folder) {
  const GridField& grid = grid_of(data);
  const Choice chosen = choose(data);
  const StarterView& view = chosen.view;
  const std::string file = path_in(folder, grid.source), dl_std = number_text(view.diagonal / 100, 3);
  return filled(
      {{"name", std::filesystem::path(file).filename().string()},
       {"type", quoted(data.type)},
       {"file", quoted(file)},
       {"lowest", number_text(chosen.histogram.first)},
       {"highest", number_text(chosen.histogram.last())},
       {"dl_std", dl_std},
       {"unit", unit_text(grid)},
       {"cut", number_text(chosen.value.cut)},
       {"dense", number_text(chosen.value.dense)},
       {"opacity", opacity_nodes(chosen)},
       {"color", color_nodes(chosen.value)},
       {"towards_light", vector(view.towards_light)},
       {"axes", grid.anatomical ? "x points to the patient's right, y to the front, z up."
                                : "x, y and z are the file's axes; nothing says which one is up, so it is z."},
       {"position", vector(view.position)},
       {"target", vector(view.target)},
       {"fov_deg", number_text(view.fov_deg)}});
}

}  // namespace dvrlab
