// The fields "name: value" of a text header, before any of them has a meaning.
#pragma once

#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dvrlab {

/// Without the blanks around it.
std::string trimmed(const std::string& s);
std::string lower_case(std::string s);
/// In double quotes, for messages; long texts are cut.
std::string quoted(const std::string& s);

/// The whole word as a number; a leading plus is allowed.
template <class T>
std::optional<T> parse_number(const std::string& word) {
  T x{};
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(first, word.data() + word.size(), x);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return x;
}

/// Fields are found by name, without regard to case and blanks ("data file" finds "DataFile"). Every error names the
/// header's file, and the line where there is one.
class HeaderFields {
 public:
  /// `name` is the file, for messages.
  explicit HeaderFields(std::string name) : name_(std::move(name)) {}

  /// Throws InputError when the field is there already.
  void add(const std::string& field, const std::string& text, int line);

  /// The field's text; nullopt when the header lacks it.
  std::optional<std::string> find(const std::string& field) const;
  /// Throws InputError when the header lacks it.
  std::string require(const std::string& field) const;
  /// Blank-separated words; empty when the header lacks the field.
  std::vector<std::string> words(const std::string& field) const;
  /// `count` whole numbers; throws InputError when the header lacks the field.
  std::vector<long long> integers(const std::string& field, std::size_t count) const;
  /// One whole number, `otherwise` when the header lacks the field.
  long long integer(const std::string& field, long long otherwise) const;
  /// `count` numbers; empty when the header lacks the field. An infinite one is refused, NaN is not.
  std::vector<double> numbers(const std::string& field, std::size_t count) const;

  /// "file: line 7, field "sizes": " in front of `what`.
  [[noreturn]] void fail(const std::string& field, const std::string& what) const;
  const std::string& name() const { return name_; }

 private:
  struct Line {
    std::string text;
    int number;
  };
  std::map<std::string, Line> fields_;
  std::string name_;
};

/// "spacedirections" of "Space Directions": what fields are compared by.
std::string field_key(const std::string& field);

}  // namespace dvrlab
