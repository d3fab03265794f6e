// What is added to and refused in compiled shaders, and where they are kept.
#include "framework/shader/spirv.h"

#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "framework/shader/compile.h"
#include "framework/shader/compose.h"
#include "tests/gpu/gpu_test.h"

namespace dvrlab {
namespace {

using namespace gpu_test;

constexpr std::uint32_t op_decorate = 71, no_contraction = 42;
const std::set<std::uint32_t> float_arithmetic{127, 129, 131, 133, 136, 140, 141, 142, 143, 144, 145, 146, 147, 148};

struct Arithmetic {
  std::set<std::uint32_t> results;
  std::vector<std::uint32_t> decorated;
};

Arithmetic arithmetic_of(const Spirv& module) {
  Arithmetic found;
  for (std::size_t at = 5; at < module.size(); at += module[at] >> 16) {
    const std::uint32_t op = module[at] & 0xffff;
    if (float_arithmetic.contains(op)) found.results.insert(module[at + 2]);
    if (op == op_decorate && module[at + 2] == no_contraction) found.decorated.push_back(module[at + 1]);
  }
  return found;
}

CompiledShader compile(const std::string& probe_body, bool fast = false, ShaderTarget target = ShaderTarget::vulkan) {
  const ProbeKernels kernels(probe_body);
  FrameJob job = kernels.job(8, 8);
  job.precision = fast ? Precision::fast : Precision::strict;
  job.estimator.uniforms = {Uniform::real("u", 2)};
  return compile_shader(compose_shader(job, roomy_limits(target)));
}

/// Sets DVRLAB_CACHE while it lives.
class CacheFolder {
 public:
  explicit CacheFolder(const std::string& path) {
    if (const char* old = getenv("DVRLAB_CACHE")) old_ = old, had_ = true;
    setenv("DVRLAB_CACHE", path.c_str(), 1);
  }
  ~CacheFolder() { had_ ? setenv("DVRLAB_CACHE", old_.c_str(), 1) : unsetenv("DVRLAB_CACHE"); }

