// The `my_data` reader: what it reads, and what it refuses with one error that names the file.
#include <fstream>

#include "framework/interfaces/field.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

std::string written(const std::string& text) {
  const std::string file = testing::TempDir() + "/my_data_test.txt";
  std::ofstream(file) << text;
  return file;
}

std::shared_ptr<const Field> load(const std::string& text, const std::vector<double>& spacing = {1, 1, 1}) {
  const PluginDescriptor& d = *registry().find("data", "my_data").descriptor;
  const ParameterSet values("data", {d.parameters, d.parameters + d.parameter_count},
                            {{"file", written(text)}, {"spacing", spacing}});
  return registry().get<DataPlugin>("data", "my_data").load(values, LoadContext{});
}

std::string refusal(const std::string& text) {
  try {
    load(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(MyData, ReadsNumbersXFastest) {
  const auto field = load("TEXTVOL 3 2 2\n0 1 2  3 4 5\n6 7 8  9 10 11\n", {1, 2, 3});
  const auto& grid = dynamic_cast<const GridField&>(*field);
  EXPECT_EQ(grid.at(2, 0, 0), 2);
  EXPECT_EQ(grid.at(1, 1, 1), 10);
  EXPECT_EQ(grid.stored_max, 11);
  EXPECT_EQ(grid.to_world.point({2, 1, 1}), (Vector3{2, 2, 3}));
}

TEST(MyData, RefusesWhatIsWrong) {
  EXPECT_EQ(refusal("TEXTVOL 2 2 2\n0 1 2 3 4 5 6 7\n"), "") << "the control: this one is right";
  EXPECT_NE(refusal("TEXTVOLUME 2 2 2\n").find("must begin with TEXTVOL"), std::string::npos);
  EXPECT_NE(refusal("TEXTVOL 2 2 1\n0 1 2 3\n").find("found 1 grid points"), std::string::npos);
  EXPECT_NE(refusal("TEXTVOL 2 2 2\n0 1 2 3 4 5 6\n").find("found 7 numbers; the header promises 8"),
            std::string::npos);
  EXPECT_NE(refusal("TEXTVOL 4000 4000 4000\n0 1\n").find("found fewer numbers"), std::string::npos);
  EXPECT_NE(refusal("TEXTVOL 2 2 2\n0 1 2 3 4 5 6 7 8\n").find("behind the last number"), std::string::npos);
}

}  // namespace
}  // namespace dvrlab::test
