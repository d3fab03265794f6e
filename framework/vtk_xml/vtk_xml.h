// What the XML files of VTK have in common: how numbers are coded, and where the bytes of each array lie.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/vtk_xml/attributes.h"
#include "framework/vtk_xml/xml_scan.h"

namespace dvrlab::vtk_xml {

enum class Format { ascii, inline_base64, appended };
enum class Compression { none, zlib, lz4, lzma };

/// A <DataArray>.
struct DataArray {
  std::string name, type;  // type: "Float32"
  std::size_t line = 0;
  long long components = 1;
  Format format = Format::ascii;
  std::span<const std::byte> text;  // ascii, inline_base64: what stands between the tags
  std::uint64_t offset = 0;         // appended: from the byte behind the section's "_"
};

/// The root element and the appended section.
struct XmlFile {
  bool swap = false;
  int word = 4;  // bytes of a number in the headers of binary data: 4 or 8
  Compression compression = Compression::none;
  std::span<const std::byte> appended;  // behind the "_"; base64: up to the end tag
  bool appended_base64 = false;
};

/// Whether a file is one of them: by the end of its name (".vti"), or by the root's type ("ImageData") in its first
/// bytes. Folders are none.
bool is_file_of(const std::string& type, const std::string& end, const std::string& path,
                std::span<const std::byte> start);

/// Reads the root, every <DataArray> that a format wants, and the appended section; a format adds its own elements.
class FileReader : public XmlVisitor {
 public:
  /// `type`: what the root must be ("ImageData"); `name`: the file, for messages.
  FileReader(std::span<const std::byte> file, const std::string& name, XmlFile& out)
      : file_(file), name_(name), out_(out) {}

  bool open(const XmlElement& e) final;
  void close(const std::string& element, std::size_t begin, std::size_t end) final;

 protected:
  /// Judges the root's attribute `type`; throws InputError by a.fail().
  virtual void check_type(const std::string& type, const Attributes& a) = 0;
  /// The list in which the array at this place ("/VTKFile/ImageData/Piece/PointData/DataArray") is kept; null: it is
  /// not read.
  virtual std::vector<DataArray>* arrays_at(const std::string& path) = 0;
  /// An element that is neither root, array nor appended section.
  virtual void element(const std::string& path, const Attributes& a) = 0;

 private:
  void read_root(const XmlElement& e, const Attributes& a);
  void read_array(const XmlElement& e, const Attributes& a, std::vector<DataArray>& to);
  void end_text(std::size_t end);
  void read_appended(const XmlElement& e, const Attributes& a);

  std::span<const std::byte> file_;
  const std::string& name_;
  XmlFile& out_;
  std::vector<std::string> path_;           // of the open elements: "/VTKFile", "/VTKFile/ImageData"
  std::string array_path_;                  // of the array that is open, "" for none
  std::vector<DataArray>* open_ = nullptr;  // its list
  std::size_t text_begin_ = 0;              // where its text begins
};

}  // namespace dvrlab::vtk_xml
