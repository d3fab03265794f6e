// MetaImage: every type, byte order and way of storage; affine maps; what is refused; shipped and real files.
#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

const std::string start = "ObjectType = Image\nNDims = 3\n", sizes = "DimSize = 4 3 2\n";
const std::string plain = start + sizes + "ElementType = MET_UCHAR\n";

Bytes counting(std::size_t n) {
  Bytes v(n);
  for (std::size_t i = 0; i < n; ++i) v[i] = static_cast<char>(i);
  return v;
}

std::string file_of(const std::string& text, const Bytes& voxels = counting(24)) {
  const std::string file = scratch("t.mha");
  write(file, text + "ElementDataFile = LOCAL\n" + Bytes(voxels));
  return file;
}

std::shared_ptr<const GridField> grid_of(const std::string& text, const Bytes& voxels = counting(24)) {
  return load_grid("metaimage", {{"file", file_of(text, voxels)}});
}

enum class Stored { raw, packed, text };

template <class T>
void round_trip(const std::string& type) {
  std::vector<T> v(24);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = static_cast<T>(static_cast<int>(i) * 5 - (std::is_signed_v<T> ? 60 : 0));
  for (const bool big : {false, true})
    for (const bool detached : {false, true})
      for (const Stored stored : {Stored::raw, Stored::packed, Stored::text}) {
        SCOPED_TRACE(type + (big ? " big" : " little") + (detached ? " detached " : " local ") +
                     std::to_string(static_cast<int>(stored)));
        const Bytes raw = bytes_of_numbers(v, big);
        const Bytes data = stored == Stored::raw ? raw : stored == Stored::packed ? zlib(raw) : ascii(v);
        std::string text = start + sizes + "ElementType = " + type + "\n";
        text += std::string(detached ? "ElementByteOrderMSB" : "BinaryDataByteOrderMSB") + " = " +
                (big ? "True" : "False") + "\n";
        if (stored == Stored::text) text += "BinaryData = False\n";
        if (stored == Stored::packed)
          text += "CompressedData = True\nCompressedDataSize = " + std::to_string(data.size()) + "\n";
        const std::string file = scratch(detached ? "t.mhd" : "t.mha");
        write(scratch("t.zraw"), data);
        write(file, detached ? text + "ElementDataFile = t.zraw\n" + Bytes()
                             : text + "ElementDataFile = LOCAL\n" + Bytes(data));
        const auto grid = load_grid("metaimage", {{"file", file}});
        EXPECT_EQ(grid->dims, (std::array<int, 3>{4, 3, 2}));
        const bool kept = sizeof(T) <= 2 || std::is_same_v<T, float>;
        EXPECT_NE(has_note(*grid, "kept as float32"), kept);
        for (int n = 0; n < 24; ++n)
          EXPECT_EQ(grid->at(n % 4, n / 4 % 3, n / 12), static_cast<double>(v[static_cast<std::size_t>(n)]));
      }
}

TEST(MetaImage, TypesEndiansEncodings) {
  round_trip<std::int8_t>("MET_CHAR");
  round_trip<std::uint8_t>("MET_UCHAR");
  round_trip<std::int16_t>("MET_SHORT");
  round_trip<std::uint16_t>("MET_USHORT");
  round_trip<std::int32_t>("MET_INT");
  round_trip<std::uint32_t>("MET_UINT");
  round_trip<std::int32_t>("MET_LONG");
  round_trip<std::uint32_t>("MET_ULONG");
  round_trip<std::int64_t>("MET_LONG_LONG");
  round_trip<std::uint64_t>("MET_ULONG_LONG");
  round_trip<float>("MET_FLOAT");
  round_trip<double>("MET_DOUBLE");
}

TEST(MetaImage, WorldFrameIsLpsTurnedToRas) {
  const std::string turned = "TransformMatrix = 0 1 0 -1 0 0 0 0 1\n", spacing = "ElementSpacing = 2 3 1.5\n";
  const auto grid = grid_of(plain + turned + spacing + "Offset = 10 20 30\n");
  EXPECT_EQ(world(*grid, {1, 1, 1}), (Vector3{-7, -22, 31.5}));  // LPS: (10 - 3, 20 + 2, 31.5)
  EXPECT_TRUE(grid->anatomical);
  EXPECT_TRUE(has_note(*grid, "x and y negated"));
  for (const std::string synonym : {"Rotation", "Orientation"})
    EXPECT_EQ(world(*grid_of(plain + synonym + turned.substr(15) + spacing), {1, 0, 0}), (Vector3{0, -2, 0}));
  for (const std::string synonym : {"Position", "Origin"})
    EXPECT_EQ(world(*grid_of(plain + synonym + " = 1 2 3\n"), {0, 0, 0}), (Vector3{-1, -2, 3}));
  EXPECT_EQ(grid_of(plain + "ElementSize = 2 3 4\n")->voxel, 2);
  EXPECT_EQ(grid_of(plain + "ElementSize = 2 3 4\nElementSpacing = 5 6 7\n")->voxel, 5);
  EXPECT_TRUE(has_note(*grid_of(plain), "no spacing"));
  EXPECT_EQ(grid_of(plain + "DistanceUnits = mm\n")->length_unit, "mm");
  EXPECT_EQ(grid_of(plain + "DistanceUnits = ?\n")->length_unit, "");
  EXPECT_FALSE(grid_of(plain + "AnatomicalOrientation = ???\n")->anatomical);
  // A fourth axis of size 1 widens the matrix.
  const auto four = grid_of(
      "ObjectType = Image\nNDims = 4\nDimSize = 4 3 2 1\nElementType = MET_UCHAR\nElementSpacing = 2 3 1.5 1\n"
      "TransformMatrix = 0 1 0 0  -1 0 0 0  0 0 1 0  0 0 0 1\nOffset = 10 20 30 0\n");
  EXPECT_EQ(world(*four, {1, 1, 1}), (Vector3{-7, -22, 31.5}));
}

