// The blocks of compressed arrays: a table of their sizes, then one compressed stream each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/vtk_xml/vtk_xml.h"

namespace dvrlab::vtk_xml {

/// Where each block's compressed bytes and numbers lie, from the start of the compressed bytes and of the array.
struct BlockTable {
  struct Block {
    std::uint64_t packed_at, packed, at, bytes;
  };
  std::vector<Block> block;
  std::uint64_t packed = 0;  // of all blocks
};

/// `sizes`: bytes of a block, bytes of the last one if it is shorter (else 0), then the packed bytes of each block.
/// Throws InputError, `where` in front, when the blocks are not `wanted` bytes together, when more than `most`
/// compressed bytes would be needed, or when a block cannot hold what it announces.
BlockTable read_table(const std::vector<std::uint64_t>& sizes, Compression compression, std::uint64_t wanted,
                      std::uint64_t most, const std::string& where);

/// Fills `out` from the compressed bytes, one thread per processor. Throws InputError for a damaged block.
void unpack(const BlockTable& table, Compression compression, std::span<const std::byte> packed,
            std::span<std::byte> out, const std::string& where);

}  // namespace dvrlab::vtk_xml
