#include "framework/vtk_xml/array_values.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

#include "framework/interfaces/error.h"
#include "framework/vtk_xml/ascii.h"
#include "framework/vtk_xml/base64.h"
#include "framework/vtk_xml/blocks.h"

namespace dvrlab::vtk_xml {
namespace {

// The bytes of a binary array in the order in which they stand, decoded where they are text.
class Source {
 public:
  Source(std::span<const std::byte> bytes, bool base64, const std::string& where) : raw_(bytes) {
    if (base64) base64_.emplace(bytes, where);
  }
  std::size_t most() const { return base64_ ? base64_->most() : raw_.size(); }
  std::size_t read(std::span<std::byte> out) {
    if (base64_) return base64_->read(out);
    const auto part = raw_.first(std::min(out.size(), raw_.size()));
    std::copy(part.begin(), part.end(), out.begin());
    raw_ = raw_.subspan(part.size());
    return part.size();
  }
  /// What is left of raw bytes; empty for base64.
  std::span<const std::byte> view() const { return base64_ ? std::span<const std::byte>{} : raw_; }

 private:
  std::span<const std::byte> raw_;
  std::optional<Base64> base64_;
};

[[noreturn]] void truncated(const std::string& where, std::uint64_t wanted, std::uint64_t found) {
  throw InputError(where + ": it needs " + std::to_string(wanted) + " bytes, the file holds " + std::to_string(found) +
                   "; it is cut off or its header is wrong");
}

std::uint64_t read_word(Source& source, const XmlFile& header, const std::string& where) {
  std::array<std::byte, 8> bytes{};
  const auto word = std::span(bytes).first(static_cast<std::size_t>(header.word));
  if (source.read(word) < word.size())
    throw InputError(where + ": the file ends inside the sizes in front of its bytes; it is cut off");
  if (header.swap) std::reverse(word.begin(), word.end());
  std::uint64_t x = 0;
  for (std::size_t i = 0; i < word.size(); ++i) x |= std::to_integer<std::uint64_t>(word[i]) << (8 * i);
  return x;
}

Source open(const XmlFile& header, const DataArray& array, const std::string& where) {
  if (array.format == Format::inline_base64) return {array.text, true, where};
  if (array.offset > header.appended.size())
    throw InputError(where + ": its offset " + std::to_string(array.offset) + " lies beyond the " +
                     std::to_string(header.appended.size()) + " bytes of appended data; the file is cut off");
  return {header.appended.subspan(array.offset), header.appended_base64, where};
}

std::shared_ptr<const void> read_stored(const XmlFile& header, Source source, std::uint64_t wanted,
                                        const std::shared_ptr<const MappedFile>& file, const std::string& where) {
  const std::uint64_t announced = read_word(source, header, where);
  if (announced != wanted) truncated(where, wanted, announced);
  if (source.most() < wanted) truncated(where, wanted, source.most());
  if (!source.view().empty()) return {file, source.view().data()};
  const auto memory = allocate_voxels(wanted, where);
  const std::size_t found = source.read({static_cast<std::byte*>(memory.get()), wanted});
  if (found < wanted) truncated(where, wanted, found);
  return memory;
}

std::shared_ptr<const void> read_compressed(const XmlFile& header, Source source, std::uint64_t wanted,
                                            const std::string& where) {
  const std::uint64_t count = read_word(source, header, where), word = static_cast<std::uint64_t>(header.word);
  if (source.most() / word < 2 || count > source.most() / word - 2)
    throw InputError(where + ": announces " + std::to_string(count) + " compressed blocks, more than the file holds");
  std::vector<std::uint64_t> sizes(count + 2);
  for (std::uint64_t& size : sizes) size = read_word(source, header, where);
  const BlockTable table = read_table(sizes, header.compression, wanted, source.most(), where);
  const auto memory = allocate_voxels(wanted, where);
  const std::span out(static_cast<std::byte*>(memory.get()), wanted);
  if (!source.view().empty()) {
    unpack(table, header.compression, source.view().first(table.packed), out, where);
    return memory;
  }
  const auto packed = allocate_voxels(table.packed, where);
  const std::span in(static_cast<std::byte*>(packed.get()), table.packed);
  const std::size_t found = source.read(in);
  if (found < table.packed) truncated(where, table.packed, found);
  unpack(table, header.compression, in, out, where);
  return memory;
}

}  // namespace

SourceType type_of(const DataArray& array, const std::string& where) {
  using enum SourceType;
  static const std::map<std::string, SourceType> types{
      {"Int8", i8},    {"UInt8", u8},  {"Int16", i16},  {"UInt16", u16},  {"Int32", i32},
      {"UInt32", u32}, {"Int64", i64}, {"UInt64", u64}, {"Float32", f32}, {"Float64", f64}};
  const auto found = types.find(array.type);
  if (found == types.end())
    throw InputError(where + ": type \"" + array.type +
                     "\" is no number; Int8 to Int64, UInt8 to UInt64, Float32 and Float64 are read");
  return found->second;
}

SourceVoxels read_values(const XmlFile& header, const DataArray& array, std::uint64_t count,
                         const std::shared_ptr<const MappedFile>& file, const std::string& where) {
  const SourceType type = type_of(array, where);
  if (array.format == Format::ascii) return {type, false, read_ascii(array.text, type, count, where)};
  const std::uint64_t wanted = count * bytes_of(type);
  Source source = open(header, array, where);
  if (header.compression == Compression::none)
    return {type, header.swap, read_stored(header, std::move(source), wanted, file, where)};
  return {type, header.swap, read_compressed(header, std::move(source), wanted, where)};
}

std::uint64_t read_values_bytes(const XmlFile& header, const DataArray& array, std::uint64_t count,
                                std::uint64_t file_size) {
  const bool text = array.format == Format::inline_base64 || header.appended_base64;
  const bool packed = array.format != Format::ascii && header.compression != Compression::none;
  if (array.format == Format::appended && !text && !packed) return 0;
  return count * bytes_of(type_of(array, array.name)) + (packed && text ? file_size / 4 * 3 : 0);
}

}  // namespace dvrlab::vtk_xml