// One oblique volume in the words of two formats and two frames: the same place, the same values.
TEST(MetaImage, SamePlaceAsNrrd) {
  const auto meta =
      grid_of(plain + "TransformMatrix = 0.8 0.6 0 -0.6 0.8 0 0 0 1\nElementSpacing = 2 3 4\nOffset = 5 6 7\n");
  const std::string nrrd = scratch("same.nrrd");
  write(nrrd,
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\nspace: RAS\n"
        "space directions: (-1.6,-1.2,0) (1.8,-2.4,0) (0,0,4)\nspace origin: (-5,-6,7)\n\n" +
            counting(24));
  const auto other = load_grid("nrrd", {{"file", nrrd}});
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(meta->to_world.m[i], other->to_world.m[i], 1e-15);
  EXPECT_EQ(meta->to_world.t, other->to_world.t);
  for (int n = 0; n < 24; ++n) EXPECT_EQ(meta->at(n % 4, n / 4 % 3, n / 12), other->at(n % 4, n / 4 % 3, n / 12));
}

TEST(MetaImage, ScalingSkipsAndOwnKeys) {
  const auto scaled = grid_of(plain + "ElementToIntensityFunctionSlope = 0.5\nElementToIntensityFunctionOffset = -3\n");
  EXPECT_EQ(scaled->slope, 0.5);
  EXPECT_EQ(scaled->intercept, -3);
  EXPECT_EQ(grid_of(plain + "HeaderSize = -1\n", "in front" + counting(24))->at(1, 0, 0), 1);
  EXPECT_TRUE(has_note(*grid_of(plain + "ITK_InputFilterName = x\n"), "no effect: ITK_InputFilterName"));
  EXPECT_TRUE(has_note(*grid_of(start + sizes + "ElementType = MET_SHORT\n", counting(48)), "little-endian is taken"));
  write(scratch("skip.raw"), "four" + counting(24));
  write(scratch("skip.mhd"), plain + "HeaderSize = 4\nElementDataFile = skip.raw\n" + Bytes());
  EXPECT_EQ(load_grid("metaimage", {{"file", scratch("skip.mhd")}})->at(3, 2, 1), 23);
}

TEST(MetaImage, VoxelsInSeveralFiles) {
  for (const int i : {1, 2}) {
    Bytes slice(12);
    for (std::size_t n = 0; n < 12; ++n) slice[n] = static_cast<char>(12 * (i - 1) + static_cast<int>(n));
    write(scratch("m" + std::to_string(i) + ".raw"), slice);
  }
  for (const std::string data : {"m%d.raw", "m%d.raw 1 2 1", "LIST\nm1.raw\nm2.raw", "LIST 2\nm1.raw\n\nm2.raw"}) {
    write(scratch("m.mhd"), plain + "ElementDataFile = " + data + "\n" + Bytes());
    const auto grid = load_grid("metaimage", {{"file", scratch("m.mhd")}});
    for (int n = 0; n < 24; ++n) EXPECT_EQ(grid->at(n % 4, n / 4 % 3, n / 12), n) << data;
  }
}

