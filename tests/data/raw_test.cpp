// Raw files: every declared type, order and skip; what is refused, with the declarations that would fit.
#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

json declared(const std::string& type, const json& more = json::object()) {
  json values{{"file", scratch("t.raw")}, {"size", {4, 3, 2}}, {"voxel_type", type}};
  values.update(more);
  return values;
}

template <class T>
void round_trip(const std::string& type) {
  std::vector<T> v(24);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = static_cast<T>(static_cast<int>(i) * 5 - (std::is_signed_v<T> ? 60 : 0));
  for (const bool big : {false, true}) {
    SCOPED_TRACE(type + (big ? " big" : " little"));
    write(scratch("t.raw"), bytes_of_numbers(v, big));
    const auto grid = load_grid("raw", declared(type, {{"byte_order", big ? "big" : "little"}}));
    EXPECT_EQ(grid->dims, (std::array<int, 3>{4, 3, 2}));
    for (int n = 0; n < 24; ++n)
      EXPECT_EQ(grid->at(n % 4, n / 4 % 3, n / 12), static_cast<double>(v[static_cast<std::size_t>(n)]));
  }
}

TEST(Raw, TypesAndEndians) {
  round_trip<std::int8_t>("int8");
  round_trip<std::uint8_t>("uint8");
  round_trip<std::int16_t>("int16");
  round_trip<std::uint16_t>("uint16");
  round_trip<std::int32_t>("int32");
  round_trip<std::uint32_t>("uint32");
  round_trip<std::int64_t>("int64");
  round_trip<std::uint64_t>("uint64");
  round_trip<float>("float32");
  round_trip<double>("float64");
}

TEST(Raw, PlaceAndScale) {
  write(scratch("t.raw"), Bytes(24, 7));
  const auto grid = load_grid(
      "raw", declared("uint8", {{"spacing", {2, 3, 4}}, {"origin", {10, 20, 30}}, {"slope", 0.5}, {"intercept", -1}}));
  EXPECT_EQ(world(*grid, {1, 1, 1}), (Vector3{12, 23, 34}));
  EXPECT_EQ(grid->slope, 0.5);
  EXPECT_EQ(grid->intercept, -1);
  EXPECT_FALSE(grid->anatomical);
  EXPECT_EQ(grid->voxel, 2);
}

TEST(Raw, AnExplicitSkipTakesOneVolumeOutOfMany) {
  Bytes two(48, 1);
  std::fill(two.begin() + 24, two.end(), 2);
  write(scratch("t.raw"), two);
  const auto first = load_grid("raw", declared("uint8", {{"skip_bytes", 0}}));
  EXPECT_EQ(first->at(0, 0, 0), 1);
  EXPECT_TRUE(has_note(*first, "24 bytes behind the voxels"));
  EXPECT_EQ(load_grid("raw", declared("uint8", {{"skip_bytes", 24}}))->at(0, 0, 0), 2);
}

TEST(Raw, AnOddSkipOfWideVoxelsIsCopied) {
  std::vector<float> v(24, 2.5f);
  write(scratch("t.raw"), "abc" + bytes_of_numbers(v, false));
  EXPECT_EQ(load_grid("raw", declared("float32", {{"skip_bytes", 3}}))->at(3, 2, 1), 2.5);
}

TEST(Raw, AWrongSizeNamesWhatWouldFit) {
  const auto error = [](std::size_t bytes, const json& values) {
    write(scratch("t.raw"), Bytes(bytes, 3));
    return load_error("raw", values);
  };
  const std::vector<std::tuple<std::size_t, json, std::string>> bad{
      {48, declared("uint8"),
       "4x3x2 uint8 needs 24 bytes, the file has 48; voxel_type int16 or uint16, or size [4, 3, 4]"},
      {48, declared("uint8"), "or skip_bytes 24 if the voxels are the file's end would fit"},
      {24, declared("float32"), "needs 96 bytes, the file has 24; voxel_type int8 or uint8 would fit"},
      {64, declared("uint8"), "size [4, 4, 4]"},
      {36, declared("uint8"), "size [4, 3, 3]"},
      {25, declared("uint8", {{"skip_bytes", 2}}), "23 of them behind the 2 skipped ones; no voxel_type fits"},
      {23, declared("uint8"), "needs 24 bytes, the file has 23; no voxel_type fits this size"},
      {24, declared("uint8", {{"skip_bytes", 1000000000000}}), "0 of them behind"},
      {0, declared("uint8"), "is empty"},
      {24, declared("float64", {{"size", {2147483647, 2147483647, 2147483647}}}), "data.size: the dimensions"},
      {24, declared("uint8", {{"size", {1, 24, 1}}}), "at least 2"},
      {24, declared("uint8", {{"slope", 0}}), "data.slope: is 0"},
      {24, declared("uint8", {{"skip_bytes", -1}}), "data.skip_bytes: -1 must be null or a whole number"},
      {24, declared("uint8", {{"skip_bytes", "x"}}), "data.skip_bytes"},
      {24, declared("uint8", {{"file", scratch("gone.raw")}}), "there is no file"},
      {24, declared("uint8", {{"file", scratch(".")}}), "is no regular file"}};
  for (const auto& [bytes, values, part] : bad) {
    const std::string text = error(bytes, values);
    EXPECT_NE(text.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << text << '"';
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
  write(scratch("t.raw"), gzip(Bytes(24, 3)));
  EXPECT_NE(load_error("raw", declared("uint8")).find("is compressed by gzip: decompress it"), std::string::npos);
}

TEST(Raw, NumbersThatAreNotFinite) {
  std::vector<float> v(24, 1);
  v[13] = std::numeric_limits<float>::infinity();
  write(scratch("t.raw"), bytes_of_numbers(v, false));
  EXPECT_NE(load_error("raw", declared("float32")).find("voxel (1, 0, 1) is infinite"), std::string::npos);
}

TEST(Raw, NothingIsAllocatedForAMappedFile) {
  write(scratch("t.raw"), Bytes(48, 3));
  const auto& plugin = registry().get<DataPlugin>("data", "raw");
  const auto needed = [&](const json& values) { return plugin.bytes_needed(parameters("data", "raw", values), {}); };
  EXPECT_EQ(needed(declared("int16")), 0u);
  EXPECT_EQ(needed(declared("int16", {{"byte_order", "big"}})), 48u);
}

}  // namespace
}  // namespace dvrlab::test
