// DICOM files written byte by byte: what the tests of the DICOM reader read.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/data/test_data.h"

namespace dvrlab::test {

/// The elements of a data set by tag (0xggggeeee), each with its value representation and its bytes (of whole
/// numbers: little endian).
class DicomSet {
 public:
  enum class Coding { explicit_little, implicit_little, explicit_big };

  void text(std::uint32_t tag, const std::string& vr, const std::string& value);
  void whole(std::uint32_t tag, int value);  // VR US
  void bytes(std::uint32_t tag, const std::string& vr, const Bytes& value);
  void items(std::uint32_t tag, const std::vector<DicomSet>& items);
  void erase(std::uint32_t tag) { element_.erase(tag); }

  /// The elements in the order of their tags.
  Bytes coded(Coding coding) const;
  /// A file: preamble, meta header, elements. `syntax`: the UID of a transfer syntax other than the coding's own.
  Bytes file(Coding coding = Coding::explicit_little, const std::string& syntax = "") const;

 private:
  struct Element {
    std::string vr;
    Bytes value;
    std::vector<DicomSet> items;
    bool fragments = false;
  };
  std::map<std::uint32_t, Element> element_;
};

/// A grey image with a place in space: MR, 16 bits unsigned, spacing 1 x 1 mm, axial, rescale 1 and 0.
/// `pixels`: little endian, columns * rows of them.
DicomSet dicom_slice(int columns, int rows, const std::string& position, const Bytes& pixels);

/// Pixel data of a compressed transfer syntax: an empty offset table and one fragment.
Bytes dicom_fragments(const Bytes& compressed);
/// RLE (PS3.5, G) of one frame, by literal runs: a segment per byte of a pixel, the highest first.
Bytes dicom_rle(const Bytes& pixels, std::size_t bytes_per_pixel);

}  // namespace dvrlab::test
