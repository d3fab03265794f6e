#include "framework/scene/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <memory>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

// zlib counts in 32 bits; larger inputs and outputs are handed over in pieces.
uInt piece(std::size_t bytes) { return static_cast<uInt>(std::min<std::size_t>(bytes, 1u << 30)); }

class Inflater {
 public:
  Inflater(std::span<const std::byte> in, const std::string& where) : in_(in), where_(where) {
    if (inflateInit2(&z_, 15 + 32) != Z_OK) throw InputError(where_ + ": zlib cannot start");  // 32: gzip or zlib
  }
  ~Inflater() { inflateEnd(&z_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Fills `out`; returns the bytes written, fewer at the end of the last member.
  std::size_t fill(std::span<std::byte> out) {
    std::size_t done = 0;
    while (done < out.size() && !ended_) {
      z_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(in_.data()));  // zlib's interface knows no const
      z_.avail_in = piece(in_.size());
      z_.next_out = reinterpret_cast<Bytef*>(out.data() + done);
      z_.avail_out = piece(out.size() - done);
      const uInt in_before = z_.avail_in, out_before = z_.avail_out;
      const int result = inflate(&z_, Z_NO_FLUSH);
      const std::size_t read = in_before - z_.avail_in, written = out_before - z_.avail_out;
      in_ = in_.subspan(read);
      done += written;
      if (result == Z_STREAM_END) {
        ended_ = !is_gzip(in_);  // a gzip file may hold several members; other bytes behind the last are no data
        if (!ended_) inflateReset(&z_);
      } else if (result != Z_OK && result != Z_BUF_ERROR) {
        throw InputError(where_ + ": the compressed data is damaged (" + (z_.msg ? z_.msg : "zlib error") + ")");
      } else if (read == 0 && written == 0) {
        ended_ = true;  // the stream was cut off
      }
    }
    return done;
  }

 private:
  z_stream z_{};
  std::span<const std::byte> in_;
  std::string where_;
  bool ended_ = false;
};

}  // namespace

bool is_gzip(std::span<const std::byte> in) {
  return in.size() > 2 && in[0] == std::byte{0x1f} && in[1] == std::byte{0x8b};
}

std::uint64_t gunzip(std::span<const std::byte> in, std::uint64_t skip, std::span<std::byte> out,
                     const std::string& where) {
  Inflater inflater(in, where);
  std::array<std::byte, 4096> dropped;
  while (skip > 0) {
    const std::size_t n = inflater.fill(std::span(dropped).first(std::min<std::uint64_t>(skip, dropped.size())));
    if (n == 0) return 0;
    skip -= n;
  }
  return inflater.fill(out);
}

std::uint64_t gunzip_limit(std::uint64_t compressed) { return 1040 * compressed + 1024; }

}  // namespace dvrlab
