#include "tests/gpu/gpu_test.h"

#include <stdlib.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/plugin/registry.h"

namespace dvrlab::gpu_test {
namespace {

constexpr const char* march = R"(layout(local_size_x = 8, local_size_y = 8) in;
void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y) + frame_band_y;
  if (x >= frame_width || y >= frame_height) return;
  vec4 a = vec4(0.0), b = vec4(0.0);
  probe(y * frame_width + x, a, b);
  int out_index = 2 * ((y - frame_band_y) * frame_width + x);
  dvr_out[out_index] = a;
  dvr_out[out_index + 1] = b;
}
)";

}  // namespace

std::unique_ptr<BackendSession> open(const std::string& backend, const std::map<std::string, std::string>& changed) {
  static const Registry registry;
  const PluginEntryInfo& entry = registry.find("backend", backend);
  const std::vector<Parameter> declared(entry.descriptor->parameters,
                                        entry.descriptor->parameters + entry.descriptor->parameter_count);
  nlohmann::json values = nlohmann::json::object();
  for (const Parameter& parameter : declared) {
    const auto set = changed.find(parameter.name);
    values[parameter.name] = nlohmann::json::parse(set != changed.end() ? set->second : parameter.default_value);
  }
  return registry.get<BackendPlugin>("backend", backend).open(ParameterSet("backend", declared, values), entry.folder);
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "dvrlab_test_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

ProbeKernels::ProbeKernels(const std::string& probe_body) {
  const std::filesystem::path real = Registry::kernel_folder();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(real)) {
    const std::string name = std::filesystem::relative(entry.path(), real).string();
    if (entry.is_directory())
      std::filesystem::create_directory(folder_.path() + "/" + name);
    else
      write(name, "");
  }
  write("none.kernel", "");
  write("march.glsl", march);
  write("probe.kernel", "void probe(int pixel, out vec4 a, out vec4 b) {\n" + probe_body + "\n}\n");
}

void ProbeKernels::write(const std::string& file, const std::string& text) const {
  std::ofstream(folder_.path() + "/" + file) << text;
}

FrameJob ProbeKernels::job(int width, int height) const {
  FrameJob job;
  job.width = width;
  job.height = height;
  job.kernel_folder = folder_.path();
  job.frame.plugin = "frame";
  job.sampler.plugin = "none";
  job.estimator.plugin = "probe";
  job.sampler.folder = job.estimator.folder = folder_.path();
  return job;
}

Buffer make_buffer(const std::string& name, Element element, std::uint64_t count, const void* values) {
  Buffer buffer;
  buffer.name = name;
  buffer.element = element;
  buffer.count = count;
  std::shared_ptr<std::byte[]> memory(new std::byte[buffer.bytes() + 1]);
  std::memcpy(memory.get(), values, buffer.bytes());
  buffer.data = memory;
  return buffer;
}

ShaderLimits roomy_limits(ShaderTarget target) { return {target, 1u << 27, 1u << 16, 16, false, {}}; }

}  // namespace dvrlab::gpu_test
