// A small DICOM series that the tests spoil in many ways.
#pragma once

#include <numeric>
#include <string>
#include <vector>

#include "tests/data/dicom_writer.h"

namespace dvrlab::test {

class DicomTest : public testing::Test {
 protected:
  void SetUp() override;  // skips without the plugin
};

/// Axial slices, 2 mm apart, 16 bits unsigned, in the order of their positions.
class DicomSeries {
 public:
  explicit DicomSeries(int columns = 4, int rows = 3, int slices = 5);

  std::vector<DicomSet> slice;
  /// The pixel's value, negative for some pixels of signed types.
  double value(int i, int j, int k) const;
  /// Bits allocated and stored, sign, and the pixels.
  void set_type(int bits, bool is_signed);
  Bytes pixels(const DicomSet& of) const;

  /// Writes slice_0.dcm, ... into a new folder, whose path it returns.
  std::string write(DicomSet::Coding coding = {}, const std::string& syntax = "") const;
  void write_into(const std::string& folder, const std::string& stem, DicomSet::Coding coding = {},
                  const std::string& syntax = "") const;
  /// All slices as frames of one file, with their positions in functional groups, in reverse order.
  std::string write_multi_frame(DicomSet::Coding coding) const;
  /// One set that holds all slices as frames, without positions.
  DicomSet frames() const;

 private:
  int columns_, rows_, bits_ = 16;
  bool signed_ = false;
};

std::string new_folder();
/// Encodes the files of a folder again with GDCM. False when GDCM cannot.
bool transcode(const std::string& folder, const std::string& syntax);

}  // namespace dvrlab::test