 private:
  std::string old_;
  bool had_ = false;
};

constexpr const char* arithmetic_body =
    "a.x = u * u + u;\n"
    "if (u * u - 1.0 < a.x) a.y = -u;\n"
    "int n = int(u * 3.0 + 0.5);\n"
    "a.z = float(n);\n"
    "b = vec4(u, u, u, u) * u;";

TEST(NoContraction, DecoratesEveryFloatInstructionOnce) {
  for (const ShaderTarget target : {ShaderTarget::vulkan, ShaderTarget::opengl}) {
    Spirv module = compile(arithmetic_body, false, target).spirv;
    const Arithmetic found = arithmetic_of(module);
    EXPECT_GE(found.results.size(), 8u);
    EXPECT_EQ(std::set<std::uint32_t>(found.decorated.begin(), found.decorated.end()), found.results);
    EXPECT_EQ(found.decorated.size(), found.results.size());
    const Spirv before = module;
    add_no_contraction(module);
    EXPECT_EQ(module, before) << "a second pass adds nothing";
  }
}

TEST(NoContraction, FastShadersMayContract) {
  const Arithmetic found = arithmetic_of(compile(arithmetic_body, true).spirv);
  EXPECT_GE(found.results.size(), 8u);
  EXPECT_TRUE(found.decorated.empty());
}

TEST(FloatModes, AreAskedForOnceInTheirPlaces) {
  Spirv module = compile(arithmetic_body).spirv;
  const std::size_t before = module.size();
  add_float_modes(module, {FloatMode::denorm_preserve, FloatMode::signed_zero_inf_nan_preserve});
  std::vector<std::uint32_t> order;
  for (std::size_t at = 5; at < module.size(); at += module[at] >> 16) order.push_back(module[at] & 0xffff);
  // Capability, extension, import, memory model, entry point, execution mode: the order that SPIR-V prescribes.
  const std::vector<std::uint32_t> expected{17, 17, 17, 10, 11, 14, 15, 16, 16, 16};
  ASSERT_GE(order.size(), expected.size());
  EXPECT_TRUE(std::equal(expected.begin(), expected.end(), order.begin()));
  EXPECT_EQ(module.size(), before + 2 * 2 + 7 + 2 * 4);
}

TEST(Strict, RefusesWhatDiffersBetweenDevicesByName) {
  const std::pair<const char*, const char*> faults[] = {{"a.x = exp(u);", "exp"},
                                                        {"a.x = log(u);", "log"},
                                                        {"a.x = pow(u, u);", "pow"},
                                                        {"a.x = sqrt(u);", "sqrt"},
                                                        {"a.x = inversesqrt(u);", "inversesqrt"},
                                                        {"a.x = fma(u, u, u);", "fma"},
                                                        {"a.x = sin(u);", "sin"},
                                                        {"a.x = cos(u);", "cos"},
                                                        {"a.x = mix(u, 1.0, u);", "mix"},
                                                        {"a.x = length(vec2(u, u));", "length"},
                                                        {"a.xy = normalize(vec2(u, u));", "normalize"},
                                                        {"a.x = 1.0 / u;", "division"},
                                                        {"a.x = dot(vec2(u, u), vec2(u, u));", "dot"},
                                                        {"a = mat4(u) * vec4(u);", "a matrix product"}};
  for (const auto& [body, name] : faults) {
    try {
      compile(body);
      ADD_FAILURE() << body << " was accepted";
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(std::string("a kernel uses ") + name), std::string::npos)
          << error.what();
    }
    EXPECT_NO_THROW(compile(body, true)) << body;
  }
  EXPECT_NO_THROW(compile("a.x = floor(u) + min(abs(u), 2.0);"));
}

TEST(Compile, ErrorNamesTheKernelsFileAndLine) {
  try {
    compile("a.x = u;\nb.x = unknown_word;");  // the body starts in line 2
    FAIL() << "it compiled";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("probe.kernel:3: error: 'unknown_word'"), std::string::npos)
        << error.what();
  }
}

TEST(SpirvCache, SecondCompileReadsTheFirstOnes) {
  const TemporaryFolder folder;
  const CacheFolder cache(folder.path());
  const CompiledShader first = compile(arithmetic_body), second = compile(arithmetic_body);
  EXPECT_FALSE(first.from_cache);
  EXPECT_TRUE(second.from_cache);
  EXPECT_EQ(first.spirv, second.spirv);
  EXPECT_FALSE(compile(arithmetic_body, true).from_cache);
  EXPECT_FALSE(compile(arithmetic_body, false, ShaderTarget::opengl).from_cache);
}

TEST(SpirvCache, DamagedEntryIsCompiledAgain) {
  const TemporaryFolder folder;
  const CacheFolder cache(folder.path());
  const CompiledShader first = compile(arithmetic_body);
  const std::string file = folder.path() + "/spirv/" + first.hash + ".spv";
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(200).write("damaged", 7);
  const CompiledShader second = compile(arithmetic_body);
  EXPECT_FALSE(second.from_cache);
  EXPECT_EQ(second.spirv, first.spirv);
  EXPECT_TRUE(compile(arithmetic_body).from_cache) << "the entry was mended";
  std::filesystem::resize_file(file, 10);
  EXPECT_FALSE(compile(arithmetic_body).from_cache);
}

TEST(SpirvCache, WorksWithoutAFolder) {
  const TemporaryFolder folder;
  std::ofstream(folder.path() + "/file") << "no folder";
  const CacheFolder cache(folder.path() + "/file");
  EXPECT_FALSE(compile(arithmetic_body).from_cache);
  EXPECT_FALSE(compile(arithmetic_body).from_cache);
}

}  // namespace
}  // namespace dvrlab
