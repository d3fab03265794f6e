// Every type, byte order and encoding, attached and detached; affine maps; bad input; shipped and real files.
#include <cmath>

#include "framework/scene/sha256.h"
#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

struct Written {
  std::string type, encoding;
  bool big_endian, detached;
};

// 4 x 3 x 2 numbers with both signs and the extremes of T.
template <class T>
std::vector<T> numbers() {
  std::vector<T> v(24);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = static_cast<T>(static_cast<int>(i) * 5 - (std::is_signed_v<T> ? 60 : 0));
  v[7] = std::numeric_limits<T>::max();
  v[8] = std::numeric_limits<T>::lowest();
  return v;
}

std::string header(const std::string& type, const std::string& rest) {
  return "NRRD0004\n# written by a test\ntype: " + type + "\ndimension: 3\nsizes: 4 3 2\n" + rest;
}

template <class T>
Bytes encoded(const std::string& encoding, const std::vector<T>& v, const Bytes& raw) {
  if (encoding == "gzip") return gzip(raw);
  if (encoding == "gz") return zlib(raw);
  if (encoding.starts_with("bz")) return bzip2(raw);
  if (encoding == "hex") return hex(raw);
  return encoding == "raw" ? raw : ascii(v);
}

template <class T>
void round_trip(const Written& w) {
  std::vector<T> v = numbers<T>();
  if constexpr (std::is_same_v<T, double>) v[7] = 1e30, v[8] = -1.0 / 3;
  const Bytes data = encoded(w.encoding, v, bytes_of_numbers(v, w.big_endian));
  std::string text =
      header(w.type, "endian: " + std::string(w.big_endian ? "big" : "little") + "\nencoding: " + w.encoding + "\n");
  const std::string file = scratch(w.detached ? "t.nhdr" : "t.nrrd");
  if (w.detached) {
    write(scratch("t.bin"), data);
    write(file, (text + "data file: ./t.bin\n") + Bytes());
  } else {
    write(file, (text + "key:=value\n\n") + data);
  }
  const auto grid = load_grid("nrrd", {{"file", file}});
  const bool kept = sizeof(T) <= 2 || std::is_same_v<T, float>;
  EXPECT_EQ(grid->dims, (std::array<int, 3>{4, 3, 2}));
  EXPECT_EQ(grid->bytes(), 24 * (kept ? sizeof(T) : sizeof(float)));
  EXPECT_NE(has_note(*grid, "kept as float32"), kept);
  for (int n = 0; n < 24; ++n) {
    const T x = v[static_cast<std::size_t>(n)];
    EXPECT_EQ(grid->at(n % 4, n / 4 % 3, n / 12),
              kept ? static_cast<double>(x) : static_cast<double>(static_cast<float>(x)));
  }
  const auto& [lo, hi] = std::minmax_element(v.begin(), v.end());
  EXPECT_EQ(grid->stored_min, static_cast<double>(static_cast<float>(*lo)));
  EXPECT_EQ(grid->stored_max, static_cast<double>(static_cast<float>(*hi)));
  EXPECT_EQ(grid->sha256.size(), 64u);
}

TEST(Nrrd, TypesEndiansEncodings) {
  for (const bool big : {false, true})
    for (const bool detached : {false, true})
      for (const std::string encoding : {"raw", "gzip", "gz", "bzip2", "bz2", "ascii", "text", "txt", "hex"}) {
        SCOPED_TRACE(encoding + (big ? " big" : " little") + (detached ? " detached" : " attached"));
        round_trip<std::int8_t>({"signed char", encoding, big, detached});
        round_trip<std::uint8_t>({"uchar", encoding, big, detached});
        round_trip<std::int16_t>({"short", encoding, big, detached});
        round_trip<std::uint16_t>({"uint16", encoding, big, detached});
        round_trip<std::int32_t>({"int", encoding, big, detached});
        round_trip<std::uint32_t>({"unsigned int", encoding, big, detached});
        round_trip<std::int64_t>({"long long int", encoding, big, detached});
        round_trip<std::uint64_t>({"uint64_t", encoding, big, detached});
        round_trip<float>({"float", encoding, big, detached});
        round_trip<double>({"double", encoding, big, detached});
      }
}

