// The attributes of an element as numbers and words.
#pragma once

#include <string>
#include <vector>

#include "framework/vtk_xml/xml_scan.h"

namespace dvrlab::vtk_xml {

/// Every error names file, line, element and attribute.
class Attributes {
 public:
  Attributes(const XmlElement& element, const std::string& name) : element_(element), name_(name) {}

  /// The attribute's text, or `otherwise` when the element lacks it.
  std::string text(const std::string& attribute, const std::string& otherwise) const;
  /// Throws InputError when the element lacks it.
  std::string require(const std::string& attribute) const;
  /// `count` whole numbers of 32 bits. Throws InputError when the element lacks them.
  std::vector<long long> integers(const std::string& attribute, std::size_t count) const;
  /// `count` finite numbers; empty when the element lacks the attribute.
  std::vector<double> numbers(const std::string& attribute, std::size_t count) const;
  /// A whole number, not negative; `otherwise` when the element lacks it.
  unsigned long long natural(const std::string& attribute, unsigned long long otherwise) const;

  /// "file: line 4: <ImageData>" in front of `what`.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool has(const std::string& attribute) const { return element_.attributes.contains(attribute); }
  const XmlElement& element_;
  const std::string& name_;
};

}  // namespace dvrlab::vtk_xml
