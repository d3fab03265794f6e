// Decompression of a stream of bytes, piece by piece: what gzip and bzip2 have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace dvrlab {

class Unpacker {
 public:
  virtual ~Unpacker() = default;
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  /// Fills `out`; returns the bytes written, fewer only where the data ends. Nothing is decompressed beyond `out`, so
  /// a stream that would swell to any size costs no more than that.
  /// Throws InputError when the stream is damaged.
  std::size_t fill(std::span<std::byte> out);

  /// Drops bytes; returns how many there were to drop.
  std::uint64_t skip(std::uint64_t bytes);

  /// True if data follows what was filled. If none does, the stream has been read to its end, with its checksum.
  /// Throws InputError when that end is missing or the checksum is wrong.
  bool more();

 protected:
  /// `where` stands in front of every message.
  Unpacker(std::span<const std::byte> in, std::string where) : where_(std::move(where)), in_(in) {}

  struct Step {
    std::size_t read = 0, written = 0;
    bool ended = false;  // the member's end, checksum included
  };
  /// As much as the library likes to do at once; both spans may be handed over in pieces.
  virtual Step step(std::span<const std::byte> in, std::span<std::byte> out) = 0;
  /// A file may hold several streams, one behind the other: true, and ready for it, if `in` starts another one.
  virtual bool next_member(std::span<const std::byte> in) = 0;

  std::string where_;

 private:
  std::span<const std::byte> in_;
  bool ended_ = false, cut_off_ = false;
};

}  // namespace dvrlab
