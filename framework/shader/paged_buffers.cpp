#include "framework/shader/paged_buffers.h"

#include <algorithm>
#include <bit>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

std::uint64_t round_up(std::uint64_t bytes, std::uint64_t to) { return (bytes + to - 1) / to * to; }

/// How elements lie in the words that a shader reads.
struct Packing {
  const char* word;  // GLSL type of one array element
  int shift;         // log2 of the elements per word
  bool is_signed;    // of packed elements
};

Packing packing(Element element) {
  switch (element) {
    case Element::u8:
      return {"uint", 2, false};
    case Element::i8:
      return {"uint", 2, true};
    case Element::u16:
      return {"uint", 1, false};
    case Element::i16:
      return {"uint", 1, true};
    case Element::f32:
      return {"float", 0, true};
    case Element::vec4:
      return {"vec4", 0, true};
    case Element::i32:
      return {"int", 0, true};
    case Element::ivec4:
      return {"ivec4", 0, true};
  }
  throw std::logic_error("buffer of an unknown element type");
}

std::string page_name(const std::string& name, std::size_t page) { return name + "_page" + std::to_string(page); }

/// `<word> dvr_word_<name>(uint i)`: word i, from the page that holds it. An if-chain: storage buffers cannot be
/// indexed dynamically everywhere.
std::string word_function(const PagedBuffer& paged, const Packing& pack) {
  const std::string& name = paged.buffer.name;
  const std::string head = std::string(pack.word) + " dvr_word_" + name + "(uint i) {\n";
  if (paged.pages.size() == 1) return head + "  return " + page_name(name, 0) + "[i];\n}\n";
  const std::uint64_t words = paged.page_elements >> pack.shift;
  std::string text = head + "  uint page = i >> " + std::to_string(std::countr_zero(words)) + "u, k = i & " +
                     std::to_string(words - 1) + "u;\n";
  for (std::size_t p = 0; p + 1 < paged.pages.size(); ++p)
    text += "  if (page == " + std::to_string(p) + "u) return " + page_name(name, p) + "[k];\n";
  return text + "  return " + page_name(name, paged.pages.size() - 1) + "[k];\n}\n";
}

/// `int dvr_unpack_<name>(uint word, uint i)`: the element i of its word as an exact integer.
std::string unpack_function(const std::string& name, const Packing& pack) {
  const int bits = 32 >> pack.shift;
  const std::string place = "(i & " + std::to_string((1 << pack.shift) - 1) + "u) * " + std::to_string(bits) + "u";
  const std::string head = "int dvr_unpack_" + name + "(uint word, uint i) {\n";
  if (pack.is_signed) {
    const std::string top = std::to_string(32 - bits);
    return head + "  return int(word << (" + top + "u - " + place + ")) >> " + top + ";\n}\n";
  }
  return head + "  return int((word >> (" + place + ")) & " + std::to_string((1u << bits) - 1) + "u);\n}\n";
}

/// Neighbours of packed elements mostly share a word; it is read twice all the same: Mesa 22.3's lavapipe crashes on
/// some shaders that read the second one in a branch.
std::string packed_functions(const std::string& name, const Packing& pack) {
  const std::string word = "dvr_word_" + name, unpack = "dvr_unpack_" + name, s = std::to_string(pack.shift) + "u";
  return "int fetchi_" + name + "(int i) { return " + unpack + "(" + word + "(uint(i) >> " + s + "), uint(i)); }\n" +
         "float fetch1_" + name + "(uint i) { return float(" + unpack + "(" + word + "(i >> " + s + "), i)); }\n" +
         "void fetch2_" + name + "(uint i, out float a, out float b) {\n  uint w = " + word + "(i >> " + s +
         "), j = i + 1u;\n  a = float(" + unpack + "(w, i));\n  b = float(" + unpack + "(" + word + "(j >> " + s +
         "), j));\n}\n";
}

/// The fetch functions of a buffer that is never read: the kernel's text still names them.
std::string unbound_text(const std::string& name, const Packing& pack) {
  const std::string word = pack.word;
  if (word == "vec4") return "vec4 fetch4_" + name + "(int i) { return vec4(0.0); }\n";
  if (word == "ivec4") return "ivec4 fetchi4_" + name + "(int i) { return ivec4(0); }\n";
  return "int fetchi_" + name + "(int i) { return 0; }\nfloat fetch1_" + name +
         "(uint i) { return 0.0; }\nvoid fetch2_" + name + "(uint i, out float a, out float b) { a = b = 0.0; }\n";
}

}  // namespace

PagedBuffer page_buffer(const Buffer& buffer, std::uint64_t range, int binding) {
  const std::uint64_t size = bytes_of(buffer.element);
  const bool by_int =
      buffer.element == Element::vec4 || buffer.element == Element::i32 || buffer.element == Element::ivec4;
  if (buffer.count >> (by_int ? 31 : 32) != 0)
    throw NotSupported("the buffer " + buffer.name + " has " + std::to_string(buffer.count) +
                       " elements, more than a kernel's index can count");
  PagedBuffer paged;
  paged.buffer = buffer;
  if (buffer.count == 0) return paged;
  const std::uint64_t whole = round_up((buffer.count + 1) * size, 16);
  if (whole <= range) {
    paged.page_elements = buffer.count;
    paged.pages.push_back({binding, 0, buffer.bytes(), whole});
    return paged;
  }
  paged.page_elements = std::bit_floor(range / size);
  const std::uint64_t page_bytes = paged.page_elements * size;
  for (std::uint64_t offset = 0; offset < buffer.bytes(); offset += page_bytes) {
    const std::uint64_t bytes = std::min(page_bytes, buffer.bytes() - offset);
    const std::uint64_t allocated = std::min(page_bytes, round_up(bytes + size, 16));
    paged.pages.push_back({binding + int(paged.pages.size()), offset, bytes, allocated});
  }
  return paged;
}

std::string buffer_text(const PagedBuffer& paged) {
  const std::string& name = paged.buffer.name;
  const Packing pack = packing(paged.buffer.element);
  std::string text;
  if (paged.pages.empty()) return unbound_text(name, pack);
  for (std::size_t p = 0; p < paged.pages.size(); ++p)
    text += "layout(std430, binding = " + std::to_string(paged.pages[p].binding) + ") readonly buffer dvr_" +
            page_name(name, p) + " { " + pack.word + " " + page_name(name, p) + "[]; };\n";
  text += word_function(paged, pack);
  const std::string word = "dvr_word_" + name;
  if (pack.shift != 0) return text + unpack_function(name, pack) + packed_functions(name, pack);
  if (paged.buffer.element == Element::ivec4)
    return text + "ivec4 fetchi4_" + name + "(int i) { return " + word + "(uint(i)); }\n";
  if (paged.buffer.element == Element::vec4)
    return text + "vec4 fetch4_" + name + "(int i) { return " + word + "(uint(i)); }\n";
  if (paged.buffer.element == Element::i32)
    text += "int fetchi_" + name + "(int i) { return " + word + "(uint(i)); }\n";
  return text + "float fetch1_" + name + "(uint i) { return float(" + word + "(i)); }\nvoid fetch2_" + name +
         "(uint i, out float a, out float b) {\n  a = float(" + word + "(i));\n  b = float(" + word + "(i + 1u));\n}\n";
}

}  // namespace dvrlab
