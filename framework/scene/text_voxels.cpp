#include "framework/scene/text_voxels.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

std::string_view view(std::span<const std::byte> text) {
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// The next word at `at`, which moves behind it; empty at the end of the text.
std::string_view next_word(std::string_view text, std::size_t& at, bool commas) {
  const auto between = [&](char c) { return is_blank(c) || (commas && c == ','); };
  while (at < text.size() && between(text[at])) ++at;
  const std::size_t first = at;
  while (at < text.size() && !between(text[at])) ++at;
  return text.substr(first, at - first);
}

// Through double, so that a number too small for float32 becomes 0; one that is too large is refused.
template <class T>
bool parse(std::string_view word, T& value) {
  using Read = std::conditional_t<std::is_floating_point_v<T>, double, T>;
  if (word.starts_with('+')) word.remove_prefix(1);
  Read read{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), read);
  if (error != std::errc() || end != word.data() + word.size()) return false;
  value = static_cast<T>(read);
  if constexpr (std::is_same_v<T, float>) return std::isfinite(value) || !std::isfinite(read);
  return true;
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

TextVoxels read_ascii(std::span<const std::byte> bytes, SourceType type, std::span<std::byte> out,
                      const std::string& where) {
  const std::string_view text = view(bytes);
  return with_source_type(type, [&]<class T>(T value) {
    std::size_t at = 0;
    std::uint64_t done = 0;
    for (; done + sizeof(T) <= out.size(); done += sizeof(T)) {
      const std::string_view word = next_word(text, at, true);
      if (word.empty()) break;
      if (!parse(word, value))
        throw InputError(where + ": voxel " + std::to_string(done / sizeof(T)) + " is \"" +
                         std::string(word.substr(0, 40)) + "\", which is no number that " + name_of(type) + " holds");
      std::memcpy(out.data() + done, &value, sizeof(T));
    }
    return TextVoxels{done, !next_word(text, at, true).empty()};
  });
}

TextVoxels read_hex(std::span<const std::byte> bytes, std::span<std::byte> out, const std::string& where) {
  const std::string_view text = view(bytes);
  std::size_t at = 0;
  const auto skip_blanks = [&] {
    while (at < text.size() && is_blank(text[at])) ++at;
    return at < text.size();
  };
  std::uint64_t done = 0;
  for (; done < out.size() && skip_blanks(); at += 2) {
    const int high = digit(text[at]), low = at + 1 < text.size() ? digit(text[at + 1]) : -1;
    if (high < 0 || low < 0)
      throw InputError(where + ": byte " + std::to_string(at) + " of the hexadecimal voxels starts no pair of digits");
    out[done++] = static_cast<std::byte>(16 * high + low);
  }
  return {done, skip_blanks()};
}

}  // namespace dvrlab
