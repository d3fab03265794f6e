#include "plugins/data/nrrd/nrrd_header.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "framework/interfaces/error.h"
#include "plugins/data/nrrd/nrrd_text.h"

namespace dvrlab::nrrd {
namespace {

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

SourceType read_type(const NrrdText& text) {
  using enum SourceType;
  static const std::map<std::string, SourceType> types{{"signed char", i8},
                                                       {"int8", i8},
                                                       {"int8_t", i8},
                                                       {"uchar", u8},
                                                       {"unsigned char", u8},
                                                       {"uint8", u8},
                                                       {"uint8_t", u8},
                                                       {"short", i16},
                                                       {"short int", i16},
                                                       {"signed short", i16},
                                                       {"signed short int", i16},
                                                       {"int16", i16},
                                                       {"int16_t", i16},
                                                       {"ushort", u16},
                                                       {"unsigned short", u16},
                                                       {"unsigned short int", u16},
                                                       {"uint16", u16},
                                                       {"uint16_t", u16},
                                                       {"int", i32},
                                                       {"signed int", i32},
                                                       {"int32", i32},
                                                       {"int32_t", i32},
                                                       {"uint", u32},
                                                       {"unsigned int", u32},
                                                       {"uint32", u32},
                                                       {"uint32_t", u32},
                                                       {"longlong", i64},
                                                       {"long long", i64},
                                                       {"long long int", i64},
                                                       {"signed long long", i64},
                                                       {"signed long long int", i64},
                                                       {"int64", i64},
                                                       {"int64_t", i64},
                                                       {"ulonglong", u64},
                                                       {"unsigned long long", u64},
                                                       {"unsigned long long int", u64},
                                                       {"uint64", u64},
                                                       {"uint64_t", u64},
                                                       {"float", f32},
                                                       {"double", f64}};
  const std::string name = lower(text.require("type"));
  const auto found = types.find(name);
  if (found == types.end())
    text.fail("type", "\"" + name + "\" is no number type; integers of 8 to 64 bits, float and double are read");
  return found->second;
}

// Three axes in space, one number each.
std::array<long long, 3> read_dims(const NrrdText& text) {
  const long long dimension = text.integers("dimension", 1)[0];
  if (dimension != 3)
    text.fail("dimension", "is " + std::to_string(dimension) +
                               "; only 3-D scalar volumes are read: cut out one volume or one component first");
  for (const std::string& kind : text.words("kinds")) {
    const std::string k = lower(kind);
    if (k != "domain" && k != "space" && k != "none" && k != "???")
      text.fail("kinds", "an axis of kind \"" + kind + "\" does not lie in space; only 3-D scalar volumes are read");
  }
  const auto sizes = text.integers("sizes", 3);
  return {sizes[0], sizes[1], sizes[2]};
}

bool read_gzip(const NrrdText& text) {
  const std::string encoding = lower(text.require("encoding"));
  if (encoding == "raw") return false;
  if (encoding == "gzip" || encoding == "gz") return true;
  throw NotSupported(text.name() + ": encoding \"" + encoding + "\" is not read; store the file as raw or gzip");
}

bool read_swap(const NrrdText& text, SourceType type) {
  if (bytes_of(type) == 1) return false;
  const std::string endian = lower(text.require("endian"));
  if (endian != "little" && endian != "big") text.fail("endian", "is \"" + endian + "\"; must be little or big");
  return (endian == "little") != (std::endian::native == std::endian::little);
}

// Signs that turn the named space into RAS. Spaces without anatomy stay as they are.
std::array<double, 3> read_space(const NrrdText& text, std::vector<std::string>& notes) {
  if (const auto count = text.find("space dimension"); count && *count != "3")
    text.fail("space dimension", "is " + *count + "; the space of a volume has 3");
  const std::string space = lower(text.find("space").value_or(""));
  if (space == "left-posterior-superior" || space == "lps") {
    notes.push_back("world frame: RAS, the file's LPS coordinates with x and y negated");
    return {-1, -1, 1};
  }
  if (space == "left-anterior-superior" || space == "las") {
    notes.push_back("world frame: RAS, the file's LAS coordinates with x negated");
    return {-1, 1, 1};
  }
  if (space == "right-anterior-superior" || space == "ras") return {1, 1, 1};
  if (!space.empty() && space != "scanner-xyz" && space != "3d-right-handed" && space != "3d-left-handed")
    text.fail("space", "\"" + space + "\" is no space of three dimensions");
  notes.push_back("world frame: the file's own coordinates; it names no anatomical space");
  return {1, 1, 1};
}

Affine read_affine(const NrrdText& text, std::vector<std::string>& notes) {
  Affine a;
  const auto directions = text.vectors("space directions", 3);
  auto spacings = text.numbers("spacings", 3);
  if (directions.empty() && spacings.empty()) notes.push_back("the file has no spacing: 1 along each axis");
  if (!directions.empty() && !spacings.empty()) notes.push_back("`space directions` are used, `spacings` are not");
  if (directions.empty() && (text.find("axis mins") || text.find("axis maxs")))
    notes.push_back("`axis mins` and `axis maxs` are not used");
  spacings.resize(3, 1.0);
  for (std::size_t c = 0; c < 3; ++c) {
    if (std::isnan(spacings[c])) {
      notes.push_back("an unknown spacing (nan) is taken as 1");
      spacings[c] = 1;
    }
    for (std::size_t r = 0; r < 3; ++r)
      a.m[3 * r + c] = directions.empty() ? (r == c ? spacings[c] : 0) : directions[c][r];
  }
  if (const auto origin = text.vectors("space origin", text.find("space origin") ? 1 : 0); !origin.empty())
    a.t = {origin[0][0], origin[0][1], origin[0][2]};
  const auto sign = read_space(text, notes);
  for (std::size_t r = 0; r < 3; ++r) {
    if (sign[r] > 0) continue;
    for (std::size_t c = 0; c < 3; ++c) a.m[3 * r + c] = 0 - a.m[3 * r + c];  // 0 - x: no negative zero
    a.t[r] = 0 - a.t[r];
  }
  for (const double x : a.m)
    if (!std::isfinite(x))
      text.fail(directions.empty() ? "spacings" : "space directions", "holds a number that is not finite");
  for (const double x : a.t)
    if (!std::isfinite(x)) text.fail("space origin", "holds a number that is not finite");
  return a;
}

}  // namespace

NrrdHeader read_header(std::span<const std::byte> file, const std::string& name) {
  const NrrdText text(file, name);
  NrrdHeader h;
  h.type = read_type(text);
  h.dims = read_dims(text);
  grid_bytes(h.dims, bytes_of(h.type), name);
  h.gzip = read_gzip(text);
  h.swap = read_swap(text, h.type);
  h.to_world = read_affine(text, h.notes);
  const std::string space = lower(text.find("space").value_or(""));
  h.anatomical =
      space.starts_with("left-") || space.starts_with("right-") || space == "lps" || space == "las" || space == "ras";
  h.header_size = text.end();
  if (text.find("line skip")) h.line_skip = text.integers("line skip", 1)[0];
  if (text.find("byte skip")) h.byte_skip = text.integers("byte skip", 1)[0];
  if (h.line_skip < 0) text.fail("line skip", "is negative");
  if (h.byte_skip < (h.gzip ? 0 : -1))
    text.fail("byte skip", h.gzip ? "is negative; only raw data can be counted from the end" : "is below -1");
  if (text.find("old min") || text.find("old max"))
    h.notes.push_back("`old min` and `old max` are not applied: values are the stored numbers");
  if (const auto data_file = text.find("data file")) {
    h.data_file = text.require("data file");
    if (h.data_file.starts_with("LIST") || h.data_file.find('%') != std::string::npos)
      throw NotSupported(name + ": the voxels lie in several files; join them into one (unu save)");
  } else if (!text.ended()) {
    throw InputError(name + ": has neither a \"data file\" nor voxels behind its header");
  }
  return h;
}

}  // namespace dvrlab::nrrd
