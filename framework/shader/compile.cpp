#include "framework/shader/compile.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <cstring>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "framework/scene/sha256.h"
#include "framework/shader/disk_cache.h"

namespace dvrlab {
namespace {

constexpr const char* pass_version = "dvrlab-spirv-2";  // change it with what spirv.cpp adds to a module

/// "ERROR: 3:12: ..." -> "direct.kernel:12: error: ..."
std::string with_file_names(const std::string& log, const std::vector<std::string>& sources) {
  static const std::regex place("(ERROR|WARNING): ([0-9]+):([0-9]+): ");
  std::string text;
  auto rest = log.begin();
  for (std::sregex_iterator m(log.begin(), log.end(), place), end; m != end; ++m) {
    const std::size_t source = std::stoul((*m)[2]);
    text.append(rest, log.begin() + m->position());
    text += (source < sources.size() ? sources[source] : "?") + ":" + (*m)[3].str() +
            ((*m)[1] == "ERROR" ? ": error: " : ": warning: ");
    rest = log.begin() + m->position() + m->length();
  }
  return text.append(rest, log.end());
}

/// What the compiler found, on one line: without its closing words and counts.
std::string findings(const std::string& log) {
  std::istringstream lines(log);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    while (!line.empty() && line.back() == ' ') line.pop_back();
    const bool closing = line.empty() || line.find("compilation terminated") != std::string::npos ||
                         line.find(" compilation errors.") != std::string::npos;
    if (!closing) text += (text.empty() ? "" : "; ") + line;
  }
  return text;
}

[[noreturn]] void fail(const char* log, const ComposedShader& shader) {
  throw std::runtime_error("the kernels do not compile: " + findings(with_file_names(log, shader.sources)));
}

Spirv translate(const ComposedShader& shader) {
  static const bool ready = glslang::InitializeProcess();  // kept until the process ends
  if (!ready) throw std::runtime_error("glslang cannot be initialised");
  const bool vulkan = shader.target == ShaderTarget::vulkan;
  const glslang::EShClient client = vulkan ? glslang::EShClientVulkan : glslang::EShClientOpenGL;
  glslang::TShader stage(EShLangCompute);
  const char* text = shader.text.c_str();
  stage.setStrings(&text, 1);
  stage.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, client, 100);
  stage.setEnvClient(client, vulkan ? glslang::EShTargetVulkan_1_1 : glslang::EShTargetOpenGL_450);
  stage.setEnvTarget(glslang::EShTargetSpv, vulkan ? glslang::EShTargetSpv_1_3 : glslang::EShTargetSpv_1_0);
  const EShMessages rules = EShMessages(EShMsgSpvRules | (vulkan ? EShMsgVulkanRules : EShMsgDefault));
  if (!stage.parse(GetDefaultResources(), 450, false, rules)) fail(stage.getInfoLog(), shader);
  glslang::TProgram program;
  program.addShader(&stage);
  if (!program.link(rules)) fail(program.getInfoLog(), shader);
  glslang::SpvOptions options;
  options.disableOptimizer = true;
  Spirv module;
  glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), module, &options);
  return module;
}

}  // namespace

std::string shader_hash(const ComposedShader& shader) {
  const glslang::Version version = glslang::GetVersion();
  std::string options = std::string(pass_version) + (shader.target == ShaderTarget::vulkan ? " vulkan" : " opengl") +
                        (shader.fast ? " fast" : " strict");
  for (const FloatMode mode : shader.float_modes)
    options += " mode " + std::to_string(static_cast<std::uint32_t>(mode));
  options += " glslang " + std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
             std::to_string(version.patch) + "\n";
  return sha256({std::as_bytes(std::span(options)), std::as_bytes(std::span(shader.text))});
}

CompiledShader compile_shader(const ComposedShader& shader) {
  CompiledShader compiled;
  compiled.hash = shader_hash(shader);
  const DiskCache cache("spirv");
  const std::string name = compiled.hash + ".spv";
  if (const auto kept = cache.read(name)) {
    compiled.spirv.resize(kept->size() / sizeof(std::uint32_t));
    std::memcpy(compiled.spirv.data(), kept->data(), compiled.spirv.size() * sizeof(std::uint32_t));
    compiled.from_cache = true;
    return compiled;
  }
  compiled.spirv = translate(shader);
  check_offsets(compiled.spirv, shader.band);
  for (const UniformBlock& block : shader.blocks) check_offsets(compiled.spirv, block);
  if (!shader.fast) {
    check_strict(compiled.spirv);
    add_no_contraction(compiled.spirv);
    add_float_modes(compiled.spirv, shader.float_modes);
  }
  cache.write(name, std::as_bytes(std::span(compiled.spirv)));
  return compiled;
}

}  // namespace dvrlab
