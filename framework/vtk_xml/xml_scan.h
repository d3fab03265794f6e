// A walk over the elements of an XML file that lies in memory, without a copy of it: expat reads, the visitor is told.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>

namespace dvrlab::vtk_xml {

/// A start tag.
struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::size_t line = 0;       // of the tag, from 1
  std::size_t tag_begin = 0;  // bytes from the start of the file to "<"
  std::size_t tag_end = 0;    // behind ">"
};

class XmlVisitor {
 public:
  virtual ~XmlVisitor() = default;
  /// False ends the walk: what follows the tag need not be XML.
  virtual bool open(const XmlElement& element) = 0;
  /// `begin`, `end`: the end tag's place; both are the element's tag_end for an empty element "<a/>".
  virtual void close(const std::string& name, std::size_t begin, std::size_t end) = 0;
};

/// Throws InputError ("name: line 3: ...") for what is no well-formed XML and for a document type declaration, which
/// none of the formats needs; passes on what the visitor throws.
void scan_xml(std::span<const std::byte> file, const std::string& name, XmlVisitor& visitor);

}  // namespace dvrlab::vtk_xml
