#include "plugins/data/metaimage/metaimage_header.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "framework/interfaces/error.h"
#include "framework/scene/data_files.h"
#include "plugins/data/metaimage/metaimage_text.h"

namespace dvrlab::metaimage {
namespace {

constexpr const char* what_to_do = "; only one 3-D scalar volume is read: cut out one volume or one channel first";

// MET_LONG has four bytes in every file, whatever the machine that wrote it calls long.
SourceType read_type(const MetaText& text) {
  using enum SourceType;
  static const std::map<std::string, SourceType> types{
      {"MET_CHAR", i8},   {"MET_ASCII_CHAR", i8}, {"MET_UCHAR", u8},      {"MET_SHORT", i16}, {"MET_USHORT", u16},
      {"MET_INT", i32},   {"MET_UINT", u32},      {"MET_LONG", i32},      {"MET_ULONG", u32}, {"MET_LONG_LONG", i64},
      {"MET_FLOAT", f32}, {"MET_DOUBLE", f64},    {"MET_ULONG_LONG", u64}};
  const std::string name = text.require("ElementType");
  const auto found = types.find(name);
  if (found == types.end())
    text.fail("ElementType", quoted(name) + " is no scalar number; MET_CHAR to MET_ULONG_LONG, MET_FLOAT and " +
                                 "MET_DOUBLE are read");
  if (const long long channels = text.integer("ElementNumberOfChannels", 1); channels != 1)
    text.fail("ElementNumberOfChannels", "is " + std::to_string(channels) + what_to_do);
  return found->second;
}

std::size_t read_dims(const MetaText& text, GridFile& file) {
  const long long axes = text.integers("NDims", 1)[0];
  if (axes < 3 || axes > 10) text.fail("NDims", "is " + std::to_string(axes) + what_to_do);
  const auto sizes = text.integers("DimSize", static_cast<std::size_t>(axes));
  if (std::any_of(sizes.begin() + 3, sizes.end(), [](long long n) { return n != 1; }))
    text.fail("DimSize", "has axes beyond the third that are longer than 1" + std::string(what_to_do));
  if (axes > 3) file.notes.push_back("axes beyond the third, of size 1, were dropped");
  std::copy_n(sizes.begin(), 3, file.dims.begin());
  return static_cast<std::size_t>(axes);
}

// `count` finite numbers; none when the header lacks the field.
std::vector<double> finite_numbers(const MetaText& text, const std::string& field, std::size_t count) {
  const auto numbers = text.numbers(field, count);
  if (std::any_of(numbers.begin(), numbers.end(), [](double x) { return std::isnan(x); }))
    text.fail(field, "holds a number that is not finite");
  return numbers;
}

// Row i of the matrix is the direction of axis i; the frame is LPS, as ITK has it.
void read_geometry(const MetaText& text, std::size_t axes, GridFile& file) {
  const std::string directions = text.one_of({"TransformMatrix", "Rotation", "Orientation"}),
                    origin = text.one_of({"Offset", "Position", "Origin"}),
                    spacing = text.find("ElementSpacing") ? "ElementSpacing" : "ElementSize";
  const auto steps = finite_numbers(text, spacing, axes);
  if (steps.empty()) file.notes.push_back("the file has no spacing: 1 along each axis");
  for (std::size_t c = 0; c < std::min<std::size_t>(3, steps.size()); ++c)
    if (steps[c] == 0) text.fail(spacing, "is 0 along axis " + std::to_string(c + 1) + "; a spacing is another number");
  if (!steps.empty() && spacing == "ElementSize")
    file.notes.push_back("ElementSize is taken as the spacing; the file has no ElementSpacing");
  const auto matrix = finite_numbers(text, directions, axes * axes), first = finite_numbers(text, origin, axes);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t r = 0; r < 3; ++r)
      file.to_world.m[3 * r + c] =
          (steps.empty() ? 1 : steps[c]) * (matrix.empty() ? (r == c ? 1 : 0) : matrix[axes * c + r]);
    file.to_world.t[c] = first.empty() ? 0 : first[c];
  }
  flip_world(file.to_world, {-1, -1, 1});
  file.notes.push_back("world frame: RAS, the file's LPS coordinates with x and y negated");
  file.anatomical = text.find("AnatomicalOrientation").value_or("").find('?') == std::string::npos;
  const std::string unit = text.find("DistanceUnits").value_or("");
  file.length_unit = unit.find('?') == std::string::npos ? unit : "";
}

void read_scaling(const MetaText& text, GridFile& file) {
  const auto slope = finite_numbers(text, "ElementToIntensityFunctionSlope", 1),
             offset = finite_numbers(text, "ElementToIntensityFunctionOffset", 1);
  if (!slope.empty()) file.slope = slope[0];
  if (!offset.empty()) file.intercept = offset[0];
  if (file.slope == 0) text.fail("ElementToIntensityFunctionSlope", "is 0: every value would be the same");
}

