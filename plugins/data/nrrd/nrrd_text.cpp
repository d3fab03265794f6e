#include "plugins/data/nrrd/nrrd_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "framework/interfaces/error.h"
#include "framework/plugin/registry.h"

namespace dvrlab::nrrd {
namespace {

constexpr std::size_t longest_header = 1 << 20;

const std::vector<std::string> known_fields{"axis maxs",
                                            "axis mins",
                                            "block size",
                                            "byte skip",
                                            "centerings",
                                            "centers",
                                            "content",
                                            "data file",
                                            "dimension",
                                            "encoding",
                                            "endian",
                                            "kinds",
                                            "labels",
                                            "line skip",
                                            "max",
                                            "measurement frame",
                                            "min",
                                            "number",
                                            "old max",
                                            "old min",
                                            "sample units",
                                            "sizes",
                                            "space",
                                            "space dimension",
                                            "spacings",
                                            "space origin",
                                            "space directions",
                                            "space units",
                                            "thicknesses",
                                            "type",
                                            "units"};

std::string squeezed(const std::string& field) {
  std::string out;
  for (const char c : field)
    if (c != ' ' && c != '\t') out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::string trimmed(const std::string& s) {
  const auto first = s.find_first_not_of(" \t");
  return first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(" \t") - first + 1);
}

std::string quoted(const std::string& s) { return '"' + s + '"'; }

template <class T>
std::optional<T> parse(const std::string& word) {
  T x{};
  const char* first = word.data() + (word.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(first, word.data() + word.size(), x);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return x;
}

}  // namespace

NrrdText::NrrdText(std::span<const std::byte> file, const std::string& name) : name_(name) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), std::min(file.size(), longest_header));
  if (!text.starts_with("NRRD000")) throw InputError(name + ": is no NRRD file; its first bytes are not \"NRRD000\"");
  int number = 1;
  while (end_ < text.size() && !ended_) {
    const std::size_t stop = std::min(text.find('\n', end_), text.size());
    std::string line(text.substr(end_, stop - end_));
    if (line.ends_with('\r')) line.pop_back();
    end_ = std::min(stop + 1, text.size());
    ended_ = line.empty();
    if (!ended_ && number > 1) add_line(line, number);
    ++number;
  }
  if (!ended_ && file.size() > longest_header)
    throw InputError(name + ": the header has no end (an empty line) in its first " + std::to_string(longest_header) +
                     " bytes");
}

void NrrdText::add_line(const std::string& line, int number) {
  const std::string where = name_ + ": line " + std::to_string(number);
  if (line.starts_with('#')) return;
  const std::size_t colon = line.find(':');
  if (colon == std::string::npos) {
    const bool readable = std::all_of(line.begin(), line.end(), [](unsigned char c) { return c >= 32 || c == '\t'; });
    throw InputError(where + (readable ? " is no field \"name: value\": \"" + line.substr(0, 60) + "\""
                                       : " is binary; an empty line must separate the header from the voxels"));
  }
  if (line.compare(colon, 2, ":=") == 0) return;  // key/value pair
  const std::string field = line.substr(0, colon);
  const auto known = [&](const std::string& k) { return squeezed(k) == squeezed(field); };
  if (std::none_of(known_fields.begin(), known_fields.end(), known)) {
    const std::string nearest = nearest_name(field, known_fields);
    throw InputError(where + ": the format has no field \"" + field.substr(0, 60) + "\"" +
                     (nearest.empty() ? "" : ", the nearest is \"" + nearest + "\"") +
                     "; a key of your own is written \"key:=value\"");
  }
  if (!fields_.emplace(squeezed(field), Line{trimmed(line.substr(colon + 1)), number}).second)
    throw InputError(where + ": the field \"" + field + "\" stands twice");
}

std::optional<std::string> NrrdText::find(const std::string& field) const {
  const auto found = fields_.find(squeezed(field));
  if (found == fields_.end()) return std::nullopt;
  return found->second.text;
}

std::string NrrdText::require(const std::string& field) const {
  const auto text = find(field);
  if (!text || text->empty()) throw InputError(name_ + ": the header lacks the field \"" + field + "\"");
  return *text;
}

std::vector<std::string> NrrdText::words(const std::string& field) const {
  std::istringstream in(find(field).value_or(""));
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

std::vector<long long> NrrdText::integers(const std::string& field, std::size_t count) const {
  require(field);
  std::vector<long long> out;
  for (const std::string& word : words(field)) {
    const auto x = parse<long long>(word);
    if (!x) fail(field, quoted(word) + " is no whole number");
    out.push_back(*x);
  }
  if (out.size() != count) fail(field, "has " + std::to_string(out.size()) + " numbers, not " + std::to_string(count));
  return out;
}

std::vector<double> NrrdText::numbers(const std::string& field, std::size_t count) const {
  std::vector<double> out;
  if (!find(field)) return out;
  for (const std::string& word : words(field)) {
    const auto x = parse<double>(word);
    if (!x) fail(field, quoted(word) + " is no number");
    out.push_back(*x);
  }
  if (out.size() != count) fail(field, "has " + std::to_string(out.size()) + " numbers, not " + std::to_string(count));
  return out;
}

std::vector<std::vector<double>> NrrdText::vectors(const std::string& field, std::size_t count) const {
  std::vector<std::vector<double>> out;
  const auto text = find(field);
  if (!text) return out;
  for (std::size_t i = text->find_first_not_of(" \t"); i < text->size(); i = text->find_first_not_of(" \t", i)) {
    const std::size_t close = text->find(')', i);
    if ((*text)[i] != '(' || close == std::string::npos)
      fail(field, quoted(text->substr(i, 60)) + " is no vector \"(x,y,z)\"; each axis of a volume has one");
    std::istringstream inside(text->substr(i + 1, close - i - 1));
    std::vector<double> v;
    for (std::string word; std::getline(inside, word, ',');) {
      const auto x = parse<double>(trimmed(word));
      if (!x) fail(field, quoted(word) + " is no number");
      v.push_back(*x);
    }
    if (v.size() != 3)
      fail(field, "a vector has " + std::to_string(v.size()) + " components; the space of a volume has 3");
    out.push_back(v);
    i = close + 1;
  }
  if (out.size() != count) fail(field, "has " + std::to_string(out.size()) + " vectors, not " + std::to_string(count));
  return out;
}

void NrrdText::fail(const std::string& field, const std::string& what) const {
  const auto found = fields_.find(squeezed(field));
  const std::string line = found == fields_.end() ? "" : "line " + std::to_string(found->second.number) + ", ";
  throw InputError(name_ + ": " + line + "field \"" + field + "\": " + what);
}

}  // namespace dvrlab::nrrd
