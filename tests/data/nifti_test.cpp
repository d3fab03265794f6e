// NIfTI files written by hand: types, byte orders, versions, scaling, affine maps, bad input; real files.
#include <cmath>
#include <optional>

#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

// The fields of a version 1 or 2 header that the tests need, at the places that the standard gives.
struct Header {
  int version = 1;
  bool big_endian = false;
  std::vector<long long> dim{3, 4, 3, 2};
  int datatype = 2, bits = 8;
  std::array<double, 4> pixdim{1, 2, 3, 4};
  double slope = 0, intercept = 0;
  int qform = 0, sform = 0;
  std::array<double, 6> quatern{};  // b, c, d, offset x, y, z
  std::array<double, 12> srow{};
  std::string magic = {};
  int units = 0;
  std::optional<double> vox_offset = {};  // directly behind the header when nothing is given

  template <class T>
  void put(Bytes& out, std::size_t at, double x) const {
    const Bytes b = bytes_of_numbers(std::vector<T>{static_cast<T>(x)}, big_endian);
    std::copy(b.begin(), b.end(), out.begin() + static_cast<std::ptrdiff_t>(at));
  }

  Bytes bytes() const {
    const bool one = version == 1;
    Bytes out(one ? 352 : 544, 0);
    const auto real = [&](std::size_t at1, std::size_t at2, std::size_t i, double x) {
      one ? put<float>(out, at1 + 4 * i, x) : put<double>(out, at2 + 8 * i, x);
    };
    const auto code = [&](std::size_t at1, std::size_t at2, int x) {
      one ? put<std::int16_t>(out, at1, x) : put<std::int32_t>(out, at2, x);
    };
    put<std::int32_t>(out, 0, one ? 348 : 540);
    for (std::size_t i = 0; i < 8; ++i) {
      const double n = i < dim.size() ? static_cast<double>(dim[i]) : 1;
      one ? put<std::int16_t>(out, 40 + 2 * i, n) : put<std::int64_t>(out, 16 + 8 * i, n);
    }
    put<std::int16_t>(out, one ? 70 : 12, datatype);
    put<std::int16_t>(out, one ? 72 : 14, bits);
    for (std::size_t i = 0; i < 4; ++i) real(76, 104, i, pixdim[i]);
    one ? put<float>(out, 108, vox_offset.value_or(352)) : put<std::int64_t>(out, 168, vox_offset.value_or(544));
    real(112, 176, 0, slope);
    real(116, 184, 0, intercept);
    one ? put<std::int8_t>(out, 123, units) : put<std::int32_t>(out, 500, units);
    code(252, 344, qform);
    code(254, 348, sform);
    for (std::size_t i = 0; i < 6; ++i) real(256, 352, i, quatern[i]);
    for (std::size_t i = 0; i < 12; ++i) real(280, 400, i, srow[i]);
    const std::string word = magic.empty() ? (one ? "n+1" : "n+2") : magic;
    std::copy(word.begin(), word.end(), out.begin() + (one ? 344 : 4));
    return out;
  }
};

std::string file_of(const Header& h, const Bytes& voxels, const std::string& name = "t.nii") {
  const Bytes all = h.bytes() + voxels;
  write(scratch(name), name.ends_with(".gz") ? gzip(all) : all);
  return scratch(name);
}

bool have_nifti() {
  const auto& all = registry().entries();
  return std::any_of(all.begin(), all.end(), [](const auto& e) { return e.kind == "data" && e.name == "nifti"; });
}

class Nifti : public testing::Test {
 protected:
  void SetUp() override {
    if (!have_nifti()) GTEST_SKIP() << "not supported: the nifti plugin is not built (libnifti-dev)";
  }
};

template <class T>
void round_trip(int datatype) {
  std::vector<T> v(24);
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = static_cast<T>(static_cast<int>(i) * 5 - (std::is_signed_v<T> ? 60 : 0));
  for (const int version : {1, 2})
    for (const bool big : {false, true})
      for (const std::string name : {"t.nii", "t.nii.gz"}) {
        SCOPED_TRACE(name + std::to_string(version) + (big ? " big " : " little ") + std::to_string(datatype));
        Header h{.version = version, .big_endian = big, .datatype = datatype, .bits = 8 * static_cast<int>(sizeof(T))};
        h.slope = 0.5;
        h.intercept = -3;
        const auto grid = load_grid("nifti", {{"file", file_of(h, bytes_of_numbers(v, big), name)}});
        EXPECT_EQ(grid->dims, (std::array<int, 3>{4, 3, 2}));
        const bool kept = sizeof(T) <= 2 || std::is_same_v<T, float>;
        EXPECT_EQ(grid->bytes(), 24 * (kept ? sizeof(T) : sizeof(float)));
        EXPECT_NE(has_note(*grid, "kept as float32"), kept);
        for (int n = 0; n < 24; ++n)
          EXPECT_EQ(grid->at(n % 4, n / 4 % 3, n / 12), static_cast<double>(v[static_cast<std::size_t>(n)]));
        EXPECT_EQ(grid->slope, 0.5);
        EXPECT_EQ(grid->intercept, -3);
        EXPECT_EQ(world(*grid, {1, 1, 1}), (Vector3{2, 3, 4}));  // pixdim alone
      }
}

