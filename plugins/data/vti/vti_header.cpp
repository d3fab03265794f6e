#include "plugins/data/vti/vti_header.h"

#include <algorithm>
#include <bit>
#include <cctype>

#include "framework/interfaces/error.h"
#include "plugins/data/vti/attributes.h"
#include "plugins/data/vti/xml_scan.h"

namespace dvrlab::vti {
namespace {

bool is_space(std::byte b) { return std::isspace(std::to_integer<unsigned char>(b)) != 0; }

Compression compression_of(const Attributes& root) {
  const std::string name = root.text("compressor", "");
  if (name.empty()) return Compression::none;
  if (name == "vtkZLibDataCompressor") return Compression::zlib;
  if (name == "vtkLZ4DataCompressor") return Compression::lz4;
  if (name == "vtkLZMADataCompressor") return Compression::lzma;
  root.fail("compressor \"" + name + "\" is not known; zlib, LZ4 and LZMA are read");
}

Extent extent_of(const Attributes& element, const std::string& attribute) {
  const auto numbers = element.integers(attribute, 6);
  Extent extent;
  std::copy_n(numbers.begin(), 6, extent.begin());
  return extent;
}

constexpr const char* array_path = "/VTKFile/ImageData/Piece/PointData/DataArray";

class Reader : public XmlVisitor {
 public:
  Reader(std::span<const std::byte> file, const std::string& name) : file_(file), name_(name) {}

  bool open(const XmlElement& e) override {
    const Attributes a(e, name_);
    const std::string parent = path_.empty() ? "" : path_.back();
    if (parent == array_path) end_text(e.tag_begin);
    path_.push_back(parent + '/' + e.name);
    const std::string& path = path_.back();
    if (parent.empty()) {
      read_root(e, a);
    } else if (path == "/VTKFile/ImageData") {
      read_grid(a);
    } else if (path == "/VTKFile/ImageData/Piece") {
      header_.pieces.push_back({extent_of(a, "Extent"), "", {}, 0});
    } else if (path == "/VTKFile/ImageData/Piece/PointData") {
      header_.pieces.back().scalars = a.text("Scalars", "");
    } else if (path == array_path) {
      read_array(e, a);
    } else if (path == "/VTKFile/ImageData/Piece/CellData/DataArray") {
      ++header_.pieces.back().cell_arrays;
    } else if (path == "/VTKFile/AppendedData") {
      read_appended(e, a);
      return false;  // raw data is no XML
    }
    return true;
  }

  void close(const std::string&, std::size_t begin, std::size_t end) override {
    if (path_.back() == array_path) end_text(begin);
    path_.pop_back();
    // VTK writes information keys as children of an array; its numbers may stand behind them.
    if (!path_.empty() && path_.back() == array_path) text_begin_ = end;
  }

  VtiHeader finish() const {
    if (!grid_) throw InputError(name_ + ": holds no <ImageData>");
    if (header_.pieces.empty()) throw InputError(name_ + ": <ImageData> holds no <Piece>");
    return header_;
  }

 private:
  void read_root(const XmlElement& e, const Attributes& a) {
    if (e.name != "VTKFile") a.fail("is the root element; a VTK XML file has <VTKFile>");
    const std::string type = a.require("type");
    if (type == "PImageData")
      a.fail("type is \"PImageData\", a list of other files; name one of these, or store the volume as one .vti file");
    if (type != "ImageData") a.fail("type is \"" + type + "\"; only ImageData, a regular grid, is read");
    const std::string order = a.text("byte_order", "LittleEndian");
    if (order != "LittleEndian" && order != "BigEndian")
      a.fail("byte_order is \"" + order + "\"; must be LittleEndian or BigEndian");
    header_.swap = (order == "LittleEndian") != (std::endian::native == std::endian::little);
    const std::string word = a.text("header_type", "UInt32");
    if (word != "UInt32" && word != "UInt64") a.fail("header_type is \"" + word + "\"; must be UInt32 or UInt64");
    header_.word = word == "UInt32" ? 4 : 8;
    header_.compression = compression_of(a);
  }