std::string small(const std::string& rest, Bytes data = Bytes(24, 'x')) {
  const std::string file = scratch("small.nrrd");
  write(file, header("uint8", rest + "encoding: raw\n\n") + data);
  return file;
}

TEST(Nrrd, RoundingErrorIsSaid) {
  const std::string file = scratch("big.nrrd");
  std::vector<std::int32_t> v(24, 5);
  v[3] = (1 << 24) + 1;
  write(file, header("int", "endian: little\nencoding: raw\n\n") + bytes_of_numbers(v, false));
  EXPECT_TRUE(has_note(*load(std::string("nrrd"), {{"file", file}}),
                       "int32 voxels are kept as float32, largest rounding error 1"));
}

TEST(Nrrd, WorldFrames) {
  const std::string directions = "space directions: (0,2,0) (-3,0,0) (0, 0, 1.5)\nspace origin: (10,20,30)\n";
  const auto at = [&](const std::string& space, const Vector3& index) {
    return world(*load("nrrd", {{"file", small(space + directions)}}), index);
  };
  EXPECT_EQ(at("space: right-anterior-superior\n", {1, 1, 1}), (Vector3{7, 22, 31.5}));
  EXPECT_EQ(at("space: left-posterior-superior\n", {1, 1, 1}), (Vector3{-7, -22, 31.5}));
  EXPECT_EQ(at("space: LAS\n", {1, 1, 1}), (Vector3{-7, 22, 31.5}));
  EXPECT_EQ(at("space: scanner-xyz\n", {1, 1, 1}), (Vector3{7, 22, 31.5}));
  EXPECT_EQ(at("space dimension: 3\n", {1, 1, 1}), (Vector3{7, 22, 31.5}));
  const auto spaced = load("nrrd", {{"file", small("spacings: 0.5 nan 2\n")}});
  EXPECT_EQ(world(*spaced, {3, 2, 1}), (Vector3{1.5, 2, 2}));
  EXPECT_EQ(spaced->voxel, 0.5);
  EXPECT_TRUE(has_note(*spaced, "nan"));
  EXPECT_TRUE(has_note(*load("nrrd", {{"file", small("")}}), "no spacing"));
}

TEST(Nrrd, Skips) {
  const Bytes voxels{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24};
  const auto first = [&](const std::string& rest, const Bytes& data) {
    return load_grid("nrrd", {{"file", small(rest, data)}})->at(0, 0, 0);
  };
  EXPECT_EQ(first("line skip: 2\n", "one\ntwo\n" + voxels), 1);
  EXPECT_EQ(first("byte skip: 3\n", "abc" + voxels), 1);
  EXPECT_EQ(first("line skip: 1\nbyte skip: 2\n", "one\nab" + voxels), 1);
  EXPECT_EQ(first("byte skip: -1\n", "anything" + voxels), 1);
  const auto longer = load("nrrd", {{"file", small("", voxels + Bytes(7, 'z'))}});
  EXPECT_TRUE(has_note(*longer, "7 bytes behind"));
  write(scratch("s.nhdr"), header("uint8", "encoding: gzip\nline skip: 1\nbyte skip: 3\ndata file: s.bin\n") + Bytes());
  write(scratch("s.bin"), "a line\n" + gzip("abc" + voxels));  // lines before, bytes after decompression
  EXPECT_EQ(load_grid("nrrd", {{"file", scratch("s.nhdr")}})->at(3, 2, 1), 24);
}

