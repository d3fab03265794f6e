// The text of a MetaImage header as fields, before any of them has a meaning.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "framework/scene/header_fields.h"

namespace dvrlab::metaimage {

/// The lines "Key = value" up to ElementDataFile, which ends the header, and the names behind "ElementDataFile = LIST".
class MetaText : public HeaderFields {
 public:
  /// Throws InputError for a file that does not start with a key of the format, a line that is no field, a repeated
  /// field, and a header without ElementDataFile.
  MetaText(std::span<const std::byte> file, const std::string& name);

  /// The names under which `fields` stand in the header mean the same: the one that is there, "" when none is.
  /// Throws InputError when two of them disagree.
  std::string one_of(const std::vector<std::string>& fields) const;
  /// True or False; `otherwise` when the header lacks the field.
  bool flag(const std::string& field, bool otherwise) const;

  const std::vector<std::string>& listed_files() const { return listed_; }
  /// Keys that the format does not define. It allows them: programs put their own there.
  const std::vector<std::string>& unknown() const { return unknown_; }
  /// Where local voxels start.
  std::size_t end() const { return end_; }

 private:
  void add_line(const std::string& line, int number);
  std::vector<std::string> listed_, unknown_;
  std::size_t end_ = 0;
};

}  // namespace dvrlab::metaimage