TEST_F(Nifti, TypesEndiansVersions) {
  round_trip<std::uint8_t>(2);
  round_trip<std::int16_t>(4);
  round_trip<std::int32_t>(8);
  round_trip<float>(16);
  round_trip<double>(64);
  round_trip<std::int8_t>(256);
  round_trip<std::uint16_t>(512);
  round_trip<std::uint32_t>(768);
  round_trip<std::int64_t>(1024);
  round_trip<std::uint64_t>(1280);
}

TEST_F(Nifti, AffinePrefersSformThenQform) {
  for (const int version : {1, 2}) {
    Header h{.version = version};
    h.qform = 1;
    h.quatern = {0, 0, std::sqrt(0.5), 10, 20, 30};  // a quarter turn about z
    const Bytes voxels(24, 1);
    const Vector3 q = world(*load("nifti", {{"file", file_of(h, voxels)}}), {1, 2, 1});
    EXPECT_NEAR(q[0], 10 - 2 * 3, 1e-5);
    EXPECT_NEAR(q[1], 20 + 1 * 2, 1e-5);
    EXPECT_NEAR(q[2], 34, 1e-5);
    h.pixdim[0] = -1;  // qfac: the third axis is reversed
    EXPECT_NEAR(world(*load("nifti", {{"file", file_of(h, voxels)}}), {1, 2, 1})[2], 26, 1e-5);
    h.sform = 2;
    h.srow = {0, -2, 0, 5, 3, 0, 0, 6, 0, 0, 1.5, 7};
    const auto both = load("nifti", {{"file", file_of(h, voxels)}});
    EXPECT_EQ(world(*both, {1, 2, 1}), (Vector3{1, 9, 8.5}));
    EXPECT_TRUE(has_note(*both, "sform"));
    EXPECT_EQ(both->voxel, 1.5);
  }
}

TEST_F(Nifti, ScalingAndNan) {
  Header h{.datatype = 16, .bits = 32};
  h.intercept = 5;  // slope 0: none, whatever the intercept says
  std::vector<float> v(24, 1.5f);
  EXPECT_EQ(load("nifti", {{"file", file_of(h, bytes_of_numbers(v, false))}})->intercept, 0);
  v[9] = std::numeric_limits<float>::quiet_NaN();  // nifticlib would make it 0
  const std::string file = file_of(h, bytes_of_numbers(v, false));
  EXPECT_NE(load_error("nifti", {{"file", file}}).find("voxel (1, 2, 0) is NaN"), std::string::npos);
  LoadContext replace;
  replace.nan_policy = "replace";
  replace.nan_value = -2;
  EXPECT_EQ(load_grid("nifti", {{"file", file}}, replace)->at(1, 2, 0), -2);
}

TEST_F(Nifti, AnatomyUnitsAndAnUnsetSlope) {
  const Bytes voxels(24, 1);
  for (const int version : {1, 2}) {
    const auto read = [&](Header h) {
      h.version = version;
      return load("nifti", {{"file", file_of(h, voxels)}});
    };
    Header placed{.sform = 1};
    placed.srow = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    EXPECT_TRUE(read(placed)->anatomical);
    EXPECT_TRUE(read({.qform = 1})->anatomical);
    EXPECT_FALSE(read({})->anatomical);  // pixdim alone says nothing about a patient
    EXPECT_EQ(read({})->length_unit, "");
    EXPECT_EQ(read({.units = 1})->length_unit, "m");
    EXPECT_EQ(read({.units = 2 + 8})->length_unit, "mm");  // with seconds
    EXPECT_EQ(read({.units = 3})->length_unit, "um");
    Header unset;
    unset.slope = unset.intercept = std::numeric_limits<double>::quiet_NaN();
    const auto plain = read(unset);
    EXPECT_EQ(plain->slope, 1);
    EXPECT_EQ(plain->intercept, 0);
    EXPECT_TRUE(has_note(*plain, "scl_slope is NaN"));
    Header half;
    half.slope = 2;
    half.intercept = std::numeric_limits<double>::quiet_NaN();
    half.version = version;
    EXPECT_NE(load_error("nifti", {{"file", file_of(half, voxels)}}).find("scl_inter"), std::string::npos);
  }
}

