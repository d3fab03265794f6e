// Readers of unstructured grids: codings, shapes, arrays, faults, real files.
#include <cmath>
#include <numeric>

#include "framework/interfaces/mesh.h"
#include "framework/scene/mesh/elements.h"
#include "framework/scene/mesh/tetrahedra.h"
#include "tests/data/vti_writer.h"

namespace dvrlab::test {
namespace {

std::shared_ptr<const MeshField> load_mesh(const std::string& type, const nlohmann::json& values) {
  return std::dynamic_pointer_cast<const MeshField>(load(type, values));
}

/// Two tetrahedra on one face, as a .vtu file.
Bytes two_tetrahedra(const VtiCoding& c, bool cell_data = false) {
  VtkXmlWriter out(c, "UnstructuredGrid");
  out.text("<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<PointData Scalars=\"v\">\n");
  out.array(vti_array<float>("v", "Float32", {1, 2, 3, 4, 5}, c));
  out.array(vti_array<double>("u", "Float64", {3, 4, 0, 0, 0, 0, 1, 2, 2, 0, 0, 1, 5, 0, 12}, c, 3));
  out.text("</PointData>\n<CellData>\n");
  if (cell_data) out.array(vti_array<std::int16_t>("part", "Int16", {10, 20}, c));
  out.text("</CellData>\n<Points>\n");
  out.array(vti_array<double>("Points", "Float64", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, c, 3));
  out.text("</Points>\n<Cells>\n");
  out.array(vti_array<std::int64_t>("connectivity", "Int64", {0, 1, 2, 3, 1, 2, 3, 4}, c));
  out.array(vti_array<std::int64_t>("offsets", "Int64", {4, 8}, c));
  out.array(vti_array<std::uint8_t>("types", "UInt8", {10, 10}, c));
  out.text("</Cells>\n</Piece>\n</UnstructuredGrid>\n");
  return out.finish();
}

std::string file_of(const std::string& end, const Bytes& bytes) {
  static int count = 0;
  const std::string file = scratch("m" + std::to_string(++count) + end);
  write(file, bytes);
  return file;
}

TEST(Vtu, EveryCoding) {
  std::vector<VtiCoding> all{{.format = "ascii"}};
  for (const std::string compressor : {"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor"})
    for (const bool big : {false, true})
      for (const int word : {4, 8}) {
        all.push_back({.format = "binary", .compressor = compressor, .big_endian = big, .word = word});
        for (const std::string encoding : {"raw", "base64"})
          all.push_back({"appended", encoding, compressor, big, word, word == 4 ? 100u : 64u});
      }
  for (const VtiCoding& c : all) {
    SCOPED_TRACE(c.format + " " + c.encoding + " " + c.compressor + (c.big_endian ? " big " : " little ") +
                 std::to_string(c.word));
    const auto mesh = load_mesh("vtu", {{"file", file_of(".vtu", two_tetrahedra(c))}});
    ASSERT_EQ(mesh->cells(), 2u);
    EXPECT_EQ(mesh->point[4], (Vector3{1, 1, 1}));
    EXPECT_EQ(mesh->value, (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh->sampler, "mesh");
    EXPECT_DOUBLE_EQ(mesh->slope * mesh->stored_max + mesh->intercept, 5);
  }
}

TEST(Vtu, ArraysAndComponents) {
  const std::string file = file_of(".vtu", two_tetrahedra({}, true));
  EXPECT_EQ(load_mesh("vtu", {{"file", file}, {"array", "u"}, {"component", "norm"}})->value,
            (std::vector<double>{5, 0, 3, 1, 13}));
  EXPECT_EQ(load_mesh("vtu", {{"file", file}, {"array", "u"}, {"component", "2"}})->value,
            (std::vector<double>{0, 0, 2, 1, 12}));
  const auto cells = load_mesh("vtu", {{"file", file}, {"array", "part"}});
  EXPECT_EQ(cells->value, (std::vector<double>{10, 15, 15, 15, 20}));
  EXPECT_TRUE(has_note(*cells, "averaged"));
  EXPECT_NE(load_error("vtu", {{"file", file}, {"array", "w"}}).find("has no array \"w\""), std::string::npos);
  EXPECT_NE(load_error("vtu", {{"file", file}, {"array", "u"}}).find("\"norm\""), std::string::npos);
  EXPECT_NE(load_error("vtu", {{"file", file}, {"array", "u"}, {"component", "3"}}).find("\"0\" to \"2\""),
            std::string::npos);
}

TEST(Vtu, DamagedFilesAreRefused) {
  const Bytes good = two_tetrahedra({.format = "appended"});
  for (std::size_t keep : {std::size_t{40}, good.size() / 3, good.size() / 2, good.size() - 80}) {
    const std::string error =
        load_error("vtu", {{"file", file_of(".vtu", Bytes(good.begin(), good.begin() + long(keep)))}});
    EXPECT_NE(error, "") << keep;
  }
  const auto changed = [&](const std::string& from, const std::string& to) {
    const Bytes ascii = two_tetrahedra({});
    std::string text(ascii.begin(), ascii.end());
    text.replace(text.find(from), from.size(), to);
    return load_error("vtu", {{"file", file_of(".vtu", Bytes(text.begin(), text.end()))}});
  };
  EXPECT_NE(changed("1 2 3 4 \n", "1 2 3 9 \n").find("names the point 9; there are 5"), std::string::npos);
  EXPECT_NE(changed("10 10 ", "10 42 ").find("a polyhedron (VTK type 42)"), std::string::npos);
  EXPECT_NE(changed("4 8 ", "5 8 ").find("has 5 nodes; it needs 4"), std::string::npos);
  EXPECT_NE(changed("4 8 ", "4 3 "), "");
  EXPECT_NE(changed("\"UnstructuredGrid\"", "\"PolyData\"").find("only UnstructuredGrid is read"), std::string::npos);
}

std::string legacy(const std::string& cells, const std::string& types, const std::string& data) {
  return "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n"
         "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\n" +
         cells + types + data;
}
const std::string scalars = "POINT_DATA 8\nSCALARS s double 1\nLOOKUP_TABLE default\n0 1 2 3 4 5 6 7\n";

TEST(Vtk, Sections) {
  const std::string cells = "CELLS 1 9\n8 0 1 2 3 4 5 6 7\n", types = "CELL_TYPES 1\n11\n";
  const std::string more =
      "METADATA\nINFORMATION 0\n\nVECTORS a%20b float\n1 2 2 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 3 4\n"
      "CELL_DATA 1\nFIELD f 2\np 1 1 int\n7\nq 2 1 double\n0.5 1.5\n";
  const std::string text = legacy(cells, types, scalars + more);
  const std::string file = file_of(".vtk", Bytes(text.begin(), text.end()));
  const auto voxel = load_mesh("vtk", {{"file", file}});
  ASSERT_EQ(voxel->cells(), 1u);
  EXPECT_EQ(voxel->shape[0], CellShape::hexahedron);
  EXPECT_EQ(voxel->faults.inverted_cells, 0u) << "a voxel's order is not a hexahedron's";
  EXPECT_NEAR(evaluate(element_of(*voxel, 0), {0.25, 0.5, 1})[3], 0.25 + 2 * 0.5 + 4, 1e-12);
  EXPECT_DOUBLE_EQ(load_mesh("vtk", {{"file", file}, {"array", "q"}, {"component", "1"}})->value[3], 1.5);
  // Version 5.1.
  const std::string v5 =
      legacy("CELLS 2 8\nOFFSETS vtktypeint64\n0 8\nCONNECTIVITY vtktypeint64\n0 1 2 3 4 5 6 7\n", types, scalars);
  EXPECT_EQ(load_mesh("vtk", {{"file", file_of(".vtk", Bytes(v5.begin(), v5.end()))}})->value[7], 7);
  for (const std::string& bad :
       {legacy("CELLS 1 9\n8 0 1 2 3 4 5 6 70\n", types, scalars), legacy(cells, "", scalars), legacy(cells, types, ""),
        legacy("CELLS 1 4\n8 0 1 2\n", types, scalars), legacy(cells, types, scalars + "SURPRISE x\n"),
        legacy(cells, types, scalars).substr(0, 150)})
    EXPECT_NE(load_error("vtk", {{"file", file_of(".vtk", Bytes(bad.begin(), bad.end()))}}), "") << bad;
}

TEST(Vtk, FaultsAreCountedAndMended) {
  // A tetrahedron twice, one inverted, one flat, one collapsed, one with points of its own in the same places.
  const std::string text =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 13 float\n"
      "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1 2 0 0 9 9 9  0 0 0 1 0 0 0 1 0 0 0 -1  5 5 5 0.5 0.5 0\n"
      "CELLS 7 35\n4 0 1 2 3\n4 3 2 1 0\n4 1 3 2 4\n4 0 1 2 12\n4 0 1 1 2\n4 7 8 9 10\n4 1 2 3 4\n"
      "CELL_TYPES 7\n10\n10\n10\n10\n10\n10\n10\n"
      "POINT_DATA 13\nSCALARS s float\nLOOKUP_TABLE default\n0 1 2 3 4 5 6 0 1 2 7 8 9\n";
  const auto mesh = load_mesh("vtk", {{"file", file_of(".vtk", Bytes(text.begin(), text.end()))}});
  EXPECT_EQ(mesh->faults.duplicate_cells, 2u);
  EXPECT_EQ(mesh->faults.collapsed_cells, 1u);
  EXPECT_EQ(mesh->faults.flat_cells, 1u);
  EXPECT_EQ(mesh->faults.inverted_cells, 2u) << "(1 3 2 4) and the one below";
  EXPECT_EQ(mesh->faults.merged_points, 3u);
  EXPECT_EQ(mesh->faults.unused_points, 3u);
  EXPECT_EQ(mesh->cells(), 4u);
  EXPECT_TRUE(has_note(*mesh, "inverted"));
}

TEST(Meshes, ShapeFunctionsAreTheirNodes) {
  // Any values and any bent cell: the polynomial has them at the nodes.
  for (int s = 0; s < cell_shapes; ++s) {
    const auto shape = static_cast<CellShape>(s);
    MeshField mesh;
    std::vector<std::uint32_t> nodes(static_cast<std::size_t>(info_of(shape).nodes));
    std::iota(nodes.begin(), nodes.end(), 0u);
    for (const std::uint32_t n : nodes) {
      Vector3 x = reference_node(shape, static_cast<int>(n));
      for (std::size_t a = 0; a < 3; ++a) x[a] += 0.05 * std::sin(3.0 * n + 2.0 * static_cast<double>(a));
      mesh.point.push_back(x);
      mesh.value.push_back(std::cos(7.0 * n));
    }
    mesh.add_cell(shape, nodes);
    const Element4 e = element_of(mesh, 0);
    for (const std::uint32_t n : nodes) {
      const auto at = evaluate(e, reference_node(shape, static_cast<int>(n)));
      for (std::size_t a = 0; a < 3; ++a) EXPECT_NEAR(at[a], mesh.point[n][a], 1e-12) << info_of(shape).name << n;
      EXPECT_NEAR(at[3], mesh.value[n], 1e-12) << info_of(shape).name << n;
    }
    // And its gradient is that of differences.
    const Vector3 centre = reference_centre(shape);
    const auto d = derivatives(e, centre);
    constexpr double h = 1e-5;
    for (std::size_t a = 0; a < 3; ++a) {
      Vector3 up = centre, down = centre;
      up[a] += h;
      down[a] -= h;
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_NEAR(d[a][c], (evaluate(e, up)[c] - evaluate(e, down)[c]) / (2 * h), 1e-8) << info_of(shape).name;
    }
  }
}

TEST(Meshes, TetrahedraFillTheirCellsAndShareFaces) {
  for (const char* cells :
       {"tetrahedra5", "tetrahedra6", "hexahedra", "wedges", "pyramids", "tetrahedra10", "hexahedra20", "wedges15"}) {
    const auto mesh =
        load_mesh("procedural", {{"evaluate", "mesh"}, {"cells", cells}, {"size", {4, 5, 6}}, {"jitter", 0.2}});
    const Tetrahedra t = tetrahedra_of(*mesh);
    double volume = 0;
    for (const auto& v : t.vertex) {
      const auto at = [&](std::size_t k) -> const Vector3& { return mesh->point[static_cast<std::size_t>(v[k])]; };
      volume += std::abs(volume6(at(0), at(1), at(2), at(3))) / 6;
    }
    EXPECT_NEAR(volume, 8, 1e-9) << cells;
    EXPECT_EQ(t.boundary.size(), 2u * 2u * (3 * 4 + 4 * 5 + 3 * 5)) << cells;
    EXPECT_EQ(t.crowded_faces, 0u);
    EXPECT_EQ(mesh->faults.inverted_cells, 0u) << cells;
    for (std::size_t j = 0; j < t.vertex.size(); ++j)
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t n = t.neighbour[j][k];
        if (n >= 0) {
          const auto& back = t.neighbour[static_cast<std::size_t>(n)];
          EXPECT_EQ(std::count(back.begin(), back.end(), static_cast<std::int32_t>(j)), 1) << cells;
        }
      }
  }
}

TEST(Meshes, RealFiles) {
  const std::string folder = std::string(DVRLAB_SHIPPED_DATA) + "/";
  struct File {
    const char *reader, *name;
    std::uint64_t cells, points;
    const char* sampler;
  };
  for (const File& f :
       {File{"vtu", "bluntfin_tets.vtu", 187395, 40960, "mesh"}, File{"vtk", "CylinderLinear.vtk", 1522, 465, "mesh"},
        File{"vtk", "CylinderQuadratic.vtk", 1522, 2814, "curved_mesh"},
        File{"vtu", "disk_out_ref.vtu", 7472, 8499, "curved_mesh"},
        File{"vtu", "notch_disp.vtu", 2192, 12717, "curved_mesh"}}) {
    nlohmann::json values = {{"file", folder + f.name}};
    if (f.name == std::string("disk_out_ref.vtu")) values["array"] = "Temp";
    if (f.name == std::string("notch_disp.vtu")) values["component"] = "norm";
    if (f.name == std::string("CylinderLinear.vtk")) values["array"] = "vel_norm";
    if (f.name == std::string("CylinderQuadratic.vtk")) values["array"] = "pressure";
    const auto mesh = load_mesh(f.reader, values);
    EXPECT_EQ(mesh->cells() + mesh->faults.collapsed_cells, f.cells) << f.name;
    EXPECT_LE(mesh->point.size(), f.points) << f.name;
    EXPECT_EQ(mesh->sampler, f.sampler) << f.name;
    // The blunt fin's grid folds at the axis: points coincide there.
    EXPECT_EQ(mesh->faults.collapsed_cells, f.name == std::string("bluntfin_tets.vtu") ? 77u : 0u) << f.name;
    EXPECT_EQ(mesh->faults.flat_cells, 0u) << f.name;
    for (const std::string& note : mesh->notes) std::printf("%s: %s\n", f.name, note.c_str());
    std::printf("%s: bend %.3g, %zu boundary faces\n", f.name, largest_bend(*mesh),
                tetrahedra_of(*mesh).boundary.size());
  }
}

}  // namespace
}  // namespace dvrlab::test
