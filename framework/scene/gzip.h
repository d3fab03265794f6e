// Decompression of gzip and zlib streams into a known number of bytes.
#pragma once

#include <memory>

#include "framework/scene/unpacker.h"

namespace dvrlab {

/// True when `in` starts like a gzip stream.
bool is_gzip(std::span<const std::byte> in);

/// zlib, piece by piece, over all members.
std::unique_ptr<Unpacker> gzip_unpacker(std::span<const std::byte> in, const std::string& where);

/// libdeflate, at once, two to three times as fast. True if all of `in` decompresses, checksums included, to exactly
/// `out`. False says nothing about the reason (damaged, cut off, longer, shorter): gzip_unpacker tells.
bool gunzip_exactly(std::span<const std::byte> in, std::span<std::byte> out);

/// The start of a stream: drops the first `skip` decompressed bytes, fills `out` with the following ones and returns
/// how many bytes of `out` were written: fewer than out.size() only where the stream (all its members) ends early.
/// Throws InputError with `where` in front when the stream is damaged up to there.
std::uint64_t gunzip(std::span<const std::byte> in, std::uint64_t skip, std::span<std::byte> out,
                     const std::string& where);

/// A stream of `compressed` bytes never holds more than this many (deflate's highest ratio).
std::uint64_t gunzip_limit(std::uint64_t compressed);

}  // namespace dvrlab
