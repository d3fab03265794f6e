#include "tests/data/dicom_series.h"

#ifdef DVRLAB_TEST_GDCM  // without it the dicom plugin is not built, and its tests say so
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmImageWriter.h>
#endif

namespace dvrlab::test {

void DicomTest::SetUp() {
  const auto& all = registry().entries();
  if (std::none_of(all.begin(), all.end(), [](const auto& e) { return e.kind == "data" && e.name == "dicom"; }))
    GTEST_SKIP() << "not supported: the dicom plugin is not built (libgdcm-dev)";
}

DicomSeries::DicomSeries(int columns, int rows, int slices) : columns_(columns), rows_(rows) {
  for (int k = 0; k < slices; ++k) slice.push_back(dicom_slice(columns, rows, "0\\0\\" + std::to_string(2 * k), {}));
  set_type(16, false);
}

double DicomSeries::value(int i, int j, int k) const {
  return (i * 7 + j * 13 + k * 11) % 120 + (bits_ == 16 ? 1000 * (k % 2) : 0) - (signed_ ? 60 : 0);
}

void DicomSeries::set_type(int bits, bool is_signed) {
  bits_ = bits;
  signed_ = is_signed;
  for (DicomSet& s : slice) {
    s.whole(0x00280100, bits);
    s.whole(0x00280101, bits);
    s.whole(0x00280102, bits - 1);
    s.whole(0x00280103, is_signed ? 1 : 0);
    s.bytes(0x7fe00010, bits == 8 ? "OB" : "OW", pixels(s));
  }
}

Bytes DicomSeries::pixels(const DicomSet& of) const {
  const int k = static_cast<int>(&of - slice.data());
  Bytes out;
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i) {
      const int v = static_cast<int>(value(i, j, k));
      out.push_back(static_cast<char>(v & 0xff));
      if (bits_ == 16) out.push_back(static_cast<char>(v >> 8 & 0xff));
    }
  return out;
}

std::string new_folder() {
  static int count = 0;
  const std::string folder = scratch("series_" + std::to_string(++count));
  std::filesystem::create_directories(folder);
  return folder;
}

std::string DicomSeries::write(DicomSet::Coding coding, const std::string& syntax) const {
  const std::string folder = new_folder();
  write_into(folder, "slice", coding, syntax);
  return folder;
}

void DicomSeries::write_into(const std::string& folder, const std::string& stem, DicomSet::Coding coding,
                             const std::string& syntax) const {
  for (std::size_t k = 0; k < slice.size(); ++k)
    test::write(folder + "/" + stem + "_" + std::to_string(k) + ".dcm", slice[k].file(coding, syntax));
}

DicomSet DicomSeries::frames() const {
  DicomSet all = slice[0];
  all.text(0x00280008, "IS", std::to_string(slice.size()));
  Bytes values;
  for (std::size_t k = slice.size(); k-- > 0;) values = values + pixels(slice[k]);
  all.bytes(0x7fe00010, "OW", values);
  for (const std::uint32_t tag : {0x00200032u, 0x00200037u, 0x00280030u}) all.erase(tag);
  return all;
}

std::string DicomSeries::write_multi_frame(DicomSet::Coding coding) const {
  const auto group = [](std::uint32_t sequence, std::uint32_t tag, const std::string& text) {
    DicomSet inner, outer;
    inner.text(tag, "DS", text);
    outer.items(sequence, {inner});
    return outer;
  };
  std::vector<DicomSet> places;
  for (std::size_t k = slice.size(); k-- > 0;)
    places.push_back(group(0x00209113, 0x00200032, "0\\0\\" + std::to_string(2 * k)));
  DicomSet all = frames(), shared = group(0x00209116, 0x00200037, "1\\0\\0\\0\\1\\0"), spacing;
  spacing.text(0x00280030, "DS", "1\\1");
  shared.items(0x00289110, {spacing});
  all.items(0x52009229, {shared});
  all.items(0x52009230, places);
  const std::string file = new_folder() + "/frames.dcm";
  test::write(file, all.file(coding));
  return file;
}

bool transcode(const std::string& folder, const std::string& syntax) {
#ifdef DVRLAB_TEST_GDCM
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    gdcm::ImageReader reader;
    reader.SetFileName(entry.path().c_str());
    if (!reader.Read()) return false;
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(gdcm::TransferSyntax::GetTSType(syntax.c_str()));
    change.SetInput(reader.GetImage());
    if (!change.Change()) return false;
    gdcm::ImageWriter writer;
    writer.SetFile(reader.GetFile());
    writer.SetImage(change.GetOutput());
    writer.SetFileName(entry.path().c_str());
    if (!writer.Write()) return false;
  }
  return true;
#else
  return folder.empty() && syntax.empty();
#endif
}

}  // namespace dvrlab::test
