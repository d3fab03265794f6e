#include "plugins/data/dicom/element_lengths.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "framework/interfaces/error.h"

namespace dvrlab::dicom {
namespace {

constexpr std::size_t first_element = 132;  // behind the preamble and "DICM"
constexpr std::uint32_t undefined = 0xffffffffu;
constexpr std::uint32_t item = 0xfffee000u, pixel_data = 0x7fe00010u, transfer_syntax = 0x00020010u;

// Value representations whose length has four bytes, behind two that are reserved (PS3.5, 7.1.2).
bool is_long(std::string_view vr) {
  static constexpr std::array<std::string_view, 13> names{"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                          "SV", "UC", "UN", "UR", "UT", "UV"};
  for (const auto name : names)
    if (vr == name) return true;
  return false;
}

class Walk {
 public:
  Walk(std::span<const std::byte> file, const std::string& name) : file_(file), name_(name) {}

  void run() {
    while (at_ + 8 <= file_.size() && step()) {
    }
  }

 private:
  std::uint32_t number(std::size_t at, std::size_t bytes) const {
    std::uint32_t x = 0;
    for (std::size_t i = 0; i < bytes; ++i)
      x |= std::to_integer<std::uint32_t>(file_[at + i]) << 8 * (big_ ? bytes - 1 - i : i);
    return x;
  }
  std::string_view text(std::size_t at, std::size_t bytes) const {
    return {reinterpret_cast<const char*>(file_.data()) + at, bytes};
  }

  // One element; false where the walk ends.
  bool step() {
    const std::size_t begin = at_;
    std::uint32_t tag = number(begin, 2) << 16 | number(begin + 2, 2);
    if (!in_data_ && tag >> 16 != 2) {  // the meta header is over
      in_data_ = true;
      if (!start_data()) return false;
      tag = number(begin, 2) << 16 | number(begin + 2, 2);
    }
    std::uint32_t length = number(begin + 4, 4);
    std::string_view vr;
    at_ = begin + 8;
    if (tag >> 16 != 0xfffe && !(in_data_ && implicit_)) {
      vr = text(begin + 4, 2);
      if (vr[0] < 'A' || vr[0] > 'Z' || vr[1] < 'A' || vr[1] > 'Z') return false;
      length = number(begin + 6, 2);
      if (is_long(vr)) {
        if (begin + 12 > file_.size()) return false;
        length = number(begin + 8, 4);
        at_ = begin + 12;
      }
    }
    if (tag == pixel_data && length == undefined) fragments_ = true;
    if (length != undefined && length > file_.size() - at_) fail(tag, begin, length);
    if (tag == transfer_syntax && length != undefined) syntax_ = text(at_, length);
    if (length == undefined) return vr != "UN";  // its elements follow; those of an unknown one are coded otherwise
    const bool nested =
        tag == item ? !fragments_ : vr == "SQ" || (vr.empty() && length >= 8 && number(at_, 2) == 0xfffe);
    if (!nested) at_ += length;
    return true;
  }

  // The transfer syntax decides how the elements behind the meta header are coded; false for a compressed data set.
  bool start_data() {
    const std::string_view syntax = syntax_.substr(0, syntax_.find_first_of(std::string_view("\0 ", 2)));
    implicit_ = syntax == "1.2.840.10008.1.2";
    big_ = syntax == "1.2.840.10008.1.2.2";
    return !syntax.empty() && syntax != "1.2.840.10008.1.2.1.99";
  }

  [[noreturn]] void fail(std::uint32_t tag, std::size_t begin, std::uint32_t length) const {
    char element[16];
    std::snprintf(element, sizeof element, "(%04x,%04x)", tag >> 16, tag & 0xffffu);
    throw InputError(name_ + ": element " + element + " at byte " + std::to_string(begin) + " announces " +
                     std::to_string(length) + " bytes, the file holds " + std::to_string(file_.size() - at_) +
                     "; it is cut off or damaged");
  }

  std::span<const std::byte> file_;
  const std::string& name_;
  std::size_t at_ = first_element;
  bool in_data_ = false, implicit_ = false, big_ = false, fragments_ = false;
  std::string_view syntax_;
};

}  // namespace

bool has_magic(std::span<const std::byte> file) {
  return file.size() >= first_element &&
         std::string_view(reinterpret_cast<const char*>(file.data()) + 128, 4) == "DICM";
}

void check_lengths(std::span<const std::byte> file, const std::string& name) { Walk(file, name).run(); }

}  // namespace dvrlab::dicom
