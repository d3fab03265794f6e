// Decompression of gzip and zlib streams into a known number of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace dvrlab {

/// True when `in` starts like a gzip stream.
bool is_gzip(std::span<const std::byte> in);

/// Drops the first `skip` decompressed bytes, fills `out` with the following ones and returns how many bytes of `out`
/// were written: fewer than out.size() only where the stream (all its members) ends early. Nothing is decompressed
/// beyond that, so a stream that would swell to any size costs no more than `out`.
/// Throws InputError with `where` in front when the stream is damaged.
std::uint64_t gunzip(std::span<const std::byte> in, std::uint64_t skip, std::span<std::byte> out,
                     const std::string& where);

/// A stream of `compressed` bytes never holds more than this many (deflate's highest ratio).
std::uint64_t gunzip_limit(std::uint64_t compressed);

}  // namespace dvrlab