TEST(MetaImage, BadInputGetsOneClearError) {
  const auto local = [](const std::string& text, const Bytes& data = counting(24)) {
    return text + "ElementDataFile = LOCAL\n" + Bytes(data);
  };
  const std::string packed = plain + "CompressedData = True\n";
  const std::vector<std::pair<Bytes, std::string>> bad{
      {{}, "is empty"},
      {Bytes(100, 'x'), "is no MetaImage file"},
      {"some = thing\n" + Bytes(), "is no MetaImage file"},
      {plain + Bytes(), "lacks the field \"ElementDataFile\""},
      {"ObjectType = Image\nno field\n" + Bytes(), "line 2 is no field"},
      {"ObjectType = Image\n\x01\x02\x03\n" + Bytes(), "is binary"},
      {"ObjectType = Image\nNDims = 3\nNDims = 3\n" + Bytes(), "stands twice"},
      {local("ObjectType = Tube\n"), "only \"Image\" holds a volume"},
      {local(start + sizes), "lacks the field \"ElementType\""},
      {local(start + "ElementType = MET_UCHAR\n"), "lacks the field \"DimSize\""},
      {local(start + sizes + "ElementType = MET_UCHAR_ARRAY\n"), "is no scalar number"},
      {local(plain + "ElementNumberOfChannels = 3\n"), "cut out one volume or one channel"},
      {local("NDims = 2\nDimSize = 4 6\nElementType = MET_UCHAR\n"), "is 2"},
      {local("NDims = 4\nDimSize = 4 3 1 2\nElementType = MET_UCHAR\n"), "longer than 1"},
      {local(start + "DimSize = 4 3\nElementType = MET_UCHAR\n"), "has 2 numbers, not 3"},
      {local(start + "DimSize = 4 0 2\nElementType = MET_UCHAR\n"), "at least 2"},
      {local(start + "DimSize = 4 -3 2\nElementType = MET_UCHAR\n"), "at least 2"},
      {local(start + "DimSize = 2000000000 2000000000 2000000000\nElementType = MET_DOUBLE\n"), "overflow"},
      {local(start + "DimSize = 400 300 200\nElementType = MET_UCHAR\n"), "announces 24000000 bytes"},
      {local(start + "DimSize = 400 300 200\nElementType = MET_UCHAR\nCompressedData = True\n"), "holds at most"},
      {local(plain, counting(5)), "the data holds 5"},
      {local(packed), "damaged"},
      {local(packed, zlib(counting(5))), "the data holds 5"},
      {local(packed + "CompressedDataSize = 999\n"), "is 999, the file holds 24 bytes there"},
      {local(packed + "BinaryData = False\n"), "text is not compressed"},
      {local(packed + "HeaderSize = -1\n"), "only raw voxels can be counted from the end"},
      {local(plain + "BinaryData = perhaps\n"), "must be True or False"},
      {local(plain + "BinaryData = False\n", Bytes(60, 'x')), "voxel 0 is \"xxxx"},
      {local(plain + "HeaderSize = 4\n"), "inside the header"},
      {local(plain + "HeaderSize = -2\n"), "is -2"},
      {local(plain + "Offset = 1 2 3\nOrigin = 1 2 4\n"), "which means the same"},
      {local(plain + "ElementSpacing = 1 0 1\n"), "\"ElementSpacing\": is 0 along axis 2"},
      {local(plain + "TransformMatrix = 1 0 0 1 0 0 0 0 1\n"), "singular"},
      {local(plain + "ElementSpacing = 1 nan 1\n"), "not finite"},
      {local(plain + "TransformMatrix = 1 0 0 0 1 0 0 0 inf\n"), "not finite"},
      {local(plain + "TransformMatrix = 1 0 0 0 1 0\n"), "has 6 numbers, not 9"},
      {local(plain + "ElementToIntensityFunctionSlope = 0\n"), "is 0"},
      {plain + "ElementDataFile = gone.raw\n" + Bytes(), "gone.raw does not exist"},
      {plain + "ElementDataFile = s%d.raw 1 9 1\n" + Bytes(), "more than the grid's 2 slices"},
      {plain + "ElementDataFile = LIST\ngone.raw\n" + Bytes(), "names 1 data files"}};
  const std::string file = scratch("bad.mha");
  for (const auto& [bytes, part] : bad) {
    write(file, bytes);
    const std::string error = load_error("metaimage", {{"file", file}});
    EXPECT_NE(error.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << error << '"';
    EXPECT_NE(error.find("bad.mha"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST(MetaImage, ShippedAndRealFiles) {
  const auto f = load_grid("metaimage", {{"file", DVRLAB_SHIPPED_DATA "/letter_f.mhd"}});
  EXPECT_EQ(f->dims, (std::array<int, 3>{24, 16, 32}));
  EXPECT_EQ(world(*f, {0, 0, 0}), (Vector3{11.5, 7.5, -15.5}));
  EXPECT_EQ(f->at(6, 8, 12), 255);
  EXPECT_EQ(f->at(18, 8, 12), 0);
  DVRLAB_NEED_DATA(lung, shared_data("volumes/LIDC2.mha"));
  const auto grid = load_grid("metaimage", {{"file", lung}});
  EXPECT_EQ(grid->dims, (std::array<int, 3>{256, 256, 133}));
  std::uint64_t sum = 0;
  const auto* v = static_cast<const std::uint8_t*>(grid->voxels.get());
  for (std::uint64_t i = 0; i < grid->count(); ++i) sum += v[i];
  EXPECT_EQ(sum, 61489178u);  // from an independent program
  const Vector3 origin = world(*grid, {0, 0, 0});
  EXPECT_NEAR(origin[0], 0, 1e-12);
  EXPECT_NEAR(origin[1], -360, 1e-12);
  EXPECT_NEAR(origin[2], 332.5, 1e-12);
  EXPECT_NEAR(grid->to_world.m[8], -2.5, 1e-12);  // the third axis points down
}

}  // namespace
}  // namespace dvrlab::test
