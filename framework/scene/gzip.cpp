#include "framework/scene/gzip.h"

#include <libdeflate.h>
#include <zlib.h>

#include <algorithm>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

// zlib counts in 32 bits; larger inputs and outputs are handed over in pieces.
uInt piece(std::size_t bytes) { return static_cast<uInt>(std::min<std::size_t>(bytes, 1u << 30)); }

class Inflater : public Unpacker {
 public:
  Inflater(std::span<const std::byte> in, const std::string& where) : Unpacker(in, where) {
    if (inflateInit2(&z_, 15 + 32) != Z_OK) throw NotSupported(where_ + ": zlib cannot start");  // 32: gzip or zlib
  }
  ~Inflater() override { inflateEnd(&z_); }

 protected:
  Step step(std::span<const std::byte> in, std::span<std::byte> out) override {
    z_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(in.data()));  // zlib's interface knows no const
    z_.avail_in = piece(in.size());
    z_.next_out = reinterpret_cast<Bytef*>(out.data());
    z_.avail_out = piece(out.size());
    const uInt in_before = z_.avail_in, out_before = z_.avail_out;
    const int result = inflate(&z_, Z_NO_FLUSH);
    if (result != Z_OK && result != Z_BUF_ERROR && result != Z_STREAM_END)
      throw InputError(where_ + ": the compressed data is damaged (" + (z_.msg ? z_.msg : "zlib error") + ")");
    return {in_before - z_.avail_in, out_before - z_.avail_out, result == Z_STREAM_END};
  }

  bool next_member(std::span<const std::byte> in) override { return is_gzip(in) && inflateReset(&z_) == Z_OK; }

 private:
  z_stream z_{};
};

}  // namespace

bool is_gzip(std::span<const std::byte> in) {
  return in.size() > 2 && in[0] == std::byte{0x1f} && in[1] == std::byte{0x8b};
}

std::unique_ptr<Unpacker> gzip_unpacker(std::span<const std::byte> in, const std::string& where) {
  return std::make_unique<Inflater>(in, where);
}

bool gunzip_exactly(std::span<const std::byte> in, std::span<std::byte> out) {
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> d(libdeflate_alloc_decompressor(),
                                                                                       libdeflate_free_decompressor);
  if (!d) return false;
  const auto whole = is_gzip(in) ? libdeflate_gzip_decompress_ex : libdeflate_zlib_decompress_ex;
  do {
    std::size_t read = 0, written = 0;
    if (whole(d.get(), in.data(), in.size(), out.data(), out.size(), &read, &written) != LIBDEFLATE_SUCCESS)
      return false;
    in = in.subspan(read);
    out = out.subspan(written);
  } while (is_gzip(in));
  return out.empty();
}

std::uint64_t gunzip(std::span<const std::byte> in, std::uint64_t skip, std::span<std::byte> out,
                     const std::string& where) {
  Inflater inflater(in, where);
  return inflater.skip(skip) == skip ? inflater.fill(out) : 0;
}

std::uint64_t gunzip_limit(std::uint64_t compressed) { return 1040 * compressed + 1024; }

}  // namespace dvrlab
