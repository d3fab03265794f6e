// The elements of a data set as numbers and words. Every error names the file and the element.
#pragma once

#include <gdcmDataSet.h>

#include <optional>
#include <string>
#include <vector>

namespace dvrlab::dicom {

/// An element's tag with its name in the standard, for messages.
struct Key {
  std::uint16_t group, element;
  const char* name;
};

class Elements {
 public:
  /// `name`: the file.
  Elements(const gdcm::DataSet& set, std::string name) : set_(set), name_(std::move(name)) {}

  bool has(const Key& key) const;
  /// Without padding; "" when the element is missing or empty. Characters beyond ASCII become "?": their character set
  /// is not looked at.
  std::string text(const Key& key) const;
  /// A whole number of 16 bits (VR US). Throws InputError when it is missing.
  int whole(const Key& key) const;
  int whole(const Key& key, int otherwise) const;
  /// Decimal strings "1.5\2"; empty when the element is missing. Throws InputError unless they are `count` finite
  /// numbers.
  std::vector<double> decimals(const Key& key, std::size_t count) const;
  /// Item `index` of a sequence.
  std::optional<Elements> item(const Key& key, std::size_t index) const;

  /// "file: Rows (0028,0010)" in front of `what`.
  [[noreturn]] void fail(const Key& key, const std::string& what) const;
  const std::string& name() const { return name_; }

 private:
  [[noreturn]] void fail_decimals(const Key& key, const std::string& text, std::size_t count) const;
  gdcm::DataSet set_;
  std::string name_;
};

}  // namespace dvrlab::dicom
