#include "framework/app/starter.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/app/starter_rule.h"
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
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

std::string vector(const Vector3& v) {
  std::string text;
  for (double x : v) text += (text.empty() ? "[" : ", ") + number(std::fabs(x) < 5e-4 ? 0 : x);
  return text + "]";
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

std::string path_in(const std::string& folder, const std::string& file) {
  return std::filesystem::proximate(std::filesystem::absolute(file), folder).string();
}

/// Transfer functions: [value, opacity] and [value, r, g, b].
struct Functions {
  std::string opacity, color;
};

Functions functions_of(const ValueClasses& c, double lowest, double highest) {
  const double soft = c.dense - c.cut, ramp = 0.25 * soft;
  // A ramp around each threshold: sharp steps would show every noisy voxel.
  const double opaque_from = std::min(c.dense + 0.5 * (c.top - c.dense), highest);
  const auto node = [](double v, const char* rest) { return "[" + number(v) + ", " + rest + "]"; };
  Functions f;
  f.opacity = "[" + node(lowest, "0") + ", " + node(c.cut - 0.5 * ramp, "0") + ", " + node(c.cut + ramp, "0.04") +
              ",\n                " + node(c.dense - 0.5 * ramp, "0.05") + ", " + node(opaque_from, "0.6") + ", " +
              node(highest, "0.8") + "]";
  f.color = "[" + node(c.cut, "0.80, 0.42, 0.28") + ", " + node(0.5 * (c.cut + c.dense), "0.93, 0.68, 0.45") +
            ",\n              " + node(c.dense, "0.98, 0.86, 0.66") + ", " + node(c.top, "1.00, 0.97, 0.90") + "]";
  return f;
}

std::string unit_word(const Field& f) { return f.length_unit.empty() ? "world units" : f.length_unit; }

}  // namespace

std::string starter_words(const LoadedData& data) {
  const ValueClasses c = value_classes(histogram_of(grid_of(data)));
  return "values below " + number(c.cut) + " are background, those around " + number(0.5 * (c.cut + c.dense)) +
         " translucent, those from " + number(c.dense) + " dense; seen from the left front, above";
}

std::string starter_config(const LoadedData& data, const std::string& folder) {
  const GridField& grid = grid_of(data);
  const Histogram h = histogram_of(grid);
  const ValueClasses c = value_classes(h);
  const StarterView view = starter_view(grid, c.cut);
  const Functions f = functions_of(c, h.first, h.last());
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
         number(h.first) + " to " + number(h.last()) +
         " here (dvrlab info shows how often each occurs).\n"
         "  \"optical_model\": {\n"
         "    \"type\": \"absorption_emission\",\n"
         "    \"shaded\": true,\n"
         "    // [value, opacity] of " +
         number(view.diagonal / 100) + " " + unit_word(grid) +
         " of material, a hundredth of what is visible. Linear between.\n"
         "    // Background is below " +
         number(c.cut) + ", dense material begins at " + number(c.dense) +
         ".\n"
         "    \"dl_std\": " +
         number(view.diagonal / 100) +
         ",\n"
         "    \"opacity\": " +
         f.opacity +
         ",\n"
         "    // [value, red, green, blue]\n"
         "    \"color\": " +
         f.color +
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
                          : "  // x, y and z are the file's axes.\n") +
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
