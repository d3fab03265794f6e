#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "framework/app/starter_kinds.h"
#include "framework/app/starter_text.h"
#include "framework/app/starter_view.h"
#include "framework/interfaces/error.h"
#include "framework/report/number_text.h"
#include "framework/scene/mesh/tetrahedra.h"
#include "framework/scene/vector.h"

namespace dvrlab {
namespace {

/// Values that a part of all points lie below: 0, 1/10, 1/2, 9/10, all; each above the one before.
struct Spread {
  std::vector<double> value;
  double middle = 0;
};

Spread spread_of(const MeshField& mesh) {
  std::vector<double> sorted = mesh.value;
  std::sort(sorted.begin(), sorted.end());
  if (sorted.front() == sorted.back())
    throw InputError(mesh.source + ": every point has the value " + number_text(sorted.front()) +
                     "; there is nothing to make a picture of");
  const auto part = [&](double p) {
    return sorted[static_cast<std::size_t>(p * static_cast<double>(sorted.size() - 1))];
  };
  // Where most points have one value, the middle must lie inside the range all the same.
  const double lo = sorted.front(), hi = sorted.back(), edge = 0.02 * (hi - lo);
  Spread s;
  s.middle = std::clamp(part(0.5), lo + 2 * edge, hi - 2 * edge);
  s.value = {lo, std::clamp(part(0.1), lo + edge, s.middle - edge), s.middle,
             std::clamp(part(0.9), s.middle + edge, hi - edge), hi};
  return s;
}

/// The mean way of a ray through a convex body, which most meshes are nearly: 4 volume / surface (Cauchy).
double mean_path(const MeshField& mesh) {
  const Tetrahedra& t = tetrahedra_in(mesh);
  const auto point = [&](std::int32_t k) { return mesh.point[static_cast<std::size_t>(k)]; };
  double volume = 0, surface = 0;
  for (const auto& v : t.vertex) volume += std::abs(volume6(point(v[0]), point(v[1]), point(v[2]), point(v[3]))) / 6;
  for (const Tetrahedra::BoundaryFace& f : t.boundary) {
    const Vector3 a = point(f.vertex[0]);
    surface += 0.5 * length(cross(minus(point(f.vertex[1]), a), minus(point(f.vertex[2]), a)));
  }
  return surface > 0 && volume > 0 ? 4 * volume / surface : mesh.voxel;
}

/// Optical depth of the mean path, for a value of each part: most of the matter is thin.
constexpr double depth[] = {4, 1, 0.25, 1, 4};
const char* const color[] = {"0.15, 0.35, 0.90", "0.40, 0.70, 0.95", "0.90, 0.90, 0.88", "0.98, 0.65, 0.35",
                             "0.90, 0.20, 0.10"};

template <class Text>
std::string nodes(const Spread& s, Text text) {
  std::string list;
  for (std::size_t k = 0; k < s.value.size(); ++k) list += (k > 0 ? ", " : "[") + node_text(s.value[k], text(k));
  return list + "]";
}

/// The config, with what is chosen from the data between dollar signs.
constexpr std::string_view form =
    R"(// A first picture of $name$, made from the values at its points. Edit and render it again:
//   dvrlab render THIS_FILE -o image.png
// Every key: dvrlab describe volume_density, dvrlab describe camera.perspective, ...
{
  "data": $data$,
  // Values are physical, $lowest$ to $highest$ here; half of the points lie below $middle$.
  "optical_model": {
    "type": "volume_density", "tf": "nodes",
    // [value, optical density] of one $unit$ of length. Linear between. Thin where most of the values are.
    "length_unit": "world",
    "density": $density$,
    // [value, red, green, blue]
    "chromaticity": $color$
  },
  // One exact segment per cell and interval of the transfer functions.
  "estimator": { "type": "exact" },
  // Coordinates of the frame "data": the origin is the centre of the data's box, the unit half its diagonal;
  // $axes$
  "camera": { "type": "perspective", "frame": "data", "position": $position$,
              "target": $target$, "up": [0, 0, 1], "fov_deg": $fov_deg$ },
  // A segment is a ray's way through a cell, or parts of it of at most this many mean lengths of an edge.
  "sampling": { "type": "faces", "step": 100, "unit": "voxel" },
  "image": { "size": [640, 640], "background": [0.05, 0.06, 0.08] },
  // cpu, vulkan or opengl: the same bits
  "backend": { "type": "cpu" }
}
)";

}  // namespace

std::string mesh_starter_words(const MeshField& mesh) {
  const Spread s = spread_of(mesh);
  return "values around " + number_text(s.middle) + " are thin, towards " + number_text(s.value.front()) +
         " they become dense and blue, towards " + number_text(s.value.back()) + " dense and red";
}

std::string mesh_starter_config(const LoadedData& data, const MeshField& mesh, const std::string& folder) {
  const Spread s = spread_of(mesh);
  const StarterView view = starter_view(mesh.point, mesh);
  const double path = mean_path(mesh);
  return filled(form, {{"name", file_name_of(data)},
                       {"data", data_section_in(folder, data)},
                       {"lowest", number_text(s.value.front())},
                       {"highest", number_text(s.value.back())},
                       {"middle", number_text(s.middle)},
                       {"unit", mesh.length_unit.empty() ? "world unit" : mesh.length_unit},
                       {"density", nodes(s, [&](std::size_t k) { return number_text(depth[k] / path, 3); })},
                       {"color", nodes(s, [](std::size_t k) { return std::string(color[k]); })},
                       {"axes", axes_text(mesh)},
                       {"position", vector_text(view.position)},
                       {"target", vector_text(view.target)},
                       {"fov_deg", number_text(view.fov_deg)}});
}

}  // namespace dvrlab
