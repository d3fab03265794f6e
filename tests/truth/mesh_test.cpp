// Meshes: chords through convex and concave ones, every shape of cell against the field that it samples, the golden
// elements, gaps, and planted faults.
#include "framework/interfaces/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <tuple>

#include "tests/truth/ray_cases.h"

namespace dvrlab::test {
namespace {

class Mesh : public testing::TestWithParam<Target> {
 protected:
  FrameResult frame(const json& config) const { return render(config, GetParam()); }
  FrameImage image(const json& config) const { return frame(config).image; }
};

const json box_bounds = {{-1, -0.8, -0.6}, {1, 0.8, 0.6}};

json mesh_data(const std::string& cells, const json& size = {5, 4, 4}, double jitter = 0.3) {
  return {{"type", "procedural"}, {"field", "ramp"},  {"evaluate", "mesh"},   {"cells", cells},
          {"size", size},         {"jitter", jitter}, {"bounds", box_bounds}, {"direction", {0.6, -0.5, 0.7}},
          {"offset", 0.5},        {"scale", 0.3}};
}
json formula_data() {
  return {{"type", "procedural"},          {"field", "ramp"}, {"evaluate", "formula"}, {"bounds", box_bounds},
          {"direction", {0.6, -0.5, 0.7}}, {"offset", 0.5},   {"scale", 0.3}};
}

/// The same ramp, sampled at the points of a grid.
json grid_data(const json& size) {
  json data = formula_data();
  data["evaluate"] = "grid";
  data["size"] = size;
  data["voxel_type"] = "float32";
  return data;
}

json view(json data, const json& model, int side) {
  return {{"data", std::move(data)},
          {"optical_model", model},
          {"estimator", {{"type", "exact"}}},
          {"camera",
           {{"type", "perspective"},
            {"frame", "world"},
            {"position", {1.9, -3.1, 1.7}},
            {"up", {0, 0, 1}},
            {"fov_deg", 34}}},
          {"sampling", {{"type", "uniform"}, {"step", 0.25}, {"unit", "world"}, {"termination", 0}}},
          {"image", {{"size", {side, side}}}}};
}

const json everywhere = {
    {"type", "absorption_emission"}, {"tf", "nodes"}, {"tf_range", {0, 1}}, {"extinction", {{0, 1}}}};

/// Lengths inside the matter, from a constant extinction of 1.
double depth_of(const FrameImage& r, std::size_t pixel) {
  return -std::log(std::max(r.transmittance(3 * pixel), 1e-30));
}

// A million rays through a jittered mesh: as long in it as in the box.
TEST_P(Mesh, ChordsOfAConvexMesh) {
  const int side = GetParam().backend["type"] == "cpu" ? 1000 : 300;
  SKIP_WHEN_NOT_SUPPORTED({
    for (const char* cells : {"tetrahedra5", "tetrahedra6"}) {
      const FrameImage mesh = image(view(mesh_data(cells, {9, 8, 7}), everywhere, side));
      const FrameImage box = image(view(formula_data(), everywhere, side));
      double worst = 0;
      std::size_t inside = 0;
      for (std::size_t p = 0; p < std::size_t(side) * std::size_t(side); ++p) {
        worst = std::max(worst, std::abs(depth_of(mesh, p) - depth_of(box, p)));
        inside += depth_of(box, p) > 0;
      }
      std::printf("%s: %zu rays meet the box, largest difference of the chord %.1e\n", cells, inside, worst);
      EXPECT_GT(inside, std::size_t(side) * std::size_t(side) / 5);
      EXPECT_LE(worst, 1e-5);
    }
  })
}

// Rays that run along edges and through vertices, down to the last bit.
TEST_P(Mesh, RaysThroughEdgesAndVertices) {
  SKIP_WHEN_NOT_SUPPORTED({
    for (const char* cells : {"tetrahedra5", "tetrahedra6"}) {
      json data = mesh_data(cells, {5, 5, 5}, 0);
      data["bounds"] = {{-1, -1, -1}, {1, 1, 1}};
      for (const json& direction :
           {json{0, 0, -1}, json{0, 1, 0}, json{1, 1, 0}, json{1, -1, 1}, json{0.5, 1, -1}, json{2, 1, 1}}) {
        json config = view(data, everywhere, 33);
        // Pixel centres lie on multiples of 1/16: on vertices, edges and faces of the mesh.
        json at = json::array();
        for (int a = 0; a < 3; ++a) at.push_back(-3 * direction[std::size_t(a)].get<double>());
        config["camera"] = {{"type", "orthographic"},
                            {"frame", "world"},
                            {"position", at},
                            {"target", {0, 0, 0}},
                            {"up", direction[2] == -1 ? json{0, 1, 0} : json{0, 0, 1}},
                            {"height", 33.0 / 16}};
        const FrameImage mesh = image(config);
        const auto box_of = [&](double side) {
          json formula = config;
          formula["data"] = formula_data();
          formula["data"]["bounds"] = {{-side, -side, -side}, {side, side, side}};
          return image(formula);
        };
        const FrameImage box = box_of(1), smaller = box_of(1 - 1e-5), larger = box_of(1 + 1e-5);
        std::size_t judged = 0;
        for (std::size_t p = 0; p < 33 * 33; ++p) {
          // A ray in a face of the box may count as inside or as outside.
          const bool tangent = std::abs(depth_of(smaller, p) - depth_of(larger, p)) > 1e-3;
          judged += !tangent && depth_of(box, p) > 0;
          if (!tangent) {
            ASSERT_NEAR(depth_of(mesh, p), depth_of(box, p), 1e-5) << cells << direction.dump() << " pixel " << p;
          }
        }
        EXPECT_GT(judged, 300u);
      }
    }
  })
}

const json layers = {{"type", "absorption_emission"},
                     {"tf", "nodes"},
                     {"extinction", {{0, 0.1}, {0.4, 0.2}, {0.5, 4}, {0.6, 0.5}, {1, 2}}},
                     {"color", {{0, 0.1, 0.3, 1}, {0.5, 1, 0.8, 0.2}, {1, 0.7, 0.1, 0.4}}}};

// A linear field is linear in every cell: the mesh gives what the formula gives, whatever its cells are.
TEST_P(Mesh, LinearFieldIsTheFormulas){SKIP_WHEN_NOT_SUPPORTED({
  const FrameImage formula = image(view(formula_data(), layers, 40));
  for (const char* cells :
       {"tetrahedra5", "tetrahedra6", "hexahedra", "wedges", "pyramids", "tetrahedra10", "hexahedra20", "wedges15"}) {
    // Faces of jittered hexahedra are no planes: the map is continued beyond them, which a linear field does not mind.
    json data = mesh_data(cells);
    data["tolerance"] = 1e-4;
    const double worst = largest_difference(image(view(data, layers, 40)), formula);
    std::printf("%s: %.1e\n", cells, worst);
    EXPECT_LE(worst, 2e-5) << cells;
  }
  EXPECT_GT(largest_difference(image(view(mesh_data("hexahedra"), everywhere, 40)), formula), 0.1)
      << "negative control";
})}

// And what the renderer of grids gives for it, whose trilinear cells hold a linear field too.
TEST_P(Mesh, LinearFieldIsTheGrids){SKIP_WHEN_NOT_SUPPORTED({
  for (const json& size : {json{5, 4, 4}, json{21, 17, 13}}) {
    const FrameImage grid = image(view(grid_data(size), layers, 40));
    for (const char* cells : {"tetrahedra5", "tetrahedra6"}) {
      const double worst = largest_difference(image(view(mesh_data(cells), layers, 40)), grid);
      std::printf("%s, grid of %s points: %.1e\n", cells, size.dump().c_str(), worst);
      EXPECT_LE(worst, 3e-5) << cells;
    }
  }
  json other = grid_data({5, 4, 4});
  other["offset"] = 0.501;
  EXPECT_GT(largest_difference(image(view(mesh_data("tetrahedra6"), layers, 40)), image(view(other, layers, 40))), 3e-4)
      << "negative control: a field that is 0.001 higher";
})}

// A curved field: cells of higher degree follow it better, and finer cells better than coarse ones.
TEST_P(Mesh, CurvedFieldConverges) {
  if (GetParam().backend["type"] != "cpu") GTEST_SKIP() << "not supported: slow, and agreement compares the bits";
  const auto curved = [](json data) {
    data["field"] = "radial";
    for (const char* key : {"direction", "offset", "scale"}) data.erase(key);
    data["center"] = {0.1, 0.2, -1.4};
    data["scale"] = 0.35;
    data["offset"] = -0.1;
    return data;
  };
  const json soft = {{"type", "absorption_emission"},
                     {"tf", "nodes"},
                     {"extinction", {{0, 0.1}, {0.5, 2}, {1, 0.5}}},
                     {"color", {{0, 0.1, 0.3, 1}, {1, 0.9, 0.5, 0.2}}}};
  SKIP_WHEN_NOT_SUPPORTED({
    json truth = view(curved(formula_data()), soft, 24);
    truth["sampling"]["step"] = 0.002;
    const FrameImage exact = image(truth);
    const auto error = [&](const char* cells, int n) {
      json data = curved(mesh_data(cells, {n + 1, n + 1, n + 1}, 0));
      data["tolerance"] = 1e-4;
      return largest_difference(image(view(data, soft, 24)), exact);
    };
    for (const char* cells :
         {"tetrahedra5", "tetrahedra6", "hexahedra", "wedges", "pyramids", "tetrahedra10", "hexahedra20", "wedges15"}) {
      const double coarse = error(cells, 4), fine = error(cells, 8);
      std::printf("%s: %.1e with 4 bricks a side, %.1e with 8\n", cells, coarse, fine);
      EXPECT_GT(coarse, 2.5 * fine) << cells;
    }
    EXPECT_LT(4 * error("tetrahedra10", 4), error("tetrahedra6", 4));
    EXPECT_LT(4 * error("hexahedra20", 4), error("hexahedra", 4));
  })
}

// Cells are of many lengths, and a table of ratios is made for eight of them: what plugins/estimator/preintegrated says
// of the error.
TEST_P(Mesh, PreintegratedHasTablesForEightLengths) {
  if (GetParam().backend["type"] != "cpu") GTEST_SKIP() << "not supported: slow, and agreement compares the bits";
  const auto extinction = [](double peak) {
    json model = layers;
    model["extinction"] = {{0, 0.1 * peak}, {0.4, 0.05 * peak}, {0.5, peak}, {0.6, 0.125 * peak}, {1, 0.5 * peak}};
    return model;
  };
  SKIP_WHEN_NOT_SUPPORTED({
    for (const auto& [peak, n, bound] :
         {std::tuple{4.0, 64, 3e-4}, {4.0, 256, 2e-5}, {40.0, 256, 2.5e-3}, {40.0, 1024, 2e-3}}) {
      json config = view(mesh_data("tetrahedra6", {9, 7, 6}, 0.3), extinction(peak), 40);
      const FrameImage exact = image(config);
      config["estimator"] = {{"type", "preintegrated"}, {"table_size", n}};
      const double worst = largest_difference(image(config), exact);
      config["estimator"] = {{"type", "approximative"}};
      const double without = largest_difference(image(config), exact);
      std::printf("extinction %g, %d values: %.1e; approximative %.1e\n", peak, n, worst, without);
      EXPECT_LE(worst, bound) << peak << " " << n;
      EXPECT_LT(10 * worst, without) << "the ratios are of use";
    }
  })
}

std::string scratch_file(const std::string& name, const std::string& text) {
  static const std::string folder = [] {
    std::string pattern = testing::TempDir() + "dvrlab_mesh_XXXXXX";
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no scratch folder");
    return pattern;
  }();
  const std::string file = folder + "/" + name;
  std::ofstream(file) << text;
  return file;
}

/// One element of the golden file as a legacy VTK file; the cube-shaped one from its two corners.
std::string element_file(const json& ray) {
  const bool box = ray["element"] == "hex20";
  std::vector<std::array<double, 3>> corner;
  if (box) {
    const auto lo = ray["geometry"][0].get<std::array<double, 3>>(),
               hi = ray["geometry"][1].get<std::array<double, 3>>();
    for (int k = 0; k < 8; ++k) {
      const bool x = k % 4 == 1 || k % 4 == 2, y = k % 4 >= 2, z = k >= 4;
      corner.push_back({x ? hi[0] : lo[0], y ? hi[1] : lo[1], z ? hi[2] : lo[2]});
    }
  } else {
    for (const json& p : ray["geometry"]) corner.push_back(p.get<std::array<double, 3>>());
  }
  const CellShapeInfo& shape = info_of(box ? CellShape::hexahedron20 : CellShape::tetrahedron10);
  for (const auto& e : shape.edges) {
    const auto &a = corner[std::size_t(e[0])], &b = corner[std::size_t(e[1])];
    corner.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
  }
  std::ostringstream text;
  text.precision(17);
  text << "# vtk DataFile Version 2.0\nelement\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << corner.size()
       << " double\n";
  for (const auto& p : corner) text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  text << "CELLS 1 " << corner.size() + 1 << '\n' << corner.size();
  for (std::size_t k = 0; k < corner.size(); ++k) text << ' ' << k;
  text << "\nCELL_TYPES 1\n"
       << shape.vtk_type << "\nPOINT_DATA " << corner.size() << "\nSCALARS v double\nLOOKUP_TABLE default\n";
  for (const json& v : ray["values"]) text << v.get<double>() << '\n';
  return scratch_file(ray["element"].get<std::string>() + ".vtk", text.str());
}

class GoldenMesh : public GoldenOnTarget {};

json golden_element_config(const json& g) {
  json config = golden_config(
      [&] {
        json other = g;  // the model and the background are those of other cases
        other["ray"] = {{"type", "segment"}, {"v0", 0}, {"v1", 1}, {"dl", 1}};
        return other;
      }(),
      1);
  const json& ray = g["ray"];
  const auto a = ray["p0"].get<std::array<double, 3>>(), b = ray["p1"].get<std::array<double, 3>>();
  const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  config["data"] = {{"type", "vtk"}, {"file", element_file(ray)}, {"tolerance", 1e-4}};
  config["camera"] = {{"type", "ray"},
                      {"frame", "world"},
                      {"origin", a},
                      {"direction", {b[0] - a[0], b[1] - a[1], b[2] - a[2]}},
                      {"t", {0, length}}};
  config["sampling"] = {{"type", "uniform"}, {"step", 1}, {"unit", "world"}, {"termination", 0}};
  config["estimator"] = {{"type", "exact"}};
  return config;
}

TEST_P(GoldenMesh, Elements) {
  for (const char* id : {"mesh_tet10", "mesh_hex20"}) {
    const json g = golden_case(id);
    SKIP_WHEN_NOT_SUPPORTED({
      const double error = error_of(render(golden_element_config(g), GetParam()).image, golden_integral(g));
      std::printf("%s: %.1e\n", id, error);
      EXPECT_LE(error, 2e-4) << id;
    })
  }
}

TEST(GoldenMeshFp64, ElementsConvergeWithTheTolerance) {
  if (golden().is_null()) GTEST_SKIP() << "not supported: no data (golden/public.json)";
  for (const char* id : {"mesh_tet10", "mesh_hex20"}) {
    const json g = golden_case(id);
    json config = golden_element_config(g);
    config["precision"] = "fp64";
    double last = 1;
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      config["data"]["tolerance"] = tolerance;
      const FrameImage r = render(config, {"cpu fp64", {{"type", "cpu"}}}).image;
      const RayIntegral truth = golden_integral(g);
      double error = 0;
      for (std::size_t c = 0; c < 3; ++c)
        error = std::max({error, std::abs(r.radiance(c) - truth.I[c]), std::abs(r.transmittance(c) - truth.T[c])});
      std::printf("%s, tolerance %.0e: %.1e\n", id, tolerance, error);
      EXPECT_LT(error, last);
      last = error;
    }
    EXPECT_LE(last, 1e-6) << id;
  }
}

// Two boxes with a gap, one of them with a hole through the middle: pieces of the ray add up.
TEST_P(Mesh, GapsAndHoles) {
  // Bricks of side 1 at these places, each six tetrahedra with points of their own.
  std::vector<std::array<int, 3>> bricks;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        if (!(j == 1 && k == 1) && i != 1) bricks.push_back({i, j, k});
  std::ostringstream points, cells;
  constexpr int ways[6][2] = {{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}};
  for (std::size_t b = 0; b < bricks.size(); ++b) {
    for (int n = 0; n < 8; ++n)
      points << bricks[b][0] + (n % 4 == 1 || n % 4 == 2) << ' ' << bricks[b][1] + (n % 4 >= 2) << ' '
             << bricks[b][2] + (n >= 4) << '\n';
    for (const auto& w : ways)
      cells << "4 " << 8 * b << ' ' << 8 * b + std::size_t(w[0]) << ' ' << 8 * b + std::size_t(w[1]) << ' ' << 8 * b + 6
            << '\n';
  }
  std::ostringstream text;
  text << "# vtk DataFile Version 2.0\nbricks\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << 8 * bricks.size()
       << " float\n"
       << points.str() << "CELLS " << 6 * bricks.size() << ' ' << 30 * bricks.size() << '\n'
       << cells.str() << "CELL_TYPES " << 6 * bricks.size() << '\n';
  for (std::size_t c = 0; c < 6 * bricks.size(); ++c) text << "10\n";
  text << "POINT_DATA " << 8 * bricks.size() << "\nSCALARS v float\nLOOKUP_TABLE default\n";
  for (std::size_t p = 0; p < 8 * bricks.size(); ++p) text << "0.5\n";
  json config = view({{"type", "vtk"}, {"file", scratch_file("bricks.vtk", text.str())}}, everywhere, 1);
  config["optical_model"]["tf_range"] = {0, 2};
  struct Case {
    std::array<double, 3> from, to;
    double chord;
  };
  for (const Case& c : {Case{{-1, 0.3, 0.4}, {4, 0.3, 0.4}, 2}, Case{{-1, 1.4, 1.6}, {4, 1.4, 1.6}, 0},
                        Case{{0.5, 1.4, -1}, {0.5, 1.4, 5}, 2}, Case{{1.5, 0.2, -1}, {1.5, 0.2, 5}, 0},
                        Case{{0.4, 0.3, 0.5}, {4, 0.3, 0.5}, 1.6},     // begins inside
                        Case{{0.4, 0.3, 0.5}, {2.5, 0.3, 0.5}, 1.1}})  // and ends inside
  {
    const double length = std::hypot(c.to[0] - c.from[0], c.to[1] - c.from[1], c.to[2] - c.from[2]);
    config["camera"] = {{"type", "ray"},
                        {"frame", "world"},
                        {"origin", c.from},
                        {"direction", {c.to[0] - c.from[0], c.to[1] - c.from[1], c.to[2] - c.from[2]}},
                        {"t", {0, length}}};
    SKIP_WHEN_NOT_SUPPORTED(EXPECT_NEAR(depth_of(image(config), 0), c.chord, 2e-5)
                            << c.from[0] << " " << c.from[1] << " " << c.from[2])
  }
}

// Planted faults in the tables of the walk are seen.
TEST_P(Mesh, WrongNeighboursAreSeen){SKIP_WHEN_NOT_SUPPORTED({
  const json config = view(mesh_data("tetrahedra6"), layers, 32);
  const FrameImage right = image(config);
  const FrameImage wrong = render(config, GetParam(), [](FrameJob& job) {
                             for (Buffer& b : job.sampler.buffers) {
                               if (b.name != "tetrahedra_cell") continue;
                               auto rows = std::make_shared<std::vector<std::int32_t>>(
                                   static_cast<const std::int32_t*>(b.data.get()),
                                   static_cast<const std::int32_t*>(b.data.get()) + 4 * b.count);
                               for (std::size_t j = 0; j < b.count / 2; j += 7)  // the mesh ends at these faces
                                 for (std::size_t k = 0; k < 4; ++k) (*rows)[8 * j + 4 + k] = -1;
                               b.data = {rows, rows->data()};
                             }
                           }).image;
  EXPECT_GT(largest_difference(wrong, right), 1e-2);
})}

INSTANTIATE_TEST_SUITE_P(Targets, Mesh, testing::ValuesIn(targets()), target_name);
INSTANTIATE_TEST_SUITE_P(Targets, GoldenMesh, testing::ValuesIn(targets()), target_name);

}  // namespace
}  // namespace dvrlab::test
