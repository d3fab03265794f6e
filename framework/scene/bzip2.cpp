#include "framework/scene/bzip2.h"

#include <bzlib.h>

#include <algorithm>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

// The library counts in 32 bits; larger inputs and outputs are handed over in pieces.
unsigned piece(std::size_t bytes) { return static_cast<unsigned>(std::min<std::size_t>(bytes, 1u << 30)); }

class Bunzip2 : public Unpacker {
 public:
  Bunzip2(std::span<const std::byte> in, const std::string& where) : Unpacker(in, where) { start(); }
  ~Bunzip2() override { BZ2_bzDecompressEnd(&bz_); }

 protected:
  Step step(std::span<const std::byte> in, std::span<std::byte> out) override {
    bz_.next_in = reinterpret_cast<char*>(const_cast<std::byte*>(in.data()));  // the library's interface knows no const
    bz_.avail_in = piece(in.size());
    bz_.next_out = reinterpret_cast<char*>(out.data());
    bz_.avail_out = piece(out.size());
    const unsigned in_before = bz_.avail_in, out_before = bz_.avail_out;
    const int result = BZ2_bzDecompress(&bz_);
    if (result != BZ_OK && result != BZ_STREAM_END)
      throw InputError(where_ + ": the compressed data is damaged (" +
                       (result == BZ_DATA_ERROR_MAGIC ? "no bzip2 stream" : "a bzip2 block or its checksum is wrong") +
                       ")");
    return {in_before - bz_.avail_in, out_before - bz_.avail_out, result == BZ_STREAM_END};
  }

  bool next_member(std::span<const std::byte> in) override {
    if (in.size() < 3 || in[0] != std::byte{'B'} || in[1] != std::byte{'Z'} || in[2] != std::byte{'h'}) return false;
    BZ2_bzDecompressEnd(&bz_);
    start();
    return true;
  }

 private:
  void start() {
    bz_ = {};
    if (BZ2_bzDecompressInit(&bz_, 0, 0) != BZ_OK) throw NotSupported(where_ + ": bzip2 cannot start");
  }
  bz_stream bz_{};
};

}  // namespace

std::unique_ptr<Unpacker> bzip2_unpacker(std::span<const std::byte> in, const std::string& where) {
  return std::make_unique<Bunzip2>(in, where);
}

std::uint64_t bunzip2_limit(std::uint64_t compressed) {
  constexpr std::uint64_t block = 900000ull / 5 * 259, least = 24;
  std::uint64_t bytes = 0;
  return __builtin_mul_overflow(compressed / least + 1, block, &bytes) ? ~std::uint64_t{0} : bytes;
}

}  // namespace dvrlab
