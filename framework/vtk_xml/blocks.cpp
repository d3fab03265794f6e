#include "framework/vtk_xml/blocks.h"

#include <lz4.h>
#include <lzma.h>

#include <limits>

#include "framework/interfaces/error.h"
#include "framework/scene/gzip.h"
#include "framework/scene/parallel.h"

namespace dvrlab::vtk_xml {
namespace {

[[noreturn]] void bad_table(const std::string& where, const std::string& what) {
  throw InputError(where + ": the table of compressed blocks " + what + "; the file is cut off or damaged");
}

// The most bytes that `packed` bytes can hold. LZMA: a match of 273 bytes costs 14 binary decisions of at least
// log2(2048 / 2017) bits each, which is less than 8192 to 1.
std::uint64_t most_unpacked(Compression compression, std::uint64_t packed) {
  if (compression == Compression::zlib) return gunzip_limit(packed);
  if (compression == Compression::lz4) return 255 * packed + 64;
  return 8192 * packed + 1024;
}

// Bytes written; 0 for a damaged stream.
std::uint64_t unpack_block(Compression compression, std::span<const std::byte> in, std::span<std::byte> out,
                           const std::string& where) {
  if (compression == Compression::zlib) return gunzip(in, 0, out, where);
  if (compression == Compression::lz4) {
    const int n = LZ4_decompress_safe(reinterpret_cast<const char*>(in.data()), reinterpret_cast<char*>(out.data()),
                                      static_cast<int>(in.size()), static_cast<int>(out.size()));
    return n < 0 ? 0 : static_cast<std::uint64_t>(n);
  }
  std::uint64_t memory = 256 << 20;
  std::size_t read = 0, written = 0;
  const auto result =
      lzma_stream_buffer_decode(&memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(in.data()), &read, in.size(),
                                reinterpret_cast<std::uint8_t*>(out.data()), &written, out.size());
  return result == LZMA_OK ? written : 0;
}

}  // namespace

BlockTable read_table(const std::vector<std::uint64_t>& sizes, Compression compression, std::uint64_t wanted,
                      std::uint64_t most, const std::string& where) {
  const std::uint64_t whole = sizes[0], last = sizes[1], count = sizes.size() - 2;
  constexpr std::uint64_t largest = std::numeric_limits<int>::max();  // of LZ4's interface; VTK writes 32 KiB
  BlockTable table;
  std::uint64_t at = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t bytes = i + 1 == count && last > 0 ? last : whole, packed = sizes[2 + i];
    if (bytes > wanted - at) {
      at = wanted + 1;
      break;
    }
    if (bytes > largest || packed > largest) bad_table(where, "has a block of more than 2 GiB");
    if (packed > most - table.packed)
      bad_table(where, "announces more compressed bytes than the " + std::to_string(most) + " that are there");
    if (bytes > most_unpacked(compression, packed))
      bad_table(where, "announces " + std::to_string(bytes) + " bytes in the " + std::to_string(packed) +
                           " bytes of block " + std::to_string(i));
    table.block.push_back({table.packed, packed, at, bytes});
    table.packed += packed;
    at += bytes;
  }
  if (at != wanted)
    bad_table(where, std::string("announces ") + (at < wanted ? std::to_string(at) : "more") + " bytes, not the " +
                         std::to_string(wanted) + " of the piece's extent");
  return table;
}

void unpack(const BlockTable& table, Compression compression, std::span<const std::byte> packed,
            std::span<std::byte> out, const std::string& where) {
  parallel_ranges(table.block.size(), 8, [&](std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t i = begin; i < end; ++i) {
      const BlockTable::Block& b = table.block[i];
      const std::string here = where + ": block " + std::to_string(i);
      const auto found =
          unpack_block(compression, packed.subspan(b.packed_at, b.packed), out.subspan(b.at, b.bytes), here);
      if (found != b.bytes)
        throw InputError(here + " does not hold the " + std::to_string(b.bytes) +
                         " bytes that its table announces; the file is damaged");
    }
  });
}

}  // namespace dvrlab::vtk_xml
