// The text of a NRRD header as fields, before any of them has a meaning.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dvrlab::nrrd {

/// Fields by name, lower case and without blanks ("spacedirections"): the names that the format allows, each once.
/// Comments and key/value pairs are dropped. Every error names the file, and the line where there is one.
class NrrdText {
 public:
  /// Throws InputError for another magic, a line that is no field, an unknown or repeated field.
  NrrdText(std::span<const std::byte> file, const std::string& name);

  /// The field's text; nullopt when the header lacks it.
  std::optional<std::string> find(const std::string& field) const;
  /// Throws InputError when the header lacks it. `field` is the name as the format writes it ("data file").
  std::string require(const std::string& field) const;
  /// `count` whole numbers.
  std::vector<long long> integers(const std::string& field, std::size_t count) const;
  /// `count` numbers, "nan" allowed; empty when the header lacks the field.
  std::vector<double> numbers(const std::string& field, std::size_t count) const;
  /// `count` vectors "(x,y,z)"; empty when the header lacks the field. Throws InputError for "none".
  std::vector<std::vector<double>> vectors(const std::string& field, std::size_t count) const;
  /// Blank-separated words; empty when the header lacks the field.
  std::vector<std::string> words(const std::string& field) const;

  /// "file: line 7 (sizes): " in front of `what`.
  [[noreturn]] void fail(const std::string& field, const std::string& what) const;

  const std::string& name() const { return name_; }
  /// True when an empty line ends the header: voxels may follow at end().
  bool ended() const { return ended_; }
  std::size_t end() const { return end_; }

 private:
  struct Line {
    std::string text;
    int number;
  };
  void add_line(const std::string& line, int number);
  std::map<std::string, Line> fields_;
  std::string name_;
  std::size_t end_ = 0;
  bool ended_ = false;
};

}  // namespace dvrlab::nrrd