TEST(Nrrd, BadInputGetsOneClearError) {
  const std::string tail = "encoding: raw\n\n";
  const auto with = [](const std::string& text) { return "NRRD0004\n" + text; };
  const std::vector<std::pair<std::string, std::string>> bad{
      {"", "is empty"},
      {"PNG whatever", "is no NRRD file"},
      {with("type: uint8\n\n"), "lacks the field \"dimension\""},
      {with("type: float\ndimension: 3\nsizes: 4 3 2\n" + tail), "lacks the field \"endian\""},
      {with("type: block\ndimension: 3\nsizes: 4 3 2\n" + tail), "is no number type"},
      {with("type: uint8\ndimension: 4\nsizes: 3 4 3 2\n" + tail), "only one 3-D scalar volume"},
      {with("type: uint8\ndimension: 3\nsizes: 3 4 2\nkinds: vector domain domain\n" + tail), "kind \"vector\""},
      {with("type: uint8\ndimension: 3\nsizes: 4 3\n" + tail), "has 2 numbers, not 3"},
      {with("type: uint8\ndimension: 3\nsizes: 4 x 2\n" + tail), "\"x\" is no whole number"},
      {with("type: uint8\ndimension: 3\nsizes: 4 0 2\n" + tail), "at least 2"},
      {with("type: uint8\ndimension: 3\nsizes: 4 -3 2\n" + tail), "at least 2"},
      {with("type: uint8\ndimension: 3\nsizes: 4 1 2\n" + tail), "at least 2"},
      {with("type: double\ndimension: 3\nsizes: 2000000000 2000000000 2000000000\n" + tail), "overflow"},
      {with("type: uint8\ndimension: 3\nsizes: 99999999999999999999 3 2\n" + tail), "is no whole number"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\n" + tail + "short"),
       "announces 24 bytes of voxels, the data holds 5"},
      {with("type: uint8\ndimension: 3\nsizes: 4000 3000 2000\nencoding: gzip\n\nxxxx"), "announces 24000000000 bytes"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: gzip\n\nxxxxxxxx"), "damaged"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: zrl\n\nxx"), "NotSupported: "},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\n"), "neither a \"data file\" nor voxels"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\ndata file: gone.raw\n"),
       "gone.raw does not exist"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\ndata file: s%03d.raw 1 9 1\n"),
       "more than the grid's 2 slices"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nspacing: 1 1 1\n" + tail), "the nearest is \"spacings\""},
      {with("type: uint8\ntype: uint8\n" + tail), "stands twice"},
      {with("type: uint8\nno field\n" + tail), "line 3 is no field"},
      {with("type: uint8\n\x01\x02\x03\n" + tail), "is binary"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nspace directions: none (1,0,0) (0,1,0)\n" + tail),
       "axis 1 is \"none\""},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nspace directions: (1,0) (0,1) (1,1)\n" + tail),
       "has 2 components"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nspacings: 1 0 1\n" + tail + std::string(24, 'x')),
       "\"spacings\": is 0 along axis 2"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nspace dimension: 3\nspace directions: (1,0,0) (1,0,0) (0,0,1)\n" +
            tail + std::string(24, 'x')),
       "singular"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nspacings: 1 inf 1\n" + tail), "not finite"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nspace: left-posterior-superior-time\n" + tail),
       "no space of three"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nbyte skip: -2\n" + tail), "below -1"},
      {with("type: uint8\ndimension: 3\nsizes: 4 3 2\nline skip: 9\n" + tail), "more lines"}};
  const std::string file = scratch("bad.nrrd");
  for (const auto& [text, part] : bad) {
    write(file, text + Bytes());
    const std::string error = load_error("nrrd", {{"file", file}});
    EXPECT_NE(error.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << error << '"';
    EXPECT_NE(error.find("bad.nrrd"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(Nrrd, DoublesBeyondFloatAreRefused) {
  std::vector<double> v(24, 1.0);
  v[5] = 1e300;
  const std::string file = scratch("huge.nrrd");
  write(file, header("double", "endian: little\nencoding: raw\n\n") + bytes_of_numbers(v, false));
  EXPECT_NE(load_error("nrrd", {{"file", file}}).find("beyond what float32 holds"), std::string::npos);
}

TEST(Nrrd, BytesNeeded) {
  const auto& plugin = registry().get<DataPlugin>("data", "nrrd");
  const auto needed = [&](const std::string& file) {
    return plugin.bytes_needed(parameters("data", "nrrd", {{"file", file}}), {});
  };
  EXPECT_EQ(needed(small("")), 0u);  // mapped
  EXPECT_EQ(needed(DVRLAB_SHIPPED_DATA "/engine.nrrd"), 256u * 256 * 128);
}

struct Real {
  const char* file;
  std::array<int, 3> dims;
  VoxelType type;
  double lo, hi, sum;  // sum of the stored values, from an independent program
};

void check(const std::string& path, const Real& r) {
  const auto grid = load_grid("nrrd", {{"file", path}});
  EXPECT_EQ(grid->dims, r.dims);
  EXPECT_EQ(grid->type, r.type);
  EXPECT_FLOAT_EQ(static_cast<float>(grid->stored_min), static_cast<float>(r.lo));
  EXPECT_FLOAT_EQ(static_cast<float>(grid->stored_max), static_cast<float>(r.hi));
  double sum = 0;
  for (int k = 0; k < r.dims[2]; ++k)
    for (int j = 0; j < r.dims[1]; ++j)
      for (int i = 0; i < r.dims[0]; ++i) sum += grid->at(i, j, k);
  EXPECT_NEAR(sum, r.sum, 1e-9 * std::fabs(r.sum)) << r.file;
}

TEST(Nrrd, ShippedFiles) {
  check(DVRLAB_SHIPPED_DATA "/engine.nrrd", {"engine.nrrd", {256, 256, 128}, VoxelType::u8, 0, 255, 187475057});
  check(DVRLAB_SHIPPED_DATA "/fuel.nrrd", {"fuel.nrrd", {64, 64, 64}, VoxelType::u8, 0, 255, 509815});
  check(DVRLAB_SHIPPED_DATA "/hydrogenatom.nrrd",
        {"hydrogenatom.nrrd", {128, 128, 128}, VoxelType::u8, 0, 250, 5990975});
  check(DVRLAB_SHIPPED_DATA "/hydrogen.nrrd",
        {"hydrogen.nrrd", {64, 64, 64}, VoxelType::f32, 0, 1, 4856.0089703333269});
}

TEST(Nrrd, RealFiles) {
  DVRLAB_NEED_DATA(tooth, shared_data("volumes/tooth.nhdr"));

  check(tooth, {"tooth.nhdr", {103, 94, 161}, VoxelType::u16, 0, 1300, 821287590});
  check(shared_data("volumes/cranium_ct.nrrd"),
        {"cranium_ct.nrrd", {256, 256, 108}, VoxelType::i16, -1024, 2986, -4147325847});
  check(shared_data("volumes/flair_rotated.nrrd"),
        {"flair_rotated.nrrd", {124, 160, 140}, VoxelType::u8, 0, 255, 115231646});
  const auto rotated = load("nrrd", {{"file", shared_data("volumes/flair_rotated.nrrd")}});
  const Vector3 origin = world(*rotated, {0, 0, 0});  // LPS in the file
  EXPECT_DOUBLE_EQ(origin[0], -64.898239135742202);
  EXPECT_DOUBLE_EQ(origin[1], -110.4311447143555);
  EXPECT_DOUBLE_EQ(origin[2], -27.92553901672364);
  EXPECT_DOUBLE_EQ(rotated->to_world.m[0], 0.99359200921208746);
  EXPECT_DOUBLE_EQ(rotated->to_world.m[8], 0.94563858529983524);
}

}  // namespace
}  // namespace dvrlab::test
