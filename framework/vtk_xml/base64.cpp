#include "framework/vtk_xml/base64.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "framework/interfaces/error.h"

namespace dvrlab::vtk_xml {

std::size_t Base64::read(std::span<std::byte> out) {
  std::size_t done = 0;
  while (done < out.size() && (taken_ < bytes_ || refill())) {
    const std::size_t n = std::min(out.size() - done, bytes_ - taken_);
    std::memcpy(out.data() + done, decoded_.data() + taken_, n);
    done += n;
    taken_ += n;
  }
  return done;
}

// Decodes the next characters, up to the first padding: OpenSSL counts padding as zeros.
bool Base64::refill() {
  std::array<unsigned char, 4096> characters;
  std::size_t n = 0, padding = 0;
  for (; at_ < text_.size() && n < characters.size(); ++at_) {
    const auto c = std::to_integer<unsigned char>(text_[at_]);
    if (std::isspace(c)) continue;
    if (padding > 0 && c != '=') break;
    padding += c == '=' ? 1 : 0;
    characters[n++] = c;
    if (padding > 0 && n % 4 == 0) {
      ++at_;
      break;
    }
  }
  bytes_ = taken_ = 0;
  if (n == 0) return false;
  const int decoded =
      n % 4 == 0 && padding <= 2 ? EVP_DecodeBlock(decoded_.data(), characters.data(), static_cast<int>(n)) : -1;
  if (decoded < 0)
    throw InputError(where_ + ": no base64 in the 4096 characters before character " + std::to_string(at_) +
                     " of its text; the file is cut off or damaged");
  bytes_ = static_cast<std::size_t>(decoded) - padding;
  return true;
}

}  // namespace dvrlab::vtk_xml