// nifticlib would read the last bytes of the header as voxels.
TEST_F(Nifti, VoxelsBeginWhereTheHeaderSays) {
  Bytes voxels(24, 7);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const int version : {1, 2}) {
    const int least = version == 1 ? 352 : 544;
    for (const bool big : {false, true}) {
      const auto with = [&](double offset) {
        return Header{.version = version, .big_endian = big, .vox_offset = offset};
      };
      const auto plain = load_grid("nifti", {{"file", file_of(with(0), voxels)}});
      EXPECT_EQ(plain->stored_min, 7) << "of the bytes behind the header";
      EXPECT_TRUE(has_note(*plain, "vox_offset is 0 and taken as " + std::to_string(least)));
      const auto later = load_grid("nifti", {{"file", file_of(with(least + 3), Bytes(3, 9) + voxels)}});
      EXPECT_EQ(later->stored_min, 7);
      EXPECT_EQ(later->stored_max, 7);
      std::vector<double> bad{100, 348, double(least - 1), -352, 1e17};
      if (version == 1) bad.insert(bad.end(), {nan, 352.5, std::numeric_limits<double>::infinity()});
      for (const double offset : bad) {
        const std::string error = load_error("nifti", {{"file", file_of(with(offset), voxels)}});
        EXPECT_NE(error.find("vox_offset is "), std::string::npos) << offset << ": " << error;
        EXPECT_NE(error.find("at least " + std::to_string(least)), std::string::npos) << error;
      }
    }
  }
}

