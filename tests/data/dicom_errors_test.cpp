// Bad DICOM series: one clear error each, which names the files, and none that crashes.
#include <functional>
#include <random>

#include "tests/data/dicom_series.h"

namespace dvrlab::test {
namespace {

class DicomErrors : public DicomTest {};

void expect_error(const std::string& path, const std::string& part) {
  testing::internal::CaptureStderr();
  const std::string error = load_error("dicom", {{"file", path}});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // the library says nothing on its own
  EXPECT_NE(error.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << error << '"';
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

// The error of a series in which `spoil` changed the slices.
void expect_spoilt(const std::string& part, const std::function<void(DicomSeries&)>& spoil) {
  DicomSeries series;
  spoil(series);
  expect_error(series.write(), part);
}

TEST_F(DicomErrors, Series) {
  const std::string folder = new_folder();
  expect_error(folder, "holds no DICOM image");
  write(folder + "/a.txt", Bytes(500, 'x'));
  expect_error(folder, "holds no DICOM image (a file with \"DICM\" at byte 128); 1 other files");
  expect_error(folder + "/a.txt", "is no DICOM file");
  write(folder + "/empty", {});
  expect_error(folder + "/empty", "is empty");
  DicomSet report;
  report.text(0x0020000e, "UI", "2.25.1");
  write(folder + "/report.dcm", report.file());
  expect_error(folder + "/report.dcm", "without an image");
  expect_error(DicomSeries(4, 3, 1).write(), "slice_0.dcm: is the only slice");
}

TEST_F(DicomErrors, Positions) {
  const auto move = [](int k, const std::string& position) {
    return [=](DicomSeries& s) { s.slice[static_cast<std::size_t>(k)].text(0x00200032, "DS", position); };
  };
  expect_spoilt("slice_1.dcm 1 slice is missing: their distance is 4 mm, elsewhere it is 2 mm",
                [](DicomSeries& s) { s.slice.erase(s.slice.begin() + 1); });
  expect_spoilt("2 slices are missing: their distance is 6 mm", [](DicomSeries& s) {
    s.slice.erase(s.slice.begin() + 1, s.slice.begin() + 3);
    s.slice.push_back(dicom_slice(4, 3, "0\\0\\10", Bytes(24, 1)));
    s.slice.push_back(dicom_slice(4, 3, "0\\0\\12", Bytes(24, 1)));
  });
  expect_spoilt("not evenly spaced: between ", move(2, "0\\0\\4.5"));
  expect_spoilt("slice_2.dcm lie at the same position, 2 mm along the normal", move(2, "0\\0\\2"));
  expect_spoilt("slice_2.dcm: lies 0.5 mm beside the line", move(2, "0.5\\0\\4"));
  expect_spoilt("ImagePositionPatient (0020,0032) is \"0\\0\"; must be 3 finite numbers", move(2, "0\\0"));
  expect_spoilt("is \"0\\0\\nan\"; must be 3 finite numbers", move(2, "0\\0\\nan"));
  expect_spoilt("slice_3.dcm: ImagePositionPatient (0020,0032) is missing",
                [](DicomSeries& s) { s.slice[3].erase(0x00200032); });
  DicomSeries rounded;  // to two digits, as some scanners write them: the control, within the bound
  rounded.slice[2].text(0x00200032, "DS", "0.01\\0\\3.99");
  EXPECT_EQ(load_error("dicom", {{"file", rounded.write()}}), "");
}

TEST_F(DicomErrors, SlicesThatDiffer) {
  expect_spoilt("slice_2.dcm: has another ImageOrientationPatient than",
                [](DicomSeries& s) { s.slice[2].text(0x00200037, "DS", "0\\1\\0\\-1\\0\\0"); });
  expect_spoilt("slice_2.dcm: has another PixelSpacing than",
                [](DicomSeries& s) { s.slice[2].text(0x00280030, "DS", "1\\1.5"); });
  expect_spoilt("slice_2.dcm: has 3 x 4 pixels, not the 4 x 3 of", [](DicomSeries& s) {
    s.slice[2].whole(0x00280010, 4);
    s.slice[2].whole(0x00280011, 3);
  });
  expect_spoilt("slice_2.dcm: has another pixel type", [](DicomSeries& s) { s.slice[2].whole(0x00280103, 1); });
}

TEST_F(DicomErrors, Headers) {
  const auto text = [](std::uint32_t tag, const std::string& vr, const std::string& value) {
    return [=](DicomSeries& s) { s.slice[2].text(tag, vr, value); };
  };
  const auto whole = [](std::uint32_t tag, int value) { return [=](DicomSeries& s) { s.slice[2].whole(tag, value); }; };
  const auto erase = [](std::uint32_t tag) { return [=](DicomSeries& s) { s.slice[2].erase(tag); }; };
  expect_spoilt("slice_2.dcm: PhotometricInterpretation (0028,0004) is \"RGB\"", text(0x00280004, "CS", "RGB"));
  expect_spoilt("with 3 samples per pixel", whole(0x00280002, 3));
  expect_spoilt("BitsAllocated (0028,0100) is 32; pixels of 8 and 16 bits", whole(0x00280100, 32));
  expect_spoilt("BitsAllocated (0028,0100) is missing", erase(0x00280100));
  expect_spoilt("BitsStored (0028,0101) is 17", whole(0x00280101, 17));
  expect_spoilt("HighBit (0028,0102) is 14", whole(0x00280102, 14));
  expect_spoilt("Columns (0028,0011) is missing", erase(0x00280011));
  expect_spoilt("Columns (0028,0011) is 0", whole(0x00280011, 0));
  expect_spoilt("Rows (0028,0010) is 1", whole(0x00280010, 1));
  expect_spoilt("announces 8589672450 bytes of pixels", [](DicomSeries& s) {
    s.slice[2].whole(0x00280010, 65535);
    s.slice[2].whole(0x00280011, 65535);
  });
  expect_spoilt("does not hold two unit vectors", text(0x00200037, "DS", "1\\0\\0\\1\\0\\0"));
  expect_spoilt("PixelSpacing (0028,0030) must hold two numbers above 0", text(0x00280030, "DS", "1\\0"));
  expect_spoilt("PixelSpacing (0028,0030) is missing", erase(0x00280030));
  expect_spoilt("RescaleSlope (0028,1053) is 0", text(0x00281053, "DS", "0"));
  expect_spoilt("RescaleSlope (0028,1053) is \"inf\"", text(0x00281053, "DS", "inf"));
  expect_spoilt("beyond what float32 holds", text(0x00281053, "DS", "1e300"));
  expect_spoilt("ModalityLUTSequence (0028,3000) maps the values by a table", [](DicomSeries& s) {
    s.slice[2].erase(0x00281052);
    s.slice[2].erase(0x00281053);
    s.slice[2].items(0x00283000, {dicom_slice(2, 2, "0", {})});
  });
  expect_spoilt("NumberOfFrames (0028,0008) is \"-3\\2\"; must be a finite number", [](DicomSeries& s) {
    s.slice.resize(1);
    s.slice[0].text(0x00280008, "IS", "-3\\2");
  });
  const std::string file = new_folder() + "/frames.dcm";
  write(file, DicomSeries().frames().file());
  expect_error(file, "frames.dcm: NumberOfFrames (0028,0008) is 5, but the frames have no positions");
}

TEST_F(DicomErrors, Pixels) {
  expect_spoilt("GDCM cannot decode its pixels", [](DicomSeries& s) { s.slice[2].erase(0x7fe00010); });
  expect_spoilt("slice_2.dcm: its pixels are 10 bytes, its header announces 24",
                [](DicomSeries& s) { s.slice[2].bytes(0x7fe00010, "OW", Bytes(10, 1)); });
  DicomSeries series;
  for (DicomSet& s : series.slice) s.bytes(0x7fe00010, "fragments", dicom_fragments(Bytes(40, 'x')));
  for (const std::string syntax :
       {"1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90", "1.2.840.10008.1.2.5"}) {
    expect_error(series.write({}, syntax), "GDCM cannot decode its pixels, transfer syntax " + syntax);
  }
  expect_error(series.write({}, "1.2.3.4.5"), "slice_0.dcm: GDCM");
}

// A length beyond the file's end is refused before the library takes memory for it.
TEST_F(DicomErrors, LengthsBeyondTheFile) {
  const Bytes whole = DicomSeries().slice[0].file();
  const std::string file = new_folder() + "/cut.dcm";
  write(file, Bytes(whole.begin(), whole.end() - 10));
  expect_error(file, "cut.dcm: element (7fe0,0010) at byte ");
  expect_error(file, "announces 24 bytes, the file holds 14; it is cut off or damaged");
  DicomSet nested = DicomSeries().slice[0];
  Bytes item = DicomSeries().slice[1].coded(DicomSet::Coding::explicit_little);
  nested.items(0x00081140, {DicomSeries().slice[1]});
  Bytes spoilt = nested.file();
  const auto inner = std::search(spoilt.begin(), spoilt.end(), item.end() - 36, item.end());  // its pixels
  ASSERT_NE(inner, spoilt.end());
  *(inner + 11) = 0x7f;
  write(file + "2", spoilt);
  expect_error(file + "2",
               "element (7fe0,0010) at byte " + std::to_string(inner - spoilt.begin()) + " announces 2130706456 bytes");
}

TEST_F(DicomErrors, CutAndSpoiltFiles) {
  std::mt19937 random(11);
  int refused = 0, read = 0;
  testing::internal::CaptureStderr();
  for (const std::string syntax : {"", "1.2.840.10008.1.2.4.70", "1.2.840.10008.1.2.4.80", "1.2.840.10008.1.2.4.90",
                                   "1.2.840.10008.1.2.5", "frames"}) {
    DicomSeries series(12, 10, 5);
    const bool frames = syntax == "frames";
    const std::string one = frames ? series.write_multi_frame({}) : series.write() + "/slice_2.dcm";
    const std::string folder = std::filesystem::path(one).parent_path().string();
    ASSERT_TRUE(syntax.empty() || frames || transcode(folder, syntax));
    const Bytes whole = test::read(one);
    const auto outcome = [&](const Bytes& bytes) {
      std::filesystem::remove(one);
      write(one, bytes);
      return load_error("dicom", {{"file", folder}});
    };
    ASSERT_EQ(outcome(whole), "") << syntax;
    for (std::size_t n = 0; n < whole.size() - 12; n += 7 + n / 50)  // the last bytes may be padding
      EXPECT_NE(outcome(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n))), "") << syntax << n;
    for (int i = 0; i < 60; ++i) {
      Bytes spoilt = whole;
      spoilt[128 + random() % (spoilt.size() - 128)] = static_cast<char>(random());
      (outcome(spoilt).empty() ? read : refused) += 1;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  std::printf("spoilt files: %d refused, %d read\n", refused, read);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace dvrlab::test
