// DICOM series written byte by byte: types, codings, compression, geometry, rescaling, choice of the series; real data.
#include <cmath>

#include "tests/data/dicom_series.h"

namespace dvrlab::test {
namespace {

class Dicom : public DicomTest {};

TEST_F(Dicom, TypesAndCodings) {
  for (const int bits : {8, 16})
    for (const bool is_signed : {false, true})
      for (const auto coding :
           {DicomSet::Coding::explicit_little, DicomSet::Coding::implicit_little, DicomSet::Coding::explicit_big}) {
        SCOPED_TRACE(std::to_string(bits) + (is_signed ? " signed " : " unsigned ") +
                     std::to_string(static_cast<int>(coding)));
        DicomSeries series;
        series.set_type(bits, is_signed);
        const auto grid = load_grid("dicom", {{"file", series.write(coding)}});
        EXPECT_EQ(grid->dims, (std::array<int, 3>{4, 3, 5}));
        EXPECT_EQ(grid->type, bits == 8 ? (is_signed ? VoxelType::i8 : VoxelType::u8)
                                        : (is_signed ? VoxelType::i16 : VoxelType::u16));
        for (int k = 0; k < 5; ++k)
          for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 4; ++i) EXPECT_EQ(grid->at(i, j, k), series.value(i, j, k));
        EXPECT_TRUE(grid->anatomical);
        EXPECT_EQ(grid->length_unit, "mm");
        EXPECT_EQ(grid->sha256.size(), 64u);
      }
}

TEST_F(Dicom, RleByHand) {
  DicomSeries series;
  for (DicomSet& s : series.slice) s.bytes(0x7fe00010, "fragments", dicom_fragments(dicom_rle(series.pixels(s), 2)));
  const auto grid = load_grid("dicom", {{"file", series.write({}, "1.2.840.10008.1.2.5")}});
  for (int k = 0; k < 5; ++k) EXPECT_EQ(grid->at(3, 1, k), series.value(3, 1, k));
  EXPECT_TRUE(has_note(*grid, "decompressed by GDCM, transfer syntax 1.2.840.10008.1.2.5"));
}

// The lossless transfer syntaxes, encoded by GDCM.
TEST_F(Dicom, CompressedByGdcm) {
  for (const std::string syntax : {"1.2.840.10008.1.2.4.57", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80",
                                   "1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.5"}) {
    SCOPED_TRACE(syntax);
    DicomSeries series(40, 36, 3);
    const std::string folder = series.write();
    ASSERT_TRUE(transcode(folder, syntax));
    const auto grid = load_grid("dicom", {{"file", folder}});
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 36; ++j)
        for (int i = 0; i < 40; ++i) ASSERT_EQ(grid->at(i, j, k), series.value(i, j, k)) << i << ' ' << j << ' ' << k;
    EXPECT_TRUE(has_note(*grid, syntax));
  }
}

TEST_F(Dicom, BitsAboveBitsStoredAreNoValues) {
  for (const bool is_signed : {false, true}) {
    DicomSeries series;
    series.set_type(16, is_signed);
    for (DicomSet& s : series.slice) {
      s.whole(0x00280101, 12);
      s.whole(0x00280102, 11);
      Bytes pixels = series.pixels(s);
      for (std::size_t i = 1; i < pixels.size(); i += 2)
        pixels[i] = static_cast<char>((pixels[i] & 0x0f) | (i % 3 == 0 ? 0xa0 : 0x50));
      s.bytes(0x7fe00010, "OW", pixels);
    }
    const auto grid = load_grid("dicom", {{"file", series.write()}});
    for (int k = 0; k < 5; ++k)
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 4; ++i) EXPECT_EQ(grid->at(i, j, k), series.value(i, j, k));
  }
}

TEST_F(Dicom, PlaceInTheWorld) {
  // Rows run to the back, columns to the head: sagittal slices. The normal, row x column, is the patient's left.
  DicomSeries series;
  for (std::size_t k = 0; k < 5; ++k) {
    DicomSet& s = series.slice[k];
    s.text(0x00200037, "DS", "0\\1\\0\\0\\0\\1");
    s.text(0x00280030, "DS", "2.5\\1.5");  // between rows, between columns
    s.text(0x00200032, "DS", std::to_string(10 + 3 * static_cast<int>(k)) + "\\20\\30");
  }
  std::swap(series.slice[0], series.slice[3]);  // files are in no order
  const auto grid = load_grid("dicom", {{"file", series.write()}});
  EXPECT_EQ(world(*grid, {0, 0, 0}), (Vector3{-10, -20, 30}));
  EXPECT_EQ(world(*grid, {2, 1, 3}), (Vector3{-19, -23, 32.5}));
  EXPECT_EQ(grid->voxel, 1.5);
  EXPECT_EQ(grid->at(0, 0, 4), series.value(0, 0, 4));
  EXPECT_EQ(grid->at(0, 0, 0), series.value(0, 0, 0));
}

TEST_F(Dicom, GantryTiltIsInTheAffine) {
  DicomSeries series;
  for (int k = 0; k < 5; ++k)
    series.slice[static_cast<std::size_t>(k)].text(0x00200032, "DS",
                                                   "0\\" + std::to_string(0.5 * k) + "\\" + std::to_string(2 * k));
  const auto grid = load_grid("dicom", {{"file", series.write()}});
  EXPECT_EQ(world(*grid, {0, 0, 4}), (Vector3{0, -2, 8}));
  EXPECT_TRUE(has_note(*grid, "sheared by 14.0362 degrees"));
}

