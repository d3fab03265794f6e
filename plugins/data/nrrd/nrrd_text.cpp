#include "plugins/data/nrrd/nrrd_text.h"

#include <algorithm>
#include <cmath>
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

}  // namespace

NrrdText::NrrdText(std::span<const std::byte> file, const std::string& name) : HeaderFields(name) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), std::min(file.size(), longest_header));
  if (!text.starts_with("NRRD000")) throw InputError(name + ": is no NRRD file; its first bytes are not \"NRRD000\"");
  if (const char version = text.size() > 7 ? text[7] : ' '; version < '1' || version > '5')
    throw InputError(name + ": line 1 is " +
                     quoted(std::string(text.substr(0, std::min<std::size_t>(text.find('\n'), 20)))) +
                     "; the versions NRRD0001 to NRRD0005 are read");
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
  const std::string where = name() + ": line " + std::to_string(number);
  if (listing_) return listed_.push_back(trimmed(line));
  if (line.starts_with('#')) return;
  const std::size_t colon = line.find(':');
  if (colon == std::string::npos) {
    const bool readable = std::all_of(line.begin(), line.end(), [](unsigned char c) { return c >= 32 || c == '\t'; });
    throw InputError(where + (readable ? " is no field \"name: value\": " + quoted(line)
                                       : " is binary; an empty line must separate the header from the voxels"));
  }
  if (line.compare(colon, 2, ":=") == 0) return;  // key/value pair
  const std::string field = line.substr(0, colon), text = trimmed(line.substr(colon + 1));
  const auto known = [&](const std::string& k) { return field_key(k) == field_key(field); };
  if (std::none_of(known_fields.begin(), known_fields.end(), known)) {
    const std::string nearest = nearest_name(field, known_fields);
    throw InputError(where + ": the format has no field " + quoted(field) +
                     (nearest.empty() ? "" : ", the nearest is " + quoted(nearest)) +
                     "; a key of your own is written \"key:=value\"");
  }
  add(field, text, number);
  listing_ = field_key(field) == "datafile" && (text == "LIST" || text.starts_with("LIST "));
}

std::vector<std::optional<Vector3>> NrrdText::vectors(const std::string& field, std::size_t count) const {
  std::vector<std::optional<Vector3>> out;
  const auto text = find(field);
  if (!text) return out;
  for (std::size_t i = text->find_first_not_of(" \t"); i < text->size(); i = text->find_first_not_of(" \t", i)) {
    if (text->compare(i, 4, "none") == 0) {
      out.push_back(std::nullopt);
      i += 4;
      continue;
    }
    const std::size_t close = text->find(')', i);
    if ((*text)[i] != '(' || close == std::string::npos)
      fail(field, quoted(text->substr(i)) + " is no vector \"(x,y,z)\"; each axis of a volume has one");
    std::istringstream inside(text->substr(i + 1, close - i - 1));
    std::vector<double> v;
    for (std::string word; std::getline(inside, word, ',');) {
      const auto x = parse_number<double>(trimmed(word));
      if (!x) fail(field, quoted(word) + " is no number");
      if (!std::isfinite(*x)) fail(field, "holds a number that is not finite");
      v.push_back(*x);
    }
    if (v.size() != 3)
      fail(field, "a vector has " + std::to_string(v.size()) + " components; the space of a volume has 3");
    out.push_back(Vector3{v[0], v[1], v[2]});
    i = close + 1;
  }
  if (out.size() != count) fail(field, "has " + std::to_string(out.size()) + " vectors, not " + std::to_string(count));
  return out;
}

std::vector<std::string> NrrdText::quoted_texts(const std::string& field) const {
  std::vector<std::string> out;
  const std::string text = find(field).value_or("");
  for (std::size_t open = text.find('"'); open != std::string::npos;) {
    const std::size_t close = text.find('"', open + 1);
    if (close == std::string::npos) fail(field, "a text has no closing quote");
    out.push_back(text.substr(open + 1, close - open - 1));
    open = text.find('"', close + 1);
  }
  return out;
}

}  // namespace dvrlab::nrrd
