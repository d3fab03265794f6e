// The reader of scattered samples: how few make a mesh.
#include "framework/interfaces/mesh.h"
#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

std::string file_of(const std::string& lines) {
  const std::string file = scratch("points.xyz");
  write(file, Bytes(lines.begin(), lines.end()));
  return file;
}

class Points : public testing::Test {
 protected:
  void SetUp() override {
    const auto& all = registry().entries();
    if (std::none_of(all.begin(), all.end(), [](const auto& e) { return e.kind == "data" && e.name == "points"; }))
      GTEST_SKIP() << "not supported: the points plugin is not built (libqhull-dev)";
  }
};

TEST_F(Points, FourMakeOneTetrahedron) {
  const auto mesh = std::dynamic_pointer_cast<const MeshField>(
      load("points", {{"file", file_of("0 0 0 1\n2 0 0 2\n0 3 0 3\n0 0 4 4\n")}}));
  ASSERT_EQ(mesh->cells(), 1u);
  EXPECT_EQ(mesh->shape[0], CellShape::tetrahedron);
  std::vector<double> values = mesh->value;
  std::sort(values.begin(), values.end());
  EXPECT_EQ(values, (std::vector<double>{1, 2, 3, 4}));
}

TEST_F(Points, TooFewAndFlatOnesAreRefused) {
  const auto error = [](const std::string& lines) { return load_error("points", {{"file", file_of(lines)}}); };
  EXPECT_NE(error("0 0 0 1\n1 0 0 2\n0 1 0 3\n").find("holds 3 points; tetrahedra need at least 4"), std::string::npos);
  EXPECT_NE(error("0 0 0 1\n1 0 0 2\n0 1 0 3\n1 1 0 4\n").find("Qhull makes no tetrahedra"), std::string::npos);
}

}  // namespace
}  // namespace dvrlab::test
