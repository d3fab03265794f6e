#include "plugins/data/nrrd/nrrd_header.h"

#include <algorithm>
#include <bit>
#include <map>

#include "framework/interfaces/error.h"
#include "framework/scene/data_files.h"
#include "plugins/data/nrrd/nrrd_geometry.h"

namespace dvrlab::nrrd {
namespace {

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
  const std::string name = lower_case(text.require("type"));
  const auto found = types.find(name);
  if (found == types.end())
    text.fail("type", quoted(name) + " is no number type; integers of 8 to 64 bits, float and double are read");
  return found->second;
}

Encoding read_encoding(const NrrdText& text) {
  static const std::map<std::string, Encoding> encodings{
      {"raw", Encoding::raw},   {"gzip", Encoding::gzip},   {"gz", Encoding::gzip},
      {"hex", Encoding::hex},   {"bzip2", Encoding::bzip2}, {"bz2", Encoding::bzip2},
      {"txt", Encoding::ascii}, {"text", Encoding::ascii},  {"ascii", Encoding::ascii}};
  const auto found = encodings.find(lower_case(text.require("encoding")));
  if (found == encodings.end())
    throw NotSupported(text.name() + ": encoding " + quoted(text.require("encoding")) +
                       " is not read; store the file as raw, gzip, bzip2, ascii or hex");
  return found->second;
}

bool read_swap(const NrrdText& text, SourceType type, Encoding encoding) {
  if (bytes_of(type) == 1 || encoding == Encoding::ascii) return false;
  const std::string endian = lower_case(text.require("endian"));
  if (endian != "little" && endian != "big") text.fail("endian", "is " + quoted(endian) + "; must be little or big");
  return (endian == "little") != (std::endian::native == std::endian::little);
}

// "one.raw", "LIST [axes]" or "slice%03d.raw first last step [axes]".
DataFiles read_data_files(const NrrdText& text, const GridFile& file) {
  const std::vector<std::string> words = text.words("data file");
  const bool list = words[0] == "LIST", pattern = text.require("data file").find('%') != std::string::npos;
  if (!list && !pattern) return {{text.require("data file")}, 3};
  const auto number = [&](std::size_t i) {
    const auto x = parse_number<long long>(words[i]);
    if (!x) text.fail("data file", quoted(words[i]) + " is no whole number");
    return *x;
  };
  const std::size_t fixed = list ? 1 : 4;
  if (words.size() < fixed || words.size() > fixed + 1)
    text.fail("data file",
              list ? "must be \"LIST\", or \"LIST axes\", and one file name per line behind it"
                   : "must be a pattern, the first and last number and the step, as in \"s%03d.raw 1 9 1\"");
  DataFiles files{text.listed_files(), words.size() > fixed ? number(fixed) : 2};
  if (files.axes < 1 || files.axes > 3)
    text.fail("data file", "a file spans " + std::to_string(files.axes) + " axes; must be 1, 2 or 3");
  if (pattern) {
    long long slices = file.dims[2];
    if (files.axes == 1) slices *= file.dims[1];
    files.names = numbered_names(words[0], number(1), number(2), number(3), slices, text.name() + ": data file");
  }
  return files;
}

std::span<const std::byte> without_lines(std::span<const std::byte> bytes, long long lines, const std::string& name) {
  for (; lines > 0; --lines) {
    const auto end = std::find(bytes.begin(), bytes.end(), std::byte{'\n'});
    if (end == bytes.end()) throw InputError(name + ": `line skip` drops more lines than the file has");
    bytes = bytes.subspan(static_cast<std::size_t>(end - bytes.begin()) + 1);
  }
  return bytes;
}

// Lines are dropped before decompression, bytes after it; of text, both are characters of the file.
void read_skips(const NrrdText& text, GridFile& file) {
  const long long lines = text.integer("line skip", 0), bytes = text.integer("byte skip", 0);
  const bool raw = file.encoding == Encoding::raw, in_text = file.encoding >= Encoding::ascii;
  if (lines < 0) text.fail("line skip", "is negative");
  if (bytes < (raw ? -1 : 0))
    text.fail("byte skip", raw ? "is below -1" : "is negative; only raw data can be counted from the end");
  const std::uint64_t share = stored_bytes(file) / file.parts.size();
  for (FilePart& part : file.parts) {
    part.bytes = without_lines(part.bytes, lines, file.name);
    if (bytes < 0) part.bytes = last_bytes(part.bytes, share);
    if (in_text) part.bytes = part.bytes.subspan(std::min(part.bytes.size(), static_cast<std::size_t>(bytes)));
  }
  file.skip = bytes < 0 || in_text ? 0 : static_cast<std::uint64_t>(bytes);
}

}  // namespace

GridFile open_nrrd(const std::string& name) {
  GridFile file;
  file.name = name;
  file.header = MappedFile::open(name);
  const NrrdText text(file.header->bytes(), name);
  file.type = read_type(text);
  const Axes axes = read_axes(text, file);
  stored_bytes(file);  // refuses dimensions below 2 and beyond all memory
  file.encoding = read_encoding(text);
  file.swap = read_swap(text, file.type, file.encoding);
  read_geometry(text, axes, file);
  if (text.find("old min") || text.find("old max"))
    file.notes.push_back("`old min` and `old max` are not applied: values are the stored numbers");
  if (text.find("data file")) {
    text.require("data file");
    file.parts = open_data_files(read_data_files(text, file), file.dims, name);
  } else if (text.ended()) {
    file.parts = {{file.header, file.header->bytes().subspan(text.end())}};
  } else {
    throw InputError(name + ": has neither a \"data file\" nor voxels behind its header");
  }
  read_skips(text, file);
  return file;
}

}  // namespace dvrlab::nrrd