bool read_swap(const MetaText& text, GridFile& file) {
  const std::string field = text.one_of({"ElementByteOrderMSB", "BinaryDataByteOrderMSB"});
  if (field.empty() && bytes_of(file.type) > 1 && file.encoding != Encoding::ascii)
    file.notes.push_back("the header has no byte order: little-endian is taken");
  return text.flag(field, false) != (std::endian::native == std::endian::big);
}

// "LOCAL", "one.raw", "LIST [axes]" or "slice%03d.raw [first [last [step]]]".
std::vector<FilePart> read_parts(const MetaText& text, const GridFile& file, std::size_t axes) {
  const std::string all = text.require("ElementDataFile");
  if (lower_case(all) == "local") return {{file.header, file.header->bytes().subspan(text.end())}};
  const std::vector<std::string> words = text.words("ElementDataFile");
  const auto number = [&](std::size_t i, long long otherwise) {
    if (words.size() <= i) return otherwise;
    const auto x = parse_number<long long>(words[i]);
    if (!x) text.fail("ElementDataFile", quoted(words[i]) + " is no whole number");
    return *x;
  };
  const bool list = words[0] == "LIST", pattern = all.find('%') != std::string::npos;
  if (!list && !pattern) return open_data_files({{all}, 3}, file.dims, file.name);
  // A file holds one slice unless the list says otherwise; axes of size 1 beyond the third make no difference.
  const long long spans = std::min(3ll, list ? number(1, std::min<long long>(2, static_cast<long long>(axes) - 1)) : 2);
  if (spans < 1) text.fail("ElementDataFile", "a file spans " + std::to_string(spans) + " axes; must be 1, 2 or 3");
  if (list) return open_data_files({text.listed_files(), spans}, file.dims, file.name);
  return open_data_files({numbered_names(words[0], number(1, 1), number(2, file.dims[2]), number(3, 1), file.dims[2],
                                         file.name + ": ElementDataFile"),
                          spans},
                         file.dims, file.name);
}

// HeaderSize counts from the start of the file that holds the voxels, in front of decompression.
void skip_header(const MetaText& text, GridFile& file) {
  const long long skip = text.integer("HeaderSize", 0);
  const std::uint64_t share = stored_bytes(file) / file.parts.size();
  if (skip < (file.encoding == Encoding::raw ? -1 : 0))
    text.fail("HeaderSize", "is " + std::to_string(skip) + "; only raw voxels can be counted from the end, by -1");
  for (FilePart& part : file.parts) {
    const bool local = part.file == file.header;
    if (skip < 0) {
      part.bytes = last_bytes(part.bytes, share);
    } else if (skip > 0) {
      if (local && static_cast<std::size_t>(skip) < text.end())
        text.fail("HeaderSize", "is " + std::to_string(skip) + ", inside the header, which has " +
                                    std::to_string(text.end()) + " bytes");
      const auto all = part.file->bytes();
      part.bytes = all.subspan(std::min(all.size(), static_cast<std::size_t>(skip)));
    }
  }
}

void cut_to_compressed_size(const MetaText& text, GridFile& file) {
  if (file.encoding != Encoding::gzip || file.parts.size() > 1 || !text.find("CompressedDataSize")) return;
  auto& bytes = file.parts[0].bytes;
  const long long size = text.integers("CompressedDataSize", 1)[0];
  if (size < 1 || static_cast<std::uint64_t>(size) > bytes.size())
    text.fail("CompressedDataSize", "is " + std::to_string(size) + ", the file holds " + std::to_string(bytes.size()) +
                                        " bytes there; it is cut off or its header is wrong");
  bytes = bytes.first(static_cast<std::size_t>(size));
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word.substr(0, 40);
  return out;
}

}  // namespace

GridFile open_metaimage(const std::string& name) {
  GridFile file;
  file.name = name;
  file.header = MappedFile::open(name);
  const MetaText text(file.header->bytes(), name);
  if (const std::string type = text.find("ObjectType").value_or("Image"); lower_case(type) != "image")
    text.fail("ObjectType", "is " + quoted(type) + "; only \"Image\" holds a volume");
  file.type = read_type(text);
  const std::size_t axes = read_dims(text, file);
  stored_bytes(file);  // refuses dimensions below 2 and beyond all memory
  const bool binary = text.flag("BinaryData", true), compressed = text.flag("CompressedData", false);
  if (!binary && compressed) text.fail("CompressedData", "is True, but BinaryData is False: text is not compressed");
  file.encoding = compressed ? Encoding::gzip : binary ? Encoding::raw : Encoding::ascii;
  file.swap = read_swap(text, file);
  read_geometry(text, axes, file);
  read_scaling(text, file);
  file.parts = read_parts(text, file, axes);
  skip_header(text, file);
  cut_to_compressed_size(text, file);
  if (!text.unknown().empty())
    file.notes.push_back("keys that the format does not define have no effect: " + joined(text.unknown()));
  return file;
}

}  // namespace dvrlab::metaimage
