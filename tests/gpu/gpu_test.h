// What the GPU tests share: backends opened with their defaults, and jobs whose kernels are a few lines of GLSL.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "framework/interfaces/backend.h"
#include "framework/shader/shader.h"

namespace dvrlab::gpu_test {

/// Opens "vulkan" or "opengl" with JSON text for the parameters that differ from their defaults.
std::unique_ptr<BackendSession> open(const std::string& backend,
                                     const std::map<std::string, std::string>& changed = {});

/// A folder that vanishes with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// Kernel texts in a temporary folder; all empty but the march, which calls `probe(pixel, a, b)` of the estimator
/// "probe" and writes a and b as the pixel's two vectors.
class ProbeKernels {
 public:
  explicit ProbeKernels(const std::string& probe_body);
  void write(const std::string& file, const std::string& text) const;
  FrameJob job(int width, int height) const;

 private:
  TemporaryFolder folder_;
};

Buffer make_buffer(const std::string& name, Element element, std::uint64_t count, const void* values);

/// Limits of an imaginary device.
ShaderLimits roomy_limits(ShaderTarget target = ShaderTarget::vulkan);

}  // namespace dvrlab::gpu_test

/// Opens a session or skips the test with the reason.
#define DVRLAB_OPEN_OR_SKIP(session, ...)               \
  std::unique_ptr<::dvrlab::BackendSession> session;    \
  try {                                                 \
    session = ::dvrlab::gpu_test::open(__VA_ARGS__);    \
  } catch (const ::dvrlab::NotSupported& reason) {      \
    GTEST_SKIP() << "not supported: " << reason.what(); \
  }