TEST_F(Dicom, Rescale) {
  DicomSeries series;
  for (DicomSet& s : series.slice) {
    s.text(0x00281053, "DS", "0.5");
    s.text(0x00281052, "DS", "-1024");
  }
  auto grid = load_grid("dicom", {{"file", series.write()}});
  EXPECT_EQ(grid->type, VoxelType::u16);
  EXPECT_EQ(grid->slope, 0.5);
  EXPECT_EQ(grid->intercept, -1024);
  for (int k = 0; k < 5; ++k) series.slice[static_cast<std::size_t>(k)].text(0x00281053, "DS", std::to_string(k + 1));
  const std::string folder = series.write();
  grid = load_grid("dicom", {{"file", folder}});
  EXPECT_EQ(grid->type, VoxelType::f32);
  for (int k = 0; k < 5; ++k) EXPECT_EQ(grid->at(2, 1, k), (k + 1) * series.value(2, 1, k) - 1024);
  EXPECT_TRUE(has_note(*grid, "differ between slices"));
  const auto& plugin = registry().get<DataPlugin>("data", "dicom");
  EXPECT_GE(plugin.bytes_needed(parameters("data", "dicom", {{"file", folder}}), {}), 60u * 4);
}

TEST_F(Dicom, MultiFrameWithPositions) {
  for (const auto coding : {DicomSet::Coding::explicit_little, DicomSet::Coding::implicit_little}) {
    DicomSeries series;
    const auto grid = load_grid("dicom", {{"file", series.write_multi_frame(coding)}});
    EXPECT_EQ(grid->dims, (std::array<int, 3>{4, 3, 5}));
    for (int k = 0; k < 5; ++k) EXPECT_EQ(grid->at(1, 2, k), series.value(1, 2, k));
    EXPECT_EQ(world(*grid, {1, 1, 4}), (Vector3{-1, -1, 8}));
  }
}

TEST_F(Dicom, ChoiceOfTheSeries) {
  DicomSeries first, second;
  for (DicomSet& s : second.slice) {
    s.text(0x0020000e, "UI", "2.25.2");
    s.text(0x00281052, "DS", "7");
  }
  const std::string folder = first.write();
  second.write_into(folder, "other");
  write(folder + "/readme.txt", Bytes(300, 'x'));
  const std::string both = load_error("dicom", {{"file", folder}});
  EXPECT_NE(both.find("2.25.1 (5 slices, MR \"made by a test\"); 2.25.2 (5 slices"), std::string::npos) << both;
  EXPECT_EQ(load("dicom", {{"file", folder}, {"series", "2.25.2"}})->intercept, 7);
  EXPECT_EQ(load("dicom", {{"file", folder + "/other_3.dcm"}})->intercept, 7);
  EXPECT_EQ(load("dicom", {{"file", folder + "/slice_1.dcm"}})->intercept, 0);
  const auto field = load("dicom", {{"file", folder}, {"series", "2.25.1"}});
  EXPECT_TRUE(has_note(*field, "1 other series"));
  EXPECT_TRUE(has_note(*field, "1 files of the folder are no DICOM images"));
  EXPECT_NE(load_error("dicom", {{"file", folder}, {"series", "9"}}).find("begins with \"9\"; it holds 2.25.1"),
            std::string::npos);
  EXPECT_NE(
      load_error("dicom", {{"file", folder + "/other_3.dcm"}, {"series", "2.25.1"}}).find("belongs to the series"),
      std::string::npos);
}

TEST_F(Dicom, Recognises) {
  const auto& plugin = registry().get<DataPlugin>("data", "dicom");
  const std::string folder = DicomSeries().write();
  const Bytes start = read(folder + "/slice_0.dcm");
  EXPECT_TRUE(plugin.recognises(folder, {}));
  EXPECT_TRUE(plugin.recognises("x", std::as_bytes(std::span(start).first(512))));
  EXPECT_FALSE(plugin.recognises("x", std::as_bytes(std::span(start).first(131))));
  EXPECT_FALSE(plugin.recognises(DVRLAB_SHIPPED_DATA, {}));
  EXPECT_FALSE(plugin.recognises("/no/such/folder", {}));
}

// Numbers from an independent program (pydicom).
TEST_F(Dicom, RealSeries) {
  const std::string folder = shared_data("dicom_mr");
  if (folder.empty()) GTEST_SKIP() << "not supported: no data: dicom_mr";
  const auto grid = load_grid("dicom", {{"file", folder}});
  EXPECT_EQ(grid->dims, (std::array<int, 3>{256, 256, 18}));
  EXPECT_EQ(grid->type, VoxelType::i16);
  EXPECT_EQ(grid->stored_max, 1059);
  const auto* v = static_cast<const std::int16_t*>(grid->voxels.get());
  EXPECT_EQ(std::accumulate(v, v + grid->count(), 0ll), 202865252);
  EXPECT_EQ(grid->at(50, 100, 3), 393);
  EXPECT_EQ(grid->at(77, 128, 9), 489);
  const Vector3 origin = world(*grid, {0, 0, 0}), last = world(*grid, {0, 0, 17});
  EXPECT_EQ(origin, (Vector3{110.5, 79.3063, -65.7575}));
  EXPECT_NEAR(last[1], 95.2063, 1e-9);
  EXPECT_NEAR(last[2], 52.1425, 1e-9);
  EXPECT_TRUE(has_note(*grid, "the slices lie up to 0.08"));
}

}  // namespace
}  // namespace dvrlab::test
