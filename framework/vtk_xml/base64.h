// Base64 text as a stream of bytes.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

namespace dvrlab::vtk_xml {

/// Reads on from where it stands. White space is skipped; several encoded pieces may follow each other, each with its
/// own padding, as VTK writes the table and the blocks of compressed data.
class Base64 {
 public:
  Base64(std::span<const std::byte> text, const std::string& where) : text_(text), where_(where) {}
  /// Fills `out`; returns the bytes written, fewer only at the end of the text.
  /// Throws InputError, `where` in front, for a character or a padding that is not base64.
  std::size_t read(std::span<std::byte> out);
  /// No more than this many bytes are left.
  std::size_t most() const { return bytes_ - taken_ + (text_.size() - at_) / 4 * 3; }

 private:
  bool refill();
  std::span<const std::byte> text_;
  std::string where_;
  std::size_t at_ = 0;  // in the text
  std::array<unsigned char, 3072> decoded_{};
  std::size_t bytes_ = 0, taken_ = 0;  // of decoded_
};

}  // namespace dvrlab::vtk_xml
