// The reader of Exodus II files: kinds of netCDF, variables over time, orders of nodes, faults.
#include <cmath>

#include "framework/interfaces/mesh.h"
#include "tests/data/exodus_writer.h"
#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

std::shared_ptr<const MeshField> load_mesh(const std::string& type, const nlohmann::json& values) {
  return std::dynamic_pointer_cast<const MeshField>(load(type, values));
}

/// Two tetrahedra on one face and a pyramid, in two blocks, and a bar.
ExodusContents small() {
  ExodusContents c;
  c.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {2, 0, 0}, {2, 1, 1}, {3, 0, 1}};
  c.blocks = {{"TETRA", 4, {1, 2, 3, 4, 2, 3, 4, 5}}, {"PYRAMID5", 5, {2, 6, 7, 5, 8}}, {"BAR2", 2, {1, 6}}};
  c.of_points = {"p", "velocity_X", "velocity_Y", "velocity_Z"};
  c.of_cells = {"part", "some"};
  c.absent = {{2, 2}};
  for (int step = 0; step < 2; ++step) {
    const double f = step + 1;
    std::vector<double> p, z(8, 0.0), x, y;
    for (int k = 0; k < 8; ++k) {
      p.push_back(f * (k + 1));
      x.push_back(3 * k);
      y.push_back(4 * k * f);
    }
    c.point_values.push_back({p, x, y, z});
    c.cell_values.push_back({{10 * f, 20 * f, 60 * f, 7}, {1, 2, 3, 4}});
  }
  return c;
}

std::string file_of(const ExodusContents& c, NetcdfKind kind = NetcdfKind::classic) {
  static int count = 0;
  const std::string file = scratch("e" + std::to_string(++count) + ".exo");
  write_exodus(file, c, kind);
  return file;
}

TEST(Exodus, EveryKindOfNetcdf) {
  for (const NetcdfKind kind : {NetcdfKind::classic, NetcdfKind::offset64, NetcdfKind::data64, NetcdfKind::netcdf4}) {
    const auto mesh = load_mesh("exodus", {{"file", file_of(small(), kind)}, {"array", "p"}});
    ASSERT_EQ(mesh->cells(), 3u);
    EXPECT_EQ(mesh->shape[2], CellShape::pyramid);
    EXPECT_EQ(mesh->point[4], (Vector3{1, 1, 1}));
    EXPECT_EQ(mesh->value, (std::vector<double>{2, 4, 6, 8, 10, 12, 14, 16})) << "the last time step";
    EXPECT_TRUE(has_note(*mesh, "time step 1 of 2, t = 0.5"));
    EXPECT_TRUE(has_note(*mesh, "1 cell without a volume"));
  }
}

TEST(Exodus, VariablesAndTimeSteps) {
  const std::string file = file_of(small());
  EXPECT_EQ(load_mesh("exodus", {{"file", file}, {"array", "p"}, {"time_step", 0}})->value[7], 8);
  const nlohmann::json velocity = {{"file", file}, {"array", "velocity"}, {"time_step", 0}};
  auto with = [&](const char* component) {
    nlohmann::json v = velocity;
    v["component"] = component;
    return load_mesh("exodus", v)->value;
  };
  EXPECT_EQ(with("1")[2], 8);
  EXPECT_EQ(with("norm")[2], 10);
  EXPECT_NE(load_error("exodus", velocity).find("has 3 components"), std::string::npos);
  const auto cells = load_mesh("exodus", {{"file", file}, {"array", "part"}});
  EXPECT_EQ(cells->value[0], 20);
  EXPECT_EQ(cells->value[1], (20 + 40 + 120) / 3.0);
  EXPECT_TRUE(has_note(*cells, "averaged"));
  EXPECT_NE(load_error("exodus", {{"file", file}, {"array", "some"}}).find("has no array \"some\""), std::string::npos)
      << "a block has no values of it";
  EXPECT_NE(load_error("exodus", {{"file", file}}).find("several arrays"), std::string::npos);
  EXPECT_NE(load_error("exodus", {{"file", file}, {"array", "p"}, {"time_step", 2}}).find("has 2 time steps, 0 to 1"),
            std::string::npos);
}

// What a curved cell reaches beyond its nodes is said; what is rounding is not.
TEST(Exodus, NotesSayWhatIsRead) {
  const auto part = [](const char* component) {
    return load_mesh(
        "exodus",
        {{"file", DVRLAB_SHIPPED_DATA "/notch_part.exo"}, {"array", "displacement"}, {"component", component}});
  };
  const auto norm = part("norm"), z = part("2");
  EXPECT_TRUE(has_note(*norm, "of 2 arrays, the norm of \"displacement\" is read"));
  EXPECT_TRUE(has_note(*z, "of 2 arrays, component 2 of \"displacement\" is read"));
  EXPECT_FALSE(has_note(*norm, "beyond those of the nodes")) << "6.6e-24 below 0, of a range of 4.3e-7";
  EXPECT_TRUE(has_note(*z, "beyond those of the nodes"));
}

