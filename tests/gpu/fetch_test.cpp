// The generated fetch functions, on both devices, against the host: every element type, one page and many.
#include <cmath>
#include <cstring>
#include <random>

#include "framework/interfaces/error.h"
#include "tests/gpu/gpu_test.h"

namespace dvrlab {
namespace {

using namespace gpu_test;

constexpr int count = 501;  // ends inside a word and inside a page

class Fetch : public testing::TestWithParam<const char*> {};

/// Every value of pixel i: three of color, three of trans.
struct Pixel {
  const float *a, *b;
};
Pixel pixel(const FrameResult& result, int i) {
  return {&result.image.color[3 * std::size_t(i)], &result.image.trans[3 * std::size_t(i)]};
}

/// Renders count pixels whose kernel reads the buffer "data", with pages of `page` elements (0: one page).
FrameResult fetch_all(BackendSession& session, const std::string& body, const Buffer& buffer, std::uint64_t page) {
  const ProbeKernels kernels(body);
  FrameJob job = kernels.job(count, 1);
  job.sampler.buffers = {buffer};
  job.gpu_buffer_limit = page * bytes_of(buffer.element);
  FrameResult result;
  session.render(job, result);
  return result;
}

template <class T>
void check_scalar(BackendSession& session, Element element) {
  std::mt19937 random(7);
  std::vector<T> values(count);
  for (T& v : values) {
    if constexpr (std::is_floating_point_v<T>)
      v = T(std::ldexp(double(random()), -20));
    else
      v = T(random());
  }
  const Buffer buffer = make_buffer("data", element, count, values.data());
  const std::string whole = std::is_floating_point_v<T> ? "0" : "fetchi_data(pixel)";
  const std::string body = "float p, q;\nfetch2_data(uint(pixel), p, q);\nint n = " + whole +
                           ";\na = vec4(fetch1_data(uint(pixel)), p, q, 0.0);\n"
                           "b = vec4(float(n >> 16), float(n & 0xffff), 0.0, 0.0);";
  for (const std::uint64_t page : {0, 64, 128}) {
    const FrameResult result = fetch_all(session, body, buffer, page);
    for (int i = 0; i < count; ++i) {
      const Pixel got = pixel(result, i);
      const float value = float(values[std::size_t(i)]);
      ASSERT_EQ(got.a[0], value) << "fetch1, element " << i << ", page " << page;
      ASSERT_EQ(got.a[1], value) << "fetch2, element " << i << ", page " << page;
      ASSERT_EQ(got.a[2], i + 1 < count ? float(values[std::size_t(i) + 1]) : 0.0f)
          << "fetch2, the element after " << i << ", page " << page;
      if constexpr (!std::is_floating_point_v<T>) {
        const auto n = std::int32_t(values[std::size_t(i)]);
        ASSERT_EQ(got.b[0], float(n >> 16)) << "fetchi, element " << i << ", page " << page;
        ASSERT_EQ(got.b[1], float(n & 0xffff)) << "fetchi, element " << i << ", page " << page;
      }
    }
  }
}

TEST_P(Fetch, ScalarsOfEveryType) {
  DVRLAB_OPEN_OR_SKIP(session, GetParam());
  check_scalar<std::uint8_t>(*session, Element::u8);
  check_scalar<std::int8_t>(*session, Element::i8);
  check_scalar<std::uint16_t>(*session, Element::u16);
  check_scalar<std::int16_t>(*session, Element::i16);
  check_scalar<std::int32_t>(*session, Element::i32);
  check_scalar<float>(*session, Element::f32);
}

TEST_P(Fetch, Vectors) {
  DVRLAB_OPEN_OR_SKIP(session, GetParam());
  std::vector<float> values(4 * count);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(i) + 0.25f;
  const Buffer buffer = make_buffer("data", Element::vec4, count, values.data());
  for (const std::uint64_t page : {0, 64, 128}) {
    const FrameResult result = fetch_all(*session, "a = fetch4_data(pixel);\nb.x = a.w;\na.w = 0.0;", buffer, page);
    for (int i = 0; i < count; ++i) {
      const Pixel got = pixel(result, i);
      const float first = values[4 * std::size_t(i)];
      ASSERT_EQ(got.a[0], first);
      ASSERT_EQ(got.a[1], first + 1);
      ASSERT_EQ(got.a[2], first + 2);
      ASSERT_EQ(got.b[0], first + 3);
    }
  }
}

TEST_P(Fetch, AChangedBufferIsUploadedAgain) {
  DVRLAB_OPEN_OR_SKIP(session, GetParam());
  std::vector<float> values(count, 3.0f);
  const Buffer first = make_buffer("data", Element::f32, count, values.data());
  values.assign(count, 4.0f);
  const Buffer second = make_buffer("data", Element::f32, count, values.data());
  const std::string body = "a.x = fetch1_data(uint(pixel));";
  EXPECT_EQ(pixel(fetch_all(*session, body, first, 0), 5).a[0], 3.0f);
  EXPECT_EQ(pixel(fetch_all(*session, body, second, 0), 5).a[0], 4.0f);
}

TEST_P(Fetch, AnEmptyBufferReadsZero) {
  DVRLAB_OPEN_OR_SKIP(session, GetParam());
  const float nothing = 0;
  const Buffer buffer = make_buffer("data", Element::f32, 0, &nothing);
  EXPECT_EQ(pixel(fetch_all(*session, "a.x = fetch1_data(0u) + 1.0;", buffer, 0), 0).a[0], 1.0f);
}

INSTANTIATE_TEST_SUITE_P(Devices, Fetch, testing::Values("vulkan", "opengl"),
                         [](const auto& device) { return std::string(device.param); });

}  // namespace
}  // namespace dvrlab
