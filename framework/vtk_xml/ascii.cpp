#include "framework/vtk_xml/ascii.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "framework/interfaces/error.h"

namespace dvrlab::vtk_xml {
namespace {

template <class T>
void parse_all(std::span<const std::byte> text, T* out, std::uint64_t count, const std::string& where) {
  const char* at = reinterpret_cast<const char*>(text.data());
  const char* const end = at + text.size();
  const auto skip_space = [&] { at = std::find_if_not(at, end, [](unsigned char c) { return std::isspace(c); }); };
  for (std::uint64_t i = 0;; ++i) {
    skip_space();
    if (at == end && i == count) return;
    if (at == end || i == count)
      throw InputError(where + ": it needs " + std::to_string(count) + " numbers, its text holds " +
                       (at == end ? std::to_string(i) : "more"));
    const char* const word_end = std::find_if(at, end, [](unsigned char c) { return std::isspace(c); });
    const auto [stop, error] = std::from_chars(*at == '+' ? at + 1 : at, word_end, out[i]);
    if (error != std::errc() || stop != word_end)
      throw InputError(where + ": number " + std::to_string(i) + ", \"" +
                       std::string(at, std::min<std::ptrdiff_t>(word_end - at, 40)) + "\", is no number of its type");
    at = word_end;
  }
}

}  // namespace

std::shared_ptr<const void> read_ascii(std::span<const std::byte> text, SourceType type, std::uint64_t count,
                                       const std::string& where) {
  if ((text.size() + 1) / 2 < count)  // a digit and a blank each
    throw InputError(where + ": it needs " + std::to_string(count) + " numbers, its text of " +
                     std::to_string(text.size()) + " characters cannot hold them");
  const auto memory = allocate_voxels(count * bytes_of(type), where);
  const auto parse = [&]<class T>(T*) { parse_all(text, static_cast<T*>(memory.get()), count, where); };
  switch (type) {
    case SourceType::i8:
      parse(static_cast<std::int8_t*>(nullptr));
      break;
    case SourceType::u8:
      parse(static_cast<std::uint8_t*>(nullptr));
      break;
    case SourceType::i16:
      parse(static_cast<std::int16_t*>(nullptr));
      break;
    case SourceType::u16:
      parse(static_cast<std::uint16_t*>(nullptr));
      break;
    case SourceType::i32:
      parse(static_cast<std::int32_t*>(nullptr));
      break;
    case SourceType::u32:
      parse(static_cast<std::uint32_t*>(nullptr));
      break;
    case SourceType::i64:
      parse(static_cast<std::int64_t*>(nullptr));
      break;
    case SourceType::u64:
      parse(static_cast<std::uint64_t*>(nullptr));
      break;
    case SourceType::f32:
      parse(static_cast<float*>(nullptr));
      break;
    case SourceType::f64:
      parse(static_cast<double*>(nullptr));
      break;
  }
  return memory;
}

}  // namespace dvrlab::vtk_xml
