// The text of a frame's shader: names, layout, limits.
#include "framework/shader/compose.h"

#include "framework/interfaces/error.h"
#include "framework/shader/compile.h"
#include "framework/shader/paged_buffers.h"
#include "framework/shader/uniform_blocks.h"
#include "tests/gpu/gpu_test.h"

namespace dvrlab {
namespace {

using namespace gpu_test;

/// What the call throws as E, "" when it does not.
template <class E, class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const E& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Compose, DuplicateNameTellsBothOwners) {
  const ProbeKernels kernels("");
  FrameJob job = kernels.job(8, 8);
  job.sampler.uniforms = {Uniform::integer("size", 1)};
  job.estimator.uniforms = {Uniform::integer("size", 2)};
  const std::string text = message_of<std::logic_error>([&] { compose_shader(job, roomy_limits()); });
  EXPECT_TRUE(contains(text, "size is used by sampler \"none\" and by estimator \"probe\"")) << text;
}

TEST(Compose, NamesOfTheBackendAreTaken) {
  const ProbeKernels kernels("");
  FrameJob job = kernels.job(8, 8);
  job.frame.uniforms = {Uniform::integer("frame_width", 1)};
  EXPECT_TRUE(contains(message_of<std::logic_error>([&] { compose_shader(job, roomy_limits()); }), "the backend"));
}

TEST(Compose, TooManyPagesIsNotSupportedAndTellsTheBytes) {
  const ProbeKernels kernels("");
  FrameJob job = kernels.job(8, 8);
  const std::vector<std::uint8_t> values(4096);
  job.sampler.buffers = {make_buffer("voxels", Element::u8, values.size(), values.data())};
  job.gpu_buffer_limit = 256;
  const std::string text = message_of<NotSupported>([&] { compose_shader(job, roomy_limits()); });
  EXPECT_TRUE(contains(text, "voxels 4096") && contains(text, "16 pages") && contains(text, "256 bytes")) << text;
  job.gpu_buffer_limit = 512;
  EXPECT_EQ(compose_shader(job, roomy_limits()).buffers[0].pages.size(), 8u);
}

TEST(Compose, MissingTextIsNamed) {
  const ProbeKernels kernels("");
  FrameJob job = kernels.job(8, 8);
  job.estimator.plugin = "absent";
  EXPECT_TRUE(contains(message_of<std::runtime_error>([&] { compose_shader(job, roomy_limits()); }), "absent.kernel"));
}

TEST(Compose, EachTargetNumbersUniformBlocksItsWay) {
  const ProbeKernels kernels("");
  FrameJob job = kernels.job(8, 8);
  const float value = 1;
  job.sampler.buffers = {make_buffer("one", Element::f32, 1, &value)};
  EXPECT_EQ(compose_shader(job, roomy_limits(ShaderTarget::vulkan)).band.binding, 2);
  EXPECT_EQ(compose_shader(job, roomy_limits(ShaderTarget::opengl)).band.binding, 0);
}

TEST(UniformBlocks, OffsetsAreStd140AndTheCompilersOwn) {
  const ProbeKernels kernels("a = vec4(u_a + u_b.y, float(u_c), u_d, k_half);");
  FrameJob job = kernels.job(8, 8);
  Uniform half = Uniform::real("k_half", 0.5);
  half.constant = true;
  job.estimator.uniforms = {Uniform::real("u_a", 1), Uniform::vector("u_b", 2, 3, 4, 5), Uniform::integer("u_c", -7),
                            half, Uniform::real("u_d", 9)};
  const ComposedShader shader = compose_shader(job, roomy_limits());
  ASSERT_EQ(shader.blocks.size(), 1u);
  const UniformBlock& block = shader.blocks[0];
  std::vector<std::uint32_t> offsets;
  for (const auto& member : block.members) offsets.push_back(member.offset);
  EXPECT_EQ(offsets, (std::vector<std::uint32_t>{0, 16, 32, 36}));
  EXPECT_EQ(block.bytes.size(), 48u);
  EXPECT_TRUE(contains(shader.text, "const float k_half = float(0.5);"));
  const Spirv module = compile_shader(shader).spirv;
  EXPECT_NO_THROW(check_offsets(module, block));
  UniformBlock wrong = block;  // the planted fault
  wrong.members[3].offset = 40;
  EXPECT_THROW(check_offsets(module, wrong), std::logic_error);
}

TEST(PagedBuffers, PagesArePowersOfTwoAndCoverTheBuffer) {
  const std::vector<std::uint16_t> values(1000);
  const PagedBuffer paged = page_buffer(make_buffer("v", Element::u16, 1000, values.data()), 300, 5);
  EXPECT_EQ(paged.page_elements, 128u);
  ASSERT_EQ(paged.pages.size(), 8u);
  std::uint64_t next = 0;
  for (const BufferPage& page : paged.pages) {
    EXPECT_EQ(page.offset, next);
    EXPECT_LE(page.allocated, 300u);
    next += page.bytes;
  }
  EXPECT_EQ(next, 2000u);
  EXPECT_EQ(paged.pages.back().binding, 12);
}

TEST(PagedBuffers, TheElementAfterTheLastMayBeRead) {
  const std::vector<std::uint8_t> values(64);
  EXPECT_EQ(page_buffer(make_buffer("v", Element::u8, 64, values.data()), 1024, 1).pages[0].allocated, 80u);
}

}  // namespace
}  // namespace dvrlab