// Exodus and VTK list the middles of edges in different orders: the shipped part of notch_disp.vtu has the cells of the
// whole, node by node.
TEST(Exodus, NodesAreInTheOrderOfVtk) {
  const auto part = load_mesh(
      "exodus", {{"file", DVRLAB_SHIPPED_DATA "/notch_part.exo"}, {"array", "displacement"}, {"component", "norm"}});
  const auto whole = load_mesh("vtu", {{"file", DVRLAB_SHIPPED_DATA "/notch_disp.vtu"}, {"component", "norm"}});
  const auto node = [](const MeshField& m, std::uint64_t cell, std::size_t k) { return m.nodes_of(cell)[k]; };
  int hexahedra = 0, wedges = 0;
  for (std::uint64_t c = 0; c < part->cells(); ++c) {
    const auto count = part->nodes_of(c).size();
    const auto distance = [&](std::uint64_t w) {
      double worst = whole->nodes_of(w).size() == count ? 0 : 1;
      for (std::size_t k = 0; k < count && worst < 1e-4; ++k) {
        const Vector3 &a = part->point[node(*part, c, k)], &b = whole->point[node(*whole, w, k)];
        worst = std::max(worst, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
      }
      return worst;
    };
    std::uint64_t w = 0;
    while (w < whole->cells() && distance(w) > 1e-5) ++w;
    ASSERT_LT(w, whole->cells()) << "cell " << c;
    for (std::size_t k = 0; k < count; ++k)
      EXPECT_NEAR(part->value[node(*part, c, k)], whole->value[node(*whole, w, k)], 1e-9);
    (count == 20 ? hexahedra : wedges) += 1;
  }
  EXPECT_GT(hexahedra, 50);
  EXPECT_EQ(wedges, 4);
}

TEST(Exodus, FaultsAreNamed) {
  const auto error = [](const ExodusContents& c) {
    return load_error("exodus", {{"file", file_of(c)}, {"array", "p"}});
  };
  const auto expect = [&](const ExodusContents& c, const char* words) {
    EXPECT_NE(error(c).find(words), std::string::npos) << error(c);
  };
  ExodusContents c = small();
  c.blocks[0].node[3] = 9;
  expect(c, "\"connect1\" names the point 9 of 8");
  c = small();
  c.blocks[1].type = "HEX";
  expect(c, "block 2, cells of type \"HEX\", has 5 nodes for each");
  c.blocks[1].type = "GEM";
  expect(c, "unknown type \"GEM\"");
  c = small();
  c.axes = 2;
  expect(c, "is of 2 dimensions; a volume has 3");
  c = small();
  c.point_values.clear();
  c.cell_values.clear();
  expect(c, "holds no values");
}

// A download that stopped: in the header, in the names, between two arrays, in the last number.
TEST(Exodus, AFileThatIsCutOffIsSaidToBe) {
  const Bytes whole = read(DVRLAB_SHIPPED_DATA "/notch_part.exo");
  const std::string file = scratch("cut.exo");
  struct Cut {
    std::size_t keep;
    std::string words;
  };
  for (const Cut& cut :
       {Cut{100, "is no netCDF file that can be read"}, Cut{1000, "is no netCDF file that can be read"},
        Cut{whole.size() / 4, "variable \"name_nod_var\" cannot be read"},
        Cut{whole.size() / 2, "variable \"name_nod_var\" cannot be read"},
        Cut{3 * whole.size() / 4, "variable \"time_whole\" cannot be read"},
        Cut{whole.size() - 1, "variable \"vals_elem_var1eb2\" cannot be read"}}) {
    write(file, Bytes(whole.begin(), whole.begin() + long(cut.keep)));
    const std::string message = load_error("exodus", {{"file", file}, {"array", "diagonal"}});
    EXPECT_TRUE(message.starts_with(file)) << message;
    for (const std::string& words : {cut.words, std::string("the file is cut off or damaged")})
      EXPECT_NE(message.find(words), std::string::npos) << cut.keep << " bytes: " << message;
  }
  write(file, whole);
  EXPECT_EQ(load_error("exodus", {{"file", file}, {"array", "diagonal"}}), "");
}

TEST(Exodus, DamagedFilesAreRefused) {
  for (const NetcdfKind kind : {NetcdfKind::classic, NetcdfKind::netcdf4}) {
    const Bytes good = read(file_of(small(), kind));
    const std::string file = scratch("damaged.exo");
    for (std::size_t keep : {std::size_t{3}, std::size_t{40}, good.size() / 3, good.size() / 2}) {
      write(file, Bytes(good.begin(), good.begin() + long(keep)));
      EXPECT_NE(load_error("exodus", {{"file", file}, {"array", "p"}}), "") << keep;
    }
  }
  // netCDF 4.9 does not survive a name of -1 letters (the first dimension's), nor 2^31 dimensions.
  for (const std::size_t at : {std::size_t{16}, std::size_t{12}}) {
    Bytes bytes = read(file_of(small()));
    for (std::size_t k = 0; k < 4; ++k) bytes[at + k] = at == 16 || k > 0 ? '\xff' : '\x7f';
    const std::string damaged = scratch("damaged.exo");
    write(damaged, bytes);
    EXPECT_NE(load_error("exodus", {{"file", damaged}, {"array", "p"}}), "") << at;
  }
  const std::string file = scratch("other.nc");
  write(file,
        Bytes{'C', 'D', 'F', 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_NE(load_error("exodus", {{"file", file}}).find("without the points and blocks of Exodus II"),
            std::string::npos);
}

}  // namespace
}  // namespace dvrlab::test
