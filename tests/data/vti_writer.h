// VTK ImageData files written by hand, in every coding of the format.
#pragma once

#include <string>
#include <vector>

#include "tests/data/test_data.h"

namespace dvrlab::test {

/// "" (none), "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor".
struct VtiCoding {
  std::string format = "ascii";  // ascii, binary, appended
  std::string encoding = "raw";  // of appended data: raw, base64
  std::string compressor = {};
  bool big_endian = false;
  int word = 4;             // bytes of a number in the headers of binary data
  std::size_t block = 100;  // bytes of an uncompressed block
};

/// An array of the file: its bytes in the coding's byte order, and its numbers as text.
struct VtiArray {
  std::string name, type;
  int components = 1;
  Bytes bytes;
  std::string text;
};

/// A VTK XML file of any type, element by element.
class VtkXmlWriter {
 public:
  VtkXmlWriter(const VtiCoding& coding, const std::string& type);
  void text(const std::string& xml) { text_ += xml; }
  void array(const VtiArray& a);
  Bytes finish() const;

 private:
  VtiCoding c_;
  std::string type_, text_;
  Bytes appended_;
};

struct VtiPiece {
  std::string extent, point_data;  // point_data: attributes of <PointData>
  std::vector<VtiArray> arrays;
};

struct VtiFile {
  VtiCoding coding;
  std::string whole = "0 3 0 2 0 1";
  std::string grid = R"(Origin="0 0 0" Spacing="1 1 1")";  // further attributes of <ImageData>
  std::vector<VtiPiece> pieces;
  Bytes bytes() const;
};

template <class T>
VtiArray vti_array(const std::string& name, const std::string& type, const std::vector<T>& v, const VtiCoding& c,
                   int components = 1) {
  std::string text;
  for (const T x : v) {
    char word[64];
    if constexpr (std::is_floating_point_v<T>)
      std::snprintf(word, sizeof word, "%.17g ", static_cast<double>(x));
    else
      std::snprintf(word, sizeof word, std::is_signed_v<T> ? "%lld " : "%llu ", static_cast<long long>(x));
    text += word;
  }
  return {name, type, components, bytes_of_numbers(v, c.big_endian), text};
}

/// The sizes and bytes of an array as binary data, before any base64: header, and what follows it.
std::pair<Bytes, Bytes> vti_binary(const Bytes& bytes, const VtiCoding& coding);
Bytes vti_base64(const Bytes& bytes);

}  // namespace dvrlab::test
