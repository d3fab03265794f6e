#include "framework/vtk_xml/xml_scan.h"

#include <expat.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "framework/interfaces/error.h"

namespace dvrlab::vtk_xml {
namespace {

using Parser = std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)>;

struct Walk {
  XML_Parser parser;
  const std::string& name;
  XmlVisitor& visitor;
  bool ended = false;          // by the visitor
  std::exception_ptr failure;  // kept while expat, which is C, returns

  // Runs `f` unless the walk is over; expat still reports what it has read already.
  template <class F>
  void run(F f) {
    if (ended || failure) return;
    try {
      f();
    } catch (...) {
      failure = std::current_exception();
    }
    if (ended || failure) XML_StopParser(parser, XML_FALSE);
  }
  std::size_t begin() const { return static_cast<std::size_t>(XML_GetCurrentByteIndex(parser)); }
  std::size_t end() const { return begin() + static_cast<std::size_t>(XML_GetCurrentByteCount(parser)); }
  std::string where() const { return name + ": line " + std::to_string(XML_GetCurrentLineNumber(parser)); }
};

void on_start(void* data, const XML_Char* name, const XML_Char** attributes) {
  auto& walk = *static_cast<Walk*>(data);
  walk.run([&] {
    XmlElement e{name, {}, XML_GetCurrentLineNumber(walk.parser), walk.begin(), walk.end()};
    for (; attributes[0]; attributes += 2) e.attributes[attributes[0]] = attributes[1];
    walk.ended = !walk.visitor.open(e);
  });
}

void on_end(void* data, const XML_Char* name) {
  auto& walk = *static_cast<Walk*>(data);
  walk.run([&] { walk.visitor.close(name, walk.begin(), walk.end()); });
}

void on_doctype(void* data, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  auto& walk = *static_cast<Walk*>(data);
  walk.run([&] { throw InputError(walk.where() + ": a document type declaration (<!DOCTYPE>) is not allowed"); });
}

}  // namespace

void scan_xml(std::span<const std::byte> file, const std::string& name, XmlVisitor& visitor) {
  const Parser parser(XML_ParserCreate(nullptr), XML_ParserFree);
  if (!parser) throw NotSupported(name + ": no memory for the XML parser");
  Walk walk{parser.get(), name, visitor, false, {}};
  XML_SetUserData(parser.get(), &walk);
  XML_SetElementHandler(parser.get(), on_start, on_end);
  XML_SetStartDoctypeDeclHandler(parser.get(), on_doctype);
  constexpr std::size_t piece = 1 << 20;
  for (std::size_t at = 0; at < file.size(); at += piece) {
    const auto part = file.subspan(at, std::min(piece, file.size() - at));
    const bool last = at + part.size() == file.size();
    const auto status =
        XML_Parse(parser.get(), reinterpret_cast<const char*>(part.data()), static_cast<int>(part.size()), last);
    if (walk.failure) std::rethrow_exception(walk.failure);
    if (walk.ended) return;
    if (status != XML_STATUS_OK)
      throw InputError(walk.where() + " is no well-formed XML (" + XML_ErrorString(XML_GetErrorCode(parser.get())) +
                       "); the file is cut off, damaged or of another format");
  }
}

}  // namespace dvrlab::vtk_xml
