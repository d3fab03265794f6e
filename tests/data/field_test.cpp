// Affine maps, paths, the scan of voxels and the nan policy.
#include <cmath>
#include <limits>
#include <random>

#include "framework/scene/gzip.h"
#include "framework/scene/sha256.h"
#include "framework/scene/voxels.h"
#include "tests/data/test_data.h"

namespace dvrlab {
namespace {

std::string error_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Affine, InverseUndoesIt) {
  const Affine a{{0.9, 0.1, -0.3, 0.2, -1.4, 0.05, 0.3, 0.2, 2.5}, {10, -20, 30}};
  const Vector3 x{3, -4, 5}, y = a.inverse().point(a.point(x));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(y[i], x[i], 1e-14);
  const Affine tiny{{1e-6, 0, 0, 0, 1e-6, 0, 0, 0, 1e-6}, {0, 0, 0}};
  EXPECT_NO_THROW(tiny.inverse());
  const Affine flat{{1, 2, 0, 2, 4, 0, 0, 0, 1}, {0, 0, 0}};
  EXPECT_THROW(flat.inverse(), InputError);
}

TEST(ResolvePath, EnvironmentAndFolder) {
  test::write(test::scratch("there.bin"), {'x'});
  const std::string folder = std::filesystem::path(test::scratch("there.bin")).parent_path().string();
  ::setenv("DVRLAB_TEST_FOLDER", folder.c_str(), 1);
  EXPECT_EQ(resolve_path("there.bin", {.base_folder = folder}, "data.file"), folder + "/there.bin");
  EXPECT_EQ(resolve_path("${DVRLAB_TEST_FOLDER}/there.bin", {.base_folder = "/"}, "data.file"), folder + "/there.bin");
  const std::string unset = error_of([] { resolve_path("${DVRLAB_NOT_SET}/x", {}, "data.file"); });
  EXPECT_NE(unset.find("data.file"), std::string::npos);
  EXPECT_NE(unset.find("DVRLAB_NOT_SET"), std::string::npos);
  EXPECT_NE(error_of([&] { resolve_path("gone.bin", {.base_folder = folder}, "data.file"); }).find("gone.bin"),
            std::string::npos);
}

TEST(Sha256, KnownDigest) {
  const std::byte abc[]{std::byte{'a'}, std::byte{'b'}, std::byte{'c'}};
  const std::string digest = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  EXPECT_EQ(sha256({abc}), digest);
  EXPECT_EQ(sha256({std::span(abc).first(1), std::span(abc).last(2)}), digest);
}

GridField float_grid(std::vector<float> v) {
  GridField grid;
  const auto memory = std::make_shared<std::vector<float>>(std::move(v));
  grid.dims = {2, 2, static_cast<int>(memory->size() / 4)};
  grid.type = VoxelType::f32;
  grid.voxels = {memory, memory->data()};
  grid.source = "test";
  return grid;
}

TEST(FinishGrid, RangeOfManyFloats) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::vector<float> v(4 * 400000);
  for (float& x : v) x = normal(random);
  GridField grid = float_grid(v);
  grid.to_world.m = {0.5, 0, 0, 0, 3, 0, 0, 0, 2};
  finish_grid(grid, "error", 0);
  EXPECT_EQ(grid.stored_min, *std::min_element(v.begin(), v.end()));
  EXPECT_EQ(grid.stored_max, *std::max_element(v.begin(), v.end()));
  EXPECT_EQ(grid.voxel, 0.5);
  EXPECT_EQ(grid.sampler, "grid");
}

TEST(FinishGrid, NanPolicy) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const std::vector<float> v{1, 2, 3, 4, 5, nan, 7, -inf};
  GridField grid = float_grid(v);
  const std::string error = error_of([&] { finish_grid(grid, "error", 0); });
  EXPECT_NE(error.find("voxel (1, 0, 1) is NaN"), std::string::npos) << error;
  EXPECT_NE(error.find("nan_policy"), std::string::npos);
  grid.slope = 2;
  grid.intercept = 1;
  finish_grid(grid, "replace", 21);
  EXPECT_EQ(grid.at(1, 0, 1), 10);  // stored, so that the physical value is 21
  EXPECT_EQ(grid.at(1, 1, 1), 10);
  EXPECT_EQ(grid.at(0, 1, 1), 7);
  EXPECT_EQ(grid.stored_max, 10);
  EXPECT_TRUE(test::has_note(grid, "2 voxels"));
}

TEST(FinishGrid, RefusesSingularAffineAndFlatGrids) {
  GridField flat = float_grid({1, 2, 3, 4});
  EXPECT_NE(error_of([&] { finish_grid(flat, "error", 0); }).find("at least 2"), std::string::npos);
  GridField singular = float_grid({1, 2, 3, 4, 5, 6, 7, 8});
  singular.to_world.m[8] = 0;
  EXPECT_NE(error_of([&] { finish_grid(singular, "error", 0); }).find("singular"), std::string::npos);
}

TEST(Voxels, SizesThatOverflow) {
  EXPECT_EQ(grid_bytes({4, 5, 6}, 2, "f"), 240u);
  for (const std::array<long long, 3> dims :
       {std::array{0ll, 5ll, 6ll}, {-3ll, 5ll, 6ll}, {1ll << 31, 2ll, 2ll}, {2000000000ll, 2000000000ll, 2000000000ll}})
    EXPECT_NE(error_of([&] { grid_bytes(dims, 8, "file.x"); }).find("file.x: "), std::string::npos);
}

TEST(Gzip, MembersSkipsAndCuts) {
  const test::Bytes a(3000, 'a'), b(2000, 'b');
  using test::operator+;
  const test::Bytes packed = test::gzip(a) + test::gzip(b);
  const auto in = std::as_bytes(std::span(packed));
  std::vector<std::byte> out(4000);
  EXPECT_EQ(gunzip(in, 500, out, "f"), 4000u);
  EXPECT_EQ(out[2499], std::byte{'a'});
  EXPECT_EQ(out[2500], std::byte{'b'});
  out.resize(9000);
  EXPECT_EQ(gunzip(in, 0, out, "f"), 5000u);
  EXPECT_LT(gunzip(in.first(in.size() - 20), 0, out, "f"), 5000u);
  EXPECT_NE(error_of([&] { gunzip(std::as_bytes(std::span(a)), 0, out, "f"); }).find("damaged"), std::string::npos);
}

}  // namespace
}  // namespace dvrlab
