// VTK ImageData files written by hand: types, codings, compressors, byte orders, geometry, arrays, pieces; real files.
#include <cmath>

#include "tests/data/vti_writer.h"

namespace dvrlab::test {
namespace {

bool have_vti() {
  const auto& all = registry().entries();
  return std::any_of(all.begin(), all.end(), [](const auto& e) { return e.kind == "data" && e.name == "vti"; });
}

class Vti : public testing::Test {
 protected:
  void SetUp() override {
    if (!have_vti())
      GTEST_SKIP() << "not supported: the vti plugin is not built (libexpat1-dev, liblz4-dev, liblzma-dev)";
  }
};

// A new name for every file: the one before may still be mapped.
std::string file_of(const VtiFile& f) {
  static int count = 0;
  const std::string file = scratch("t" + std::to_string(++count) + ".vti");
  write(file, f.bytes());
  return file;
}

std::vector<VtiCoding> codings() {
  std::vector<VtiCoding> all{{.format = "ascii"}};
  for (const std::string compressor : {"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor"})
    for (const bool big : {false, true})
      for (const int word : {4, 8}) {
        all.push_back({.format = "binary", .compressor = compressor, .big_endian = big, .word = word});
        for (const std::string encoding : {"raw", "base64"})
          all.push_back({"appended", encoding, compressor, big, word, word == 4 ? 100u : 64u});
      }
  return all;
}

template <class T>
std::vector<T> numbers(std::size_t count = 24) {
  std::vector<T> v(count);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = static_cast<T>(static_cast<int>(i % 25) * 5 - (std::is_signed_v<T> ? 60 : 0));
  if constexpr (std::is_integral_v<T>) v[7] = std::numeric_limits<T>::max();
  if constexpr (std::is_integral_v<T>) v[8] = std::numeric_limits<T>::lowest();
  if constexpr (std::is_floating_point_v<T>) v[7] = static_cast<T>(1.0 / 3);
  return v;
}

template <class T>
void round_trip(const std::string& type) {
  const std::vector<T> v = numbers<T>();
  for (const VtiCoding& c : codings()) {
    SCOPED_TRACE(type + " " + c.format + " " + c.encoding + " " + c.compressor + (c.big_endian ? " big " : " little ") +
                 std::to_string(c.word));
    // A first array of odd size, so that raw bytes do not lie at multiples of their size.
    const VtiArray odd = vti_array("odd", "UInt8", std::vector<std::uint8_t>(24, 3), c);
    const VtiFile f{c, "0 3 0 2 0 1", "", {{"0 3 0 2 0 1", R"(Scalars="v")", {odd, vti_array("v", type, v, c)}}}};
    const auto grid = load_grid("vti", {{"file", file_of(f)}});
    EXPECT_EQ(grid->dims, (std::array<int, 3>{4, 3, 2}));
    const bool kept = sizeof(T) <= 2 || std::is_same_v<T, float>;
    EXPECT_EQ(grid->bytes(), 24 * (kept ? sizeof(T) : sizeof(float)));
    EXPECT_NE(has_note(*grid, "kept as float32"), kept);
    for (int n = 0; n < 24; ++n) {
      const T x = v[static_cast<std::size_t>(n)];
      EXPECT_EQ(grid->at(n % 4, n / 4 % 3, n / 12),
                kept ? static_cast<double>(x) : static_cast<double>(static_cast<float>(x)));
    }
  }
}

TEST_F(Vti, TypesCodingsCompressorsEndians) {
  round_trip<std::int8_t>("Int8");
  round_trip<std::uint8_t>("UInt8");
  round_trip<std::int16_t>("Int16");
  round_trip<std::uint16_t>("UInt16");
  round_trip<std::int32_t>("Int32");
  round_trip<std::uint32_t>("UInt32");
  round_trip<std::int64_t>("Int64");
  round_trip<std::uint64_t>("UInt64");
  round_trip<float>("Float32");
  round_trip<double>("Float64");
}

VtiFile small(const std::string& grid = "", const std::string& extent = "0 3 0 2 0 1") {
  const VtiCoding c;
  return {c, extent, grid, {{extent, "", {vti_array("v", "UInt8", numbers<std::uint8_t>(), c)}}}};
}

TEST_F(Vti, Geometry) {
  const auto at = [](const VtiFile& f, const Vector3& index) {
    return world(*load("vti", {{"file", file_of(f)}}), index);
  };
  const std::string placed = R"(Origin="10 20 30" Spacing="0.5 2 4" )";
  EXPECT_EQ(at(small(), {3, 2, 1}), (Vector3{3, 2, 1}));
  EXPECT_EQ(at(small(placed), {3, 2, 1}), (Vector3{11.5, 24, 34}));
  // A quarter turn about z; the origin is the place of point (0, 0, 0), which the extent need not hold.
  EXPECT_EQ(at(small(placed + R"(Direction="0 -1 0 1 0 0 0 0 1")"), {3, 2, 1}), (Vector3{6, 21.5, 34}));
  EXPECT_EQ(at(small(placed, "-2 1 5 7 1 2"), {0, 0, 0}), (Vector3{9, 30, 34}));
  const auto field = load("vti", {{"file", file_of(small(placed))}});
  EXPECT_FALSE(field->anatomical);
  EXPECT_EQ(field->length_unit, "");
  EXPECT_TRUE(has_note(*field, "file's own coordinates"));
}

TEST_F(Vti, ArraysAndComponents) {
  for (const VtiCoding& c : codings()) {
    VtiFile f = small();
    f.coding = c;
    const auto two = vti_array("one", "UInt8", std::vector<std::uint8_t>(24, 7), c);
    const auto vector = vti_array("v3", "Int16", numbers<std::int16_t>(72), c, 3);
    f.pieces[0].arrays = {two, vector};
    f.pieces[0].point_data = R"(Scalars="one")";
    const std::string file = file_of(f);
    EXPECT_EQ(load_grid("vti", {{"file", file}})->at(1, 1, 1), 7);
    for (const int component : {0, 1, 2}) {
      const auto grid = load_grid("vti", {{"file", file}, {"array", "v3"}, {"component", component}});
      const auto all = numbers<std::int16_t>(72);
      for (int n = 0; n < 24; ++n)
        EXPECT_EQ(grid->at(n % 4, n / 4 % 3, n / 12), all[static_cast<std::size_t>(3 * n + component)]);
      EXPECT_TRUE(has_note(*grid, "component " + std::to_string(component) + " of 3"));
    }
  }
}

TEST_F(Vti, PiecesArePutTogether) {
  for (const VtiCoding& c : codings()) {
    // 0 .. 3 in x, cut at x = 2: the points of the cut stand in both pieces.
    const auto v = numbers<std::int16_t>();
    std::vector<std::int16_t> left, right;
    for (std::size_t n = 0; n < 24; ++n) {
      if (n % 4 <= 2) left.push_back(v[n]);
      if (n % 4 >= 2) right.push_back(v[n]);
    }
    const VtiFile f{c,
                    "0 3 0 2 0 1",
                    "",
                    {{"2 3 0 2 0 1", "", {vti_array("v", "Int16", right, c)}},
                     {"0 2 0 2 0 1", "", {vti_array("v", "Int16", left, c)}}}};
    const auto grid = load_grid("vti", {{"file", file_of(f)}});
    for (int n = 0; n < 24; ++n) EXPECT_EQ(grid->at(n % 4, n / 4 % 3, n / 12), v[static_cast<std::size_t>(n)]);
    EXPECT_TRUE(has_note(*grid, "2 pieces"));
  }
}

// VTK writes these elements into arrays, in front of the numbers or behind them.
TEST_F(Vti, InformationKeysAreNoNumbers) {
  const std::string key = R"(<InformationKey name="L2" length="1"><Value index="0">99</Value></InformationKey>)";
  for (const bool front : {true, false}) {
    VtiFile f = small();
    std::string& text = f.pieces[0].arrays[0].text;
    text = front ? key + text : text + key;
    EXPECT_EQ(load_grid("vti", {{"file", file_of(f)}})->at(1, 0, 0), 5);
  }
}

TEST_F(Vti, BytesNeeded) {
  const auto& plugin = registry().get<DataPlugin>("data", "vti");
  const auto needed = [&](const VtiCoding& c, int components) {
    VtiFile f = small();
    f.coding = c;
    f.pieces[0].arrays = {
        vti_array("v", "Float64", numbers<double>(24 * static_cast<std::size_t>(components)), c, components)};
    return plugin.bytes_needed(
        parameters("data", "vti", {{"file", file_of(f)}, {"component", components == 1 ? -1 : 1}}), {});
  };
  const VtiCoding raw{.format = "appended"}, packed{.format = "appended", .compressor = "vtkZLibDataCompressor"};
  EXPECT_EQ(needed(raw, 1), 24u * 4);                         // float32 of doubles in the mapped file
  EXPECT_EQ(needed(packed, 1), 24u * 8 + 24u * 4);            // decompressed first
  EXPECT_EQ(needed(packed, 3), 72u * 8 + 24u * 8 + 24u * 4);  // then the component cut out
}

TEST_F(Vti, Recognises) {
  const auto& plugin = registry().get<DataPlugin>("data", "vti");
  const auto recognises = [&](const std::string& path, const std::string& start) {
    return plugin.recognises(path, std::as_bytes(std::span(start)));
  };
  EXPECT_TRUE(recognises("a.vti", "anything"));
  EXPECT_TRUE(recognises("a.VTI", "anything"));
  EXPECT_TRUE(recognises("a.xml", R"(<?xml version="1.0"?><VTKFile type="ImageData" version="0.1">)"));
  EXPECT_FALSE(recognises("a.vtu", R"(<VTKFile type="UnstructuredGrid">)"));
  std::filesystem::create_directories(scratch("folder.vti"));
  EXPECT_FALSE(recognises(scratch("folder.vti"), ""));
  EXPECT_TRUE(recognises("empty.vti", "")) << "to say that it is empty";
  EXPECT_FALSE(recognises("a", "NRRD0004"));
}

// Written by VTK 9.1.
TEST_F(Vti, ShippedFile) {
  const std::string file = DVRLAB_SHIPPED_DATA "/torus.vti";
  const auto grid = load_grid("vti", {{"file", file}});
  EXPECT_EQ(grid->type, VoxelType::i8);
  EXPECT_EQ(grid->dims, (std::array<int, 3>{20, 20, 20}));
  const auto z = load_grid("vti", {{"file", file}, {"array", "gradient"}, {"component", 2}});
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 20; ++i) {
        const Vector3 x = world(*grid, {double(i), double(j), double(k)});
        const double q = std::hypot(x[0], x[1]) - 0.6, r = std::hypot(q, x[2]);
        EXPECT_NEAR(grid->at(i, j, k), 100 * (r - 0.25), 0.51);  // rounded to whole numbers
        EXPECT_NEAR(z->at(i, j, k), 100 * x[2] / r, 0.51);
      }
}

TEST_F(Vti, SameVoxelsAsNrrd) {
  const std::string file = shared_data("volumes/engine.vti");
  if (file.empty()) GTEST_SKIP() << "not supported: no data: volumes/engine.vti";
  const auto a = load_grid("vti", {{"file", file}}),
             b = load_grid("nrrd", {{"file", DVRLAB_SHIPPED_DATA "/engine.nrrd"}});
  ASSERT_EQ(a->bytes(), b->bytes());
  EXPECT_EQ(std::memcmp(a->voxels.get(), b->voxels.get(), a->bytes()), 0);
}

}  // namespace
}  // namespace dvrlab::test
