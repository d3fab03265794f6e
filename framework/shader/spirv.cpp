#include "framework/shader/spirv.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string>

namespace dvrlab {
namespace {

// Opcodes and decorations of the SPIR-V specification (unified1), those that are used here.
enum Op : std::uint32_t {
  OpName = 5,
  OpMemberName = 6,
  OpExtension = 10,
  OpExtInstImport = 11,
  OpExtInst = 12,
  OpMemoryModel = 14,
  OpEntryPoint = 15,
  OpExecutionMode = 16,
  OpCapability = 17,
  OpDecorate = 71,
  OpMemberDecorate = 72,
  OpTypeVoid = 19,
  OpFNegate = 127,
  OpFAdd = 129,
  OpFSub = 131,
  OpFMul = 133,
  OpFDiv = 136,
  OpFRem = 140,
  OpFMod = 141,
  OpVectorTimesScalar = 142,
  OpMatrixTimesScalar = 143,
  OpVectorTimesMatrix = 144,
  OpMatrixTimesVector = 145,
  OpMatrixTimesMatrix = 146,
  OpOuterProduct = 147,
  OpDot = 148
};
constexpr std::uint32_t decoration_offset = 35, decoration_no_contraction = 42;
constexpr std::size_t header_words = 5;

/// Calls f(opcode, words) for every instruction; `words` starts with the opcode's word.
template <class F>
void for_each_instruction(const Spirv& module, F f) {
  for (std::size_t at = header_words; at < module.size();) {
    const std::uint32_t length = module[at] >> 16;
    if (length == 0 || at + length > module.size()) throw std::runtime_error("the SPIR-V module is damaged");
    f(module[at] & 0xffffu, std::span(module).subspan(at, length));
    at += length;
  }
}

bool is_float_arithmetic(std::uint32_t op) {
  return op == OpFNegate || op == OpFAdd || op == OpFSub || op == OpFMul || op == OpFDiv || op == OpFRem ||
         op == OpFMod || (op >= OpVectorTimesScalar && op <= OpDot);
}

const char* inexact_operator(std::uint32_t op) {
  switch (op) {
    case OpFDiv:
      return "division";
    case OpFRem:
    case OpFMod:
      return "the remainder of floats";
    case OpMatrixTimesScalar:
    case OpVectorTimesMatrix:
    case OpMatrixTimesVector:
    case OpMatrixTimesMatrix:
    case OpOuterProduct:
      return "a matrix product";
    case OpDot:
      return "dot";
    default:
      return nullptr;
  }
}

/// GLSL.std.450 instructions that are exact by definition: rounding, absolute value, sign, min, max, clamp, bits.
bool is_exact(std::uint32_t instruction) {
  return (instruction >= 1 && instruction <= 9) || (instruction >= 37 && instruction <= 45) ||
         (instruction >= 73 && instruction <= 75) || (instruction >= 79 && instruction <= 81);
}

std::string extended_name(std::uint32_t instruction) {
  static const std::map<std::uint32_t, const char*> names{
      {10, "fract"},    {11, "radians"},     {12, "degrees"},   {13, "sin"},        {14, "cos"},    {15, "tan"},
      {25, "atan"},     {26, "pow"},         {27, "exp"},       {28, "log"},        {29, "exp2"},   {30, "log2"},
      {31, "sqrt"},     {32, "inversesqrt"}, {46, "mix"},       {49, "smoothstep"}, {50, "fma"},    {66, "length"},
      {67, "distance"}, {68, "cross"},       {69, "normalize"}, {71, "reflect"},    {72, "refract"}};
  const auto found = names.find(instruction);
  return found != names.end() ? found->second
                              : "the built-in function " + std::to_string(instruction) + " of GLSL.std.450";
}

std::string text_of(std::span<const std::uint32_t> words) {
  std::string text(reinterpret_cast<const char*>(words.data()), words.size() * 4);
  return text.substr(0, text.find('\0'));
}

}  // namespace

void add_no_contraction(Spirv& module) {
  std::set<std::uint32_t> done;
  std::vector<std::uint32_t> results;
  std::size_t place = 0;  // decorations come before the first type
  for_each_instruction(module, [&](std::uint32_t op, std::span<const std::uint32_t> words) {
    if (place == 0 && (op == OpDecorate || op == OpMemberDecorate || op == OpTypeVoid))
      place = std::size_t(words.data() - module.data());
    if (op == OpDecorate && words[2] == decoration_no_contraction) done.insert(words[1]);
    if (is_float_arithmetic(op)) results.push_back(words[2]);
  });
  Spirv added;
  for (const std::uint32_t id : results)
    if (done.insert(id).second) added.insert(added.end(), {3u << 16 | OpDecorate, id, decoration_no_contraction});
  module.insert(module.begin() + std::ptrdiff_t(place), added.begin(), added.end());
}

void add_float_modes(Spirv& module, const std::vector<FloatMode>& modes) {
  if (modes.empty()) return;
  std::size_t imports = 0,
              after_entry = 0;  // extensions come before the imports, execution modes after the entry point
  std::uint32_t entry = 0;
  for_each_instruction(module, [&](std::uint32_t op, std::span<const std::uint32_t> words) {
    const auto place = std::size_t(words.data() - module.data());
    if (imports == 0 && (op == OpExtInstImport || op == OpMemoryModel)) imports = place;
    if (op == OpEntryPoint) entry = words[2], after_entry = place + words.size();
  });
  // A mode's capability has a number five above its own.
  constexpr std::uint32_t capability_of_mode = 5, float_bits = 32;
  constexpr char extension[] = "SPV_KHR_float_controls";
  Spirv declared, chosen;
  for (const FloatMode mode : modes) {
    const auto number = static_cast<std::uint32_t>(mode);
    declared.insert(declared.end(), {2u << 16 | OpCapability, number + capability_of_mode});
    chosen.insert(chosen.end(), {4u << 16 | OpExecutionMode, entry, number, float_bits});
  }
  Spirv name((sizeof(extension) + 3) / 4);
  std::memcpy(name.data(), extension, sizeof(extension));
  declared.push_back(std::uint32_t(name.size() + 1) << 16 | OpExtension);
  declared.insert(declared.end(), name.begin(), name.end());
  module.insert(module.begin() + std::ptrdiff_t(after_entry), chosen.begin(), chosen.end());
  module.insert(module.begin() + std::ptrdiff_t(imports), declared.begin(), declared.end());
}

void check_strict(const Spirv& module) {
  for_each_instruction(module, [](std::uint32_t op, std::span<const std::uint32_t> words) {
    const char* name = inexact_operator(op);
    const std::string what = name != nullptr                          ? name
                             : op == OpExtInst && !is_exact(words[4]) ? extended_name(words[4])
                                                                      : "";
    if (!what.empty())
      throw std::runtime_error("a kernel uses " + what +
                               ", whose bits differ between devices; precision \"strict\" allows only the kernel "
                               "language's own functions");
  });
}

void check_offsets(const Spirv& module, const UniformBlock& block) {
  std::map<std::string, std::uint32_t> type_of;  // block name -> struct type
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> member_of;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> offset_of;
  for_each_instruction(module, [&](std::uint32_t op, std::span<const std::uint32_t> words) {
    if (op == OpName) type_of.emplace(text_of(words.subspan(2)), words[1]);
    if (op == OpMemberName) member_of[{words[1], text_of(words.subspan(3))}] = words[2];
    if (op == OpMemberDecorate && words[3] == decoration_offset) offset_of[{words[1], words[2]}] = words[4];
  });
  const auto type = type_of.find(block.name);
  if (type == type_of.end()) return;  // nothing reads it: the compiler dropped the block
  for (const UniformBlock::Member& member : block.members) {
    const auto index = member_of.find({type->second, member.name});
    if (index == member_of.end())
      throw std::logic_error(block.name + " lacks " + member.name + " in the compiled shader");
    const auto offset = offset_of.find({type->second, index->second});
    if (offset == offset_of.end() || offset->second != member.offset)
      throw std::logic_error(block.name + "." + member.name + " is not at byte " + std::to_string(member.offset) +
                             " of the compiled block");
  }
}

}  // namespace dvrlab
