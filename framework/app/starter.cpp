#include "framework/app/starter.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/app/starter_view.h"
#include "framework/app/value_classes.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

const GridField& grid_of(const LoadedData& data) {
  const auto* grid = dynamic_cast<const GridField*>(data.field.get());
  if (grid == nullptr)
    throw InputError(data.field->source +
                     ": a starter config is made from a histogram of voxels, and this data has none");
  return *grid;
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", x);
  return text;
}

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

std::string vector(const Vector3& v) {
  std::string text;
  for (double x : v) text += (text.empty() ? "[" : ", ") + short_number(std::fabs(x) < 5e-4 ? 0 : x);
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
    throw InputError(grid.source + ": every voxel has the value " + number(c.histogram.first) +
                     "; there is nothing to make a picture of");
  c.value = value_classes(c.histogram);
  c.view = starter_view(grid, c.value.cut);
  c.soft_opacity = soft_opacity(c.histogram, c.value, c.view.box_voxels);
  return c;
}

std::string node(double value, const std::string& rest) { return "[" + number(value) + ", " + rest + "]"; }

// Ramps around the thresholds: sharp steps would show every noisy voxel.
std::string opacity_nodes(const Choice& c) {
  const double lowest = c.histogram.first, highest = c.histogram.last();
  const ValueClasses& v = c.value;
  const double ramp = 0.25 * (v.dense - v.cut), soft = c.soft_opacity;
  return "[" + node(lowest, "0") + ", " + node(std::max(lowest, v.cut - 0.5 * ramp), "0") + ", " +
         node(v.cut + ramp, short_number(soft)) + ",\n                " +
         node(v.dense - 0.5 * ramp, short_number(1.2 * soft)) + ", " + node(0.5 * (v.dense + v.top), "0.6") + ", " +
         node(highest, "0.8") + "]";
}

std::string color_nodes(const ValueClasses& v) {
  return "[" + node(v.cut, "0.80, 0.42, 0.28") + ", " + node(0.5 * (v.cut + v.dense), "0.93, 0.68, 0.45") +
         ",\n              " + node(v.dense, "0.98, 0.86, 0.66") + ", " + node(v.top, "1.00, 0.97, 0.90") + "]";
}

std::string unit_word(const Field& f) { return f.length_unit.empty() ? "world units" : f.length_unit; }

}  // namespace

std::string starter_words(const LoadedData& data) {
  const ValueClasses c = choose(data).value;
  return "values below " + number(c.cut) + " are background, those around " + number(0.5 * (c.cut + c.dense)) +
         " translucent, those from " + number(c.dense) + " dense; seen from the left front, above" +
         (data.field->anatomical ? "" : ", with the file's z axis up");
}

std::string starter_config(const LoadedData& data, const std::string& folder) {
  const GridField& grid = grid_of(data);
  const Choice chosen = choose(data);
  const ValueClasses& c = chosen.value;
  const StarterView& view = chosen.view;
  const std::string file = path_in(folder, grid.source), name = std::filesystem::path(file).filename().string();
  return "// A first picture of " + name +
         ", made from its histogram. Edit and render it again:\n"
         "//   dvrlab render THIS_FILE -o image.png\n"
         "// Every key: dvrlab describe absorption_emission, dvrlab describe camera.perspective, ...\n"
         "{\n"
         "  \"data\": { \"type\": " +
         quoted(data.type) + ", \"file\": " + quoted(file) +
         " },\n"
         "  // Values are physical, " +
         number(chosen.histogram.first) + " to " + number(chosen.histogram.last()) +
         " here (dvrlab info shows how often each occurs).\n"
         "  \"optical_model\": {\n"
         "    \"type\": \"absorption_emission\",\n"
         "    \"shaded\": true,\n"
         "    // [value, opacity] of " +
         short_number(view.diagonal / 100) + " " + unit_word(grid) +
         " of material, a hundredth of what is visible. Linear between.\n"
         "    // Background is below " +
         number(c.cut) + ", dense material begins at " + number(c.dense) +
         ".\n"
         "    \"dl_std\": " +
         short_number(view.diagonal / 100) +
         ",\n"
         "    \"opacity\": " +
         opacity_nodes(chosen) +
         ",\n"
         "    // [value, red, green, blue]\n"
         "    \"color\": " +
         color_nodes(c) +
         "\n"
         "  },\n"
         "  \"estimator\": { \"type\": \"direct\" },\n"
         "  // The light comes from the upper left of the first view; another one: { \"type\": \"head\" } shines from "
         "the eye.\n"
         "  \"lights\": [{ \"type\": \"directional\", \"frame\": \"data\", \"direction\": " +
         vector(view.towards_light) +
         " }],\n"
         "  \"illumination\": [{ \"type\": \"blinn_phong\", \"ambient\": 0.35, \"diffuse\": 0.75, \"specular\": 0.2, "
         "\"shininess\": 20 }],\n"
         "  // Coordinates of the frame \"data\": the origin is the centre of the data's box, the unit half its "
         "diagonal;\n" +
         (grid.anatomical ? "  // x points to the patient's right, y to the front, z up.\n"
                          : "  // x, y and z are the file's axes; nothing says which one is up, so it is z.\n") +
         "  \"camera\": { \"type\": \"perspective\", \"frame\": \"data\", \"position\": " + vector(view.position) +
         ",\n"
         "              \"target\": " +
         vector(view.target) + ", \"up\": [0, 0, 1], \"fov_deg\": " + number(view.fov_deg) +
         " },\n"
         "  // Half a voxel between samples; smaller is slower and more exact.\n"
         "  \"sampling\": { \"type\": \"uniform\", \"step\": 0.5, \"unit\": \"voxel\" },\n"
         "  \"image\": { \"size\": [640, 640], \"background\": [0.05, 0.06, 0.08] },\n"
         "  // cpu, vulkan or opengl: the same bits\n"
         "  \"backend\": { \"type\": \"cpu\" }\n"
         "}\n";
}

}  // namespace dvrlab
