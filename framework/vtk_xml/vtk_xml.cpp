#include "framework/vtk_xml/vtk_xml.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "framework/interfaces/error.h"

namespace dvrlab::vtk_xml {
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

}  // namespace

bool is_file_of(const std::string& type, const std::string& end, const std::string& path,
                std::span<const std::byte> start) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) return false;
  std::string last = path.substr(path.size() - std::min(path.size(), end.size()));
  std::transform(last.begin(), last.end(), last.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
  const auto root = text.find("<VTKFile");
  return last == end ||
         (root != std::string_view::npos && text.find("\"" + type + "\"", root) != std::string_view::npos);
}

bool FileReader::open(const XmlElement& e) {
  const Attributes a(e, name_);
  const std::string parent = path_.empty() ? "" : path_.back();
  if (!array_path_.empty() && parent == array_path_) end_text(e.tag_begin);
  path_.push_back(parent + '/' + e.name);
  const std::string& path = path_.back();
  if (parent.empty()) {
    read_root(e, a);
  } else if (path == "/VTKFile/AppendedData") {
    read_appended(e, a);
    return false;  // raw data is no XML
  } else if (std::vector<DataArray>* list = e.name == "DataArray" ? arrays_at(path) : nullptr) {
    read_array(e, a, *list);
  } else {
    element(path, a);
  }
  return true;
}

void FileReader::close(const std::string&, std::size_t begin, std::size_t end) {
  const bool array = !array_path_.empty() && path_.back() == array_path_;
  if (array) {
    end_text(begin);
    array_path_.clear();
  }
  path_.pop_back();
  // VTK writes information keys as children of an array; its numbers may stand behind them.
  if (!path_.empty() && path_.back() == array_path_) text_begin_ = end;
}

void FileReader::read_root(const XmlElement& e, const Attributes& a) {
  if (e.name != "VTKFile") a.fail("is the root element; a VTK XML file has <VTKFile>");
  check_type(a.require("type"), a);
  const std::string order = a.text("byte_order", "LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian")
    a.fail("byte_order is \"" + order + "\"; must be LittleEndian or BigEndian");
  out_.swap = (order == "LittleEndian") != (std::endian::native == std::endian::little);
  const std::string word = a.text("header_type", "UInt32");
  if (word != "UInt32" && word != "UInt64") a.fail("header_type is \"" + word + "\"; must be UInt32 or UInt64");
  out_.word = word == "UInt32" ? 4 : 8;
  out_.compression = compression_of(a);
}

void FileReader::read_array(const XmlElement& e, const Attributes& a, std::vector<DataArray>& to) {
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
  to.push_back(array);
  open_ = &to;
  array_path_ = path_.back();
  text_begin_ = e.tag_end;
}

// The text of the open array ends at the next tag, unless nothing stood before it.
void FileReader::end_text(std::size_t end) {
  const auto text = file_.subspan(text_begin_, end - text_begin_);
  if (std::all_of(text.begin(), text.end(), is_space)) return;
  std::span<const std::byte>& kept = open_->back().text;
  if (kept.empty()) kept = text;
}

void FileReader::read_appended(const XmlElement& e, const Attributes& a) {
  const std::string encoding = a.require("encoding");
  if (encoding != "raw" && encoding != "base64") a.fail("encoding is \"" + encoding + "\"; must be raw or base64");
  out_.appended_base64 = encoding == "base64";
  auto rest = file_.subspan(e.tag_end);
  const auto begin = std::find_if_not(rest.begin(), rest.end(), is_space);
  if (begin == rest.end() || *begin != std::byte{'_'}) a.fail("does not begin with \"_\"; the file is cut off");
  rest = rest.subspan(static_cast<std::size_t>(begin - rest.begin()) + 1);
  if (out_.appended_base64)
    rest = rest.first(static_cast<std::size_t>(std::find(rest.begin(), rest.end(), std::byte{'<'}) - rest.begin()));
  out_.appended = rest;
}

}  // namespace dvrlab::vtk_xml