  void read_grid(const Attributes& a) {
    if (grid_) a.fail("stands twice");
    grid_ = true;
    header_.whole = extent_of(a, "WholeExtent");
    auto origin = a.numbers("Origin", 3), spacing = a.numbers("Spacing", 3), direction = a.numbers("Direction", 9);
    origin.resize(3, 0);
    if (spacing.empty()) spacing = {1, 1, 1};
    if (std::count(spacing.begin(), spacing.end(), 0) > 0) a.fail("Spacing holds a 0; a spacing is another number");
    if (direction.empty()) direction = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    Affine& affine = header_.to_world;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) affine.m[3 * r + c] = direction[3 * r + c] * spacing[c];
    // Origin is the place of point (0, 0, 0), which need not lie in the extent.
    const Extent& x = header_.whole;
    affine.t = {origin[0], origin[1], origin[2]};
    affine.t = affine.point({static_cast<double>(x[0]), static_cast<double>(x[2]), static_cast<double>(x[4])});
  }

  void read_array(const XmlElement& e, const Attributes& a) {
    DataArray array;
    array.name = a.text("Name", "");
    array.type = a.require("type");
    array.line = e.line;
    array.components = static_cast<long long>(std::min(a.natural("NumberOfComponents", 1), 1ull << 31));
    const std::string format = a.text("format", "ascii");
    if (format == "ascii") {
      array.format = Format::ascii;
    } else if (format == "binary") {
      array.format = Format::inline_base64;
    } else if (format == "appended") {
      array.format = Format::appended;
      a.require("offset");
      array.offset = a.natural("offset", 0);
    } else {
      a.fail("format is \"" + format + "\"; must be ascii, binary or appended");
    }
    header_.pieces.back().arrays.push_back(array);
    text_begin_ = e.tag_end;
  }

  // The text of the open array ends at the next tag, unless nothing stood before it.
  void end_text(std::size_t end) {
    const auto text = file_.subspan(text_begin_, end - text_begin_);
    if (std::all_of(text.begin(), text.end(), is_space)) return;
    std::span<const std::byte>& kept = header_.pieces.back().arrays.back().text;
    if (kept.empty()) kept = text;
  }

  void read_appended(const XmlElement& e, const Attributes& a) {
    const std::string encoding = a.require("encoding");
    if (encoding != "raw" && encoding != "base64") a.fail("encoding is \"" + encoding + "\"; must be raw or base64");
    header_.appended_base64 = encoding == "base64";
    auto rest = file_.subspan(e.tag_end);
    const auto begin = std::find_if_not(rest.begin(), rest.end(), is_space);
    if (begin == rest.end() || *begin != std::byte{'_'}) a.fail("does not begin with \"_\"; the file is cut off");
    rest = rest.subspan(static_cast<std::size_t>(begin - rest.begin()) + 1);
    if (header_.appended_base64)
      rest = rest.first(static_cast<std::size_t>(std::find(rest.begin(), rest.end(), std::byte{'<'}) - rest.begin()));
    header_.appended = rest;
  }

  std::span<const std::byte> file_;
  const std::string& name_;
  VtiHeader header_;
  bool grid_ = false;
  std::vector<std::string> path_;  // of the open elements: "/VTKFile", "/VTKFile/ImageData"
  std::size_t text_begin_ = 0;     // inside an array: where its text begins
};

}  // namespace

std::array<long long, 3> dims_of(const Extent& x) { return {x[1] - x[0] + 1, x[3] - x[2] + 1, x[5] - x[4] + 1}; }

VtiHeader read_header(std::span<const std::byte> file, const std::string& name) {
  Reader reader(file, name);
  scan_xml(file, name, reader);
  return reader.finish();
}

}  // namespace dvrlab::vti
