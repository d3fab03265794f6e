#include "framework/scene/unpacker.h"

#include <algorithm>
#include <array>

#include "framework/interfaces/error.h"

namespace dvrlab {

std::size_t Unpacker::fill(std::span<std::byte> out) {
  std::size_t done = 0;
  while (done < out.size() && !ended_) {
    const Step s = step(in_, out.subspan(done));
    in_ = in_.subspan(s.read);
    done += s.written;
    if (s.ended) {
      ended_ = !next_member(in_);  // other bytes behind the last member are no data
    } else if (s.read == 0 && s.written == 0) {
      ended_ = cut_off_ = true;
    }
  }
  return done;
}

std::uint64_t Unpacker::skip(std::uint64_t bytes) {
  std::array<std::byte, 4096> dropped;
  std::uint64_t done = 0;
  while (done < bytes) {
    const std::size_t n = fill(std::span(dropped).first(std::min<std::uint64_t>(bytes - done, dropped.size())));
    if (n == 0) break;
    done += n;
  }
  return done;
}

bool Unpacker::more() {
  std::array<std::byte, 1> next;
  if (fill(next) == 1) return true;
  if (cut_off_) throw InputError(where_ + ": the compressed data is cut off before its end; copy the file again");
  return false;
}

}  // namespace dvrlab
