#include "framework/shader/uniform_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

const char* type_word(Uniform::Type type) {
  switch (type) {
    case Uniform::Type::f32:
      return "float";
    case Uniform::Type::i32:
      return "int";
    case Uniform::Type::vec4:
      return "vec4";
  }
  throw std::logic_error("uniform of an unknown type");
}

std::string literal(const Uniform& uniform, double x) {
  const float value = static_cast<float>(x);
  if (!std::isfinite(value)) throw std::logic_error("the constant " + uniform.name + " is not finite");
  char text[32];
  std::snprintf(text, sizeof(text), "float(%.9g)", double(value));  // 9 digits: exact for float
  return text;
}

std::string literal(const Uniform& uniform) {
  switch (uniform.type) {
    case Uniform::Type::f32:
      return literal(uniform, uniform.f[0]);
    case Uniform::Type::i32:
      // The literal 2147483648 does not exist, so its negative has no decimal form.
      return uniform.i == std::numeric_limits<int>::min() ? "int(0x80000000u)" : std::to_string(uniform.i);
    case Uniform::Type::vec4:
      return "vec4(" + literal(uniform, uniform.f[0]) + ", " + literal(uniform, uniform.f[1]) + ", " +
             literal(uniform, uniform.f[2]) + ", " + literal(uniform, uniform.f[3]) + ")";
  }
  throw std::logic_error("uniform of an unknown type");
}

}  // namespace

UniformBlock layout_block(const std::string& name, const std::vector<Uniform>& uniforms, std::uint64_t uniform_range) {
  UniformBlock block;
  block.name = name;
  for (const Uniform& uniform : uniforms) {
    if (uniform.constant) continue;
    const std::size_t size = uniform.type == Uniform::Type::vec4 ? 16 : 4;
    const std::size_t offset = (block.bytes.size() + size - 1) / size * size;  // std140: size is alignment here
    block.bytes.resize(offset + size);
    std::array<float, 4> f;
    std::transform(uniform.f.begin(), uniform.f.end(), f.begin(), [](double x) { return static_cast<float>(x); });
    const void* value = uniform.type == Uniform::Type::i32 ? static_cast<const void*>(&uniform.i) : f.data();
    std::memcpy(block.bytes.data() + offset, value, size);
    block.members.push_back({uniform.name, static_cast<std::uint32_t>(offset)});
  }
  block.bytes.resize((block.bytes.size() + 15) / 16 * 16);
  if (block.bytes.size() > uniform_range)
    throw NotSupported("the uniforms of " + name + " take " + std::to_string(block.bytes.size()) +
                       " bytes, but the device binds at most " + std::to_string(uniform_range) + " as one block");
  return block;
}

std::string block_text(const UniformBlock& block, const std::vector<Uniform>& uniforms) {
  std::string members, constants;
  for (const Uniform& uniform : uniforms) {
    if (uniform.constant)
      constants +=
          std::string("const ") + type_word(uniform.type) + " " + uniform.name + " = " + literal(uniform) + ";\n";
    else
      members += std::string("  ") + type_word(uniform.type) + " " + uniform.name + ";\n";
  }
  if (members.empty()) return constants;
  return "layout(std140, binding = " + std::to_string(block.binding) + ") uniform " + block.name + " {\n" + members +
         "};\n" + constants;
}

}  // namespace dvrlab