// What nifticlib repairs without a word decides the affine: it is refused, or a note says it.
TEST_F(Nifti, NothingIsRepairedSilently) {
  const Bytes voxels(24, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const int version : {1, 2}) {
    const auto error = [&](Header h, const char* part) {
      h.version = version;
      const std::string text = load_error("nifti", {{"file", file_of(h, voxels)}});
      EXPECT_NE(text.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << text << '"';
    };
    error({.pixdim = {1, 0, 3, 4}}, "pixdim[1] is 0");
    error({.pixdim = {1, 2, nan, 4}}, "pixdim[2] is nan");
    error({.pixdim = {1, 2, 3, -4}, .qform = 1}, "pixdim[3] is -4; with a qform");
    error({.pixdim = {nan, 2, 3, 4}, .qform = 1}, "pixdim[0] is nan");
    error({.qform = 1, .quatern = {0, nan, 0}}, "the qform holds a number that is not finite");
    error({.qform = 1, .quatern = {0, 0, 0, 0, 0, nan}}, "the qform holds a number that is not finite");
    error({.qform = 1, .quatern = {1, 1, 0}}, "is 2; a rotation has at most 1");
    const auto load_it = [&](Header h) {
      h.version = version;
      return load("nifti", {{"file", file_of(h, voxels)}});
    };
    EXPECT_TRUE(has_note(*load_it({.qform = 1, .quatern = {0.70711, 0.7072, 0}}), "scaled to 1"));
    EXPECT_FALSE(has_note(*load_it({.qform = 1, .quatern = {std::sqrt(0.5), std::sqrt(0.5), 0}}), "scaled"));
    EXPECT_TRUE(has_note(*load_it({.bits = 16}), "bitpix is 16, but the data type uint8 decides"));
    // What does not decide is not judged: the sform is the affine here.
    Header by_sform{.pixdim = {1, 0, nan, 4}, .qform = 1, .sform = 1};
    by_sform.srow = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    EXPECT_EQ(world(*load_it(by_sform), {1, 1, 1}), (Vector3{1, 1, 1}));
  }
}

TEST_F(Nifti, OneTimePointIsRead) {
  EXPECT_NO_THROW(load("nifti", {{"file", file_of(Header{.dim = {4, 4, 3, 2, 1}}, Bytes(24, 1))}}));
  EXPECT_NO_THROW(load("nifti", {{"file", file_of(Header{.dim = {5, 4, 3, 2, 1, 1}}, Bytes(24, 1))}}));
}

TEST_F(Nifti, BadInputGetsOneClearError) {
  const Bytes voxels(24, 1);
  Header singular{.sform = 1};
  singular.srow = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0};
  Header infinite;
  infinite.slope = std::numeric_limits<double>::infinity();
  Header nan_affine{.sform = 1};
  nan_affine.srow[2] = std::numeric_limits<double>::quiet_NaN();
  const Bytes head = Header{}.bytes();
  const auto with = [](const Header& h, const Bytes& v) { return h.bytes() + v; };
  const std::vector<std::pair<Bytes, std::string>> bad{
      {{}, "is empty"},
      {Bytes(100, 'x'), "is no NIfTI file"},
      {Bytes(head.begin(), head.begin() + 200), "is no NIfTI file"},
      {with({.magic = "ni1"}, voxels), "NotSupported: "},
      {with({.magic = "xxx"}, voxels), "magic word"},
      {with({.dim = {4, 4, 3, 2, 5}}, voxels), "4 dimensions (4 x 3 x 2 x 5)"},
      {with({.dim = {2, 4, 3}}, voxels), "2 dimensions"},
      {with({.dim = {99, 4, 3, 2}}, voxels), "99 dimensions"},
      {with({.dim = {3, 4, 0, 2}}, voxels), "at least 2"},
      {with({.dim = {3, 4, -3, 2}}, voxels), "at least 2"},
      {with({.dim = {3, 4, 1, 2}}, voxels), "at least 2"},
      {with({.magic = "ni1"}, {}), "store it as one .nii file"},
      {with({.version = 2, .dim = {3, 2000000000, 2000000000, 2000000000}, .datatype = 64, .bits = 64}, voxels),
       "overflow"},
      {with({.datatype = 128, .bits = 24}, Bytes(72, 1)), "(RGB24) is no scalar"},
      {with({.datatype = 32, .bits = 64}, voxels), "is no scalar"},
      {with({.datatype = 1234}, voxels), "is no scalar"},
      {with({}, Bytes(5, 1)), "announces 24 bytes of voxels, the data holds 5"},
      {gzip(with({}, Bytes(5, 1))), "announces 24 bytes of voxels, the data holds 5"},
      {gzip(with({.dim = {3, 3000, 3000, 3000}}, voxels)), "announces 27000000000 bytes"},
      {with(singular, voxels), "singular"},
      {with(nan_affine, voxels), "not finite"},
      {with(infinite, voxels), "scl_slope"}};
  const std::string file = scratch("bad.nii");
  testing::internal::CaptureStderr();
  for (const auto& [bytes, part] : bad) {
    write(file, bytes);
    const std::string error = load_error("nifti", {{"file", file}});
    EXPECT_NE(error.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << error << '"';
    EXPECT_NE(error.find("bad.nii"), std::string::npos) << error;
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // the library says nothing on its own
}

TEST_F(Nifti, OrientationsShareOneWorld) {
  DVRLAB_NEED_DATA(ras, shared_data("nifti_orientation/RAS.nii.gz"));
  const auto reference = load_grid("nifti", {{"file", ras}});
  const Affine to_index = reference->to_world.inverse();
  for (const std::string name : {"LAS", "LPI", "AIL", "SPR"}) {
    const auto other = load_grid("nifti", {{"file", shared_data("nifti_orientation/" + name + ".nii.gz")}});
    double worst = 0;
    std::uint64_t compared = 0;
    for (int k = 0; k < other->dims[2]; k += 3)
      for (int j = 0; j < other->dims[1]; j += 3)
        for (int i = 0; i < other->dims[0]; i += 3) {
          const Vector3 x = to_index.point(world(*other, {double(i), double(j), double(k)}));
          std::array<int, 3> n;
          bool inside = true;
          for (std::size_t a = 0; a < 3; ++a) {
            n[a] = static_cast<int>(std::lround(x[a]));
            inside = inside && n[a] >= 0 && n[a] < reference->dims[a] && std::fabs(x[a] - n[a]) < 1e-3;
          }
          ASSERT_TRUE(inside) << name;
          const double a = reference->slope * reference->at(n[0], n[1], n[2]) + reference->intercept;
          const double b = other->slope * other->at(i, j, k) + other->intercept;
          worst = std::max(worst, std::fabs(a - b));
          ++compared;
        }
    std::printf("%s: %llu voxels compared, worst difference %g\n", name.c_str(),
                static_cast<unsigned long long>(compared), worst);
    EXPECT_EQ(worst, 0) << name;
  }
}

TEST_F(Nifti, Colin27OfMricron) {
  const std::string file = "/usr/share/mricron/templates/ch2.nii.gz";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "not supported: no data (Debian package mricron-data)";
  const auto grid = load_grid("nifti", {{"file", file}});
  EXPECT_EQ(grid->dims, (std::array<int, 3>{181, 217, 181}));
  EXPECT_EQ(grid->type, VoxelType::u8);
  EXPECT_EQ(grid->voxel, 1);
  std::uint64_t sum = 0;
  const auto* v = static_cast<const std::uint8_t*>(grid->voxels.get());
  for (std::uint64_t i = 0; i < grid->count(); ++i) sum += v[i];
  EXPECT_EQ(sum, 317151210u);  // from an independent program
  EXPECT_EQ(world(*grid, {0, 0, 0}), (Vector3{-90, -125, -71}));
}

}  // namespace
}  // namespace dvrlab::test
