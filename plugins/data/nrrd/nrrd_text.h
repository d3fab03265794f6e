// The text of a NRRD header as fields, before any of them has a meaning.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/interfaces/parameter_set.h"
#include "framework/scene/header_fields.h"

namespace dvrlab::nrrd {

/// The fields that the format allows, each once; comments and key/value pairs are dropped. The lines behind
/// "data file: LIST" are the files' names.
class NrrdText : public HeaderFields {
 public:
  /// Throws InputError for another magic, a line that is no field, an unknown or repeated field.
  NrrdText(std::span<const std::byte> file, const std::string& name);

  /// `count` vectors "(x,y,z)", nullopt for an axis with "none"; empty when the header lacks the field.
  std::vector<std::optional<Vector3>> vectors(const std::string& field, std::size_t count) const;
  /// Texts in double quotes; empty when the header lacks the field.
  std::vector<std::string> quoted_texts(const std::string& field) const;

  const std::vector<std::string>& listed_files() const { return listed_; }
  /// True when an empty line ends the header: voxels may follow at end().
  bool ended() const { return ended_; }
  std::size_t end() const { return end_; }

 private:
  void add_line(const std::string& line, int number);
  std::vector<std::string> listed_;
  std::size_t end_ = 0;
  bool ended_ = false, listing_ = false;
};

}  // namespace dvrlab::nrrd
