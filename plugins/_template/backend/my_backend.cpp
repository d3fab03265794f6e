// The `my_backend` backend: the kernel modules of one instruction set, ray packet by ray packet on one thread. The
// march is the contract of framework/interfaces/kernel_module.h; its modules are built beside this library.
#include <dlfcn.h>

#include <chrono>
#include <cstdlib>
#include <new>
#include <stdexcept>

#include "framework/interfaces/backend.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/kernel_module.h"

namespace dvrlab::my_backend {
namespace {

const Parameter parameters[] = {
    {"isa", ParameterType::choice, "", "\"scalar\"", "scalar|sse4.2", "Instruction set of the kernel modules.",
     Affects::speed, "", "\"sse4.2\""},
};

/// A job's uniforms and buffers as the modules' C structures. Refers to the job's memory.
struct Bindings {
  std::vector<dvr_uniform> uniforms;
  std::vector<dvr_buffer> buffers;
  explicit Bindings(const FrameJob& job) {
    for (const KernelUnit* unit : {&job.frame, &job.sampler, &job.estimator}) {
      for (const Uniform& u : unit->uniforms)
        uniforms.push_back({u.name.c_str(), int(u.type), {u.f[0], u.f[1], u.f[2], u.f[3]}, u.i});
      for (const Buffer& b : unit->buffers)
        buffers.push_back(
            {b.name.c_str(), int(b.element), b.data.get(), b.count, nullptr});  // both lists have one order
    }
  }
};

/// One kernel module and its state for one frame. Libraries stay open.
class Module {
 public:
  Module(const std::string& file, const Bindings& bindings, int features) {
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    using Entry = const dvr_kernel_module* (*)();
    const auto entry = library ? reinterpret_cast<Entry>(dlsym(library, "dvrlab_kernel_module")) : nullptr;
    if (entry == nullptr) throw std::runtime_error("backend my_backend: " + std::string(dlerror()));
    info = entry();
    if (info->abi != DVR_KERNEL_ABI || info->init == nullptr)
      throw std::runtime_error("backend my_backend: " + file + " has another kernel ABI; build the plugin again");
    const std::size_t align = std::max(64u, info->frame_align);
    state_ = ::operator new((info->frame_bytes + align - 1) / align * align, std::align_val_t(align));
    align_ = std::align_val_t(align);
    char missing[128] = "";
    // No surfaces: a mesh's sampler will say that its own is missing.
    dvr_bindings all{};
    all.uniforms = bindings.uniforms.data();
    all.uniform_count = int(bindings.uniforms.size());
    all.buffers = bindings.buffers.data();
    all.buffer_count = int(bindings.buffers.size());
    if (info->init(state_, &all, features, &calls, missing) != 0)
      throw InputError("backend my_backend: the kernel " + file + " reads \"" + missing + "\", which nobody provides");
  }
  ~Module() { ::operator delete(state_, align_); }
  Module(const Module&) = delete;
  Module& operator=(const Module&) = delete;
  const void* state() const { return state_; }
  const dvr_kernel_module* info = nullptr;
  dvr_calls calls{};

 private:
  void* state_ = nullptr;
  std::align_val_t align_{64};
};

class Session : public BackendSession {
 public:
  Session(std::string isa, std::string folder) : isa_(std::move(isa)), folder_(std::move(folder)) {}
  DeviceInfo device(Precision) const override {
    return {"one thread", "kernel modules " + isa_, "C++ SIMD", "isa " + isa_};
  }
  std::uint64_t bytes_needed(const FrameJob& job) const override {
    return std::uint64_t(job.width) * std::uint64_t(job.height) * 6 * sizeof(float);
  }

 protected:
  void march(const FrameJob& job, FrameResult& result) override {
    const Bindings bindings(job);
    const int features = (job.rgb ? DVR_FEATURE_RGB : 0) | (job.full ? DVR_FEATURE_FULL : 0);
    const auto module = [&](const KernelUnit& u) { return u.folder + "/" + u.plugin + "." + isa_ + ".so"; };
    const Module sampler(module(job.sampler), bindings, features), estimator(module(job.estimator), bindings, features),
        march(folder_ + "/march." + isa_ + ".so", bindings, features);
    const std::size_t values = 3 * std::size_t(job.width) * std::size_t(job.height);
    result = FrameResult{};
    result.image = {job.width, job.height, std::vector<float>(values), std::vector<float>(values)};
    const auto start = std::chrono::steady_clock::now();
    const int width = march.info->width, columns = march.info->packet_columns;
    alignas(64) std::byte walk[4096];
    if (sampler.info->packet_bytes > sizeof walk)
      throw NotSupported("backend my_backend: the sampler's walk is too large");
    dvr_packet packet{};
    dvr_chunk chunk{};
    packet.walk = walk;
    for (int y = 0; y < job.height; y += width / columns) {
      for (int x = 0; x < job.width; x += columns) {
        march.calls.march.begin(march.state(), x, y, &packet);
        sampler.calls.sampler.start(sampler.state(), &packet);
        for (int l = 0; l < width; ++l)  // lanes beside the image have no ray
          if (packet.x[l] >= job.width || packet.y[l] >= job.height) packet.n[l] = 0;
        while (sampler.calls.sampler.fill(sampler.state(), &packet, &chunk) > 0) {
          estimator.calls.estimator.integrate(estimator.state(), &packet, &chunk);
          march.calls.march.composite(march.state(), &packet, &chunk);
        }
        march.calls.march.finish(march.state(), &packet);
        take(packet, width, result);
      }
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    result.times.push_back({"march", seconds.count(), -1.0});
  }

 private:
  /// The finished rays of a packet into the image.
  static void take(const dvr_packet& packet, int width, FrameResult& result) {
    FrameImage& image = result.image;
    for (int l = 0; l < width; ++l) {
      if (packet.x[l] >= image.width || packet.y[l] >= image.height) continue;
      const std::size_t pixel = 3 * (std::size_t(packet.y[l]) * std::size_t(image.width) + std::size_t(packet.x[l]));
      for (std::size_t c = 0; c < 3; ++c) {
        image.color[pixel + c] = packet.color[c][l];
        image.trans[pixel + c] = packet.trans[c][l];
      }
      result.counters.samples += unsigned(packet.samples[l]);
      result.counters.skipped += unsigned(packet.skipped[l]);
      result.counters.terminated += unsigned(packet.terminated[l]);
    }
  }
  std::string isa_, folder_;
};

class MyBackend : public BackendPlugin {
 public:
  std::string refuses(Precision precision, const ParameterSet&) const override {
    return precision == Precision::strict ? "" : "has \"strict\" arithmetic only; use that";
  }
  std::unique_ptr<BackendSession> open(const ParameterSet& p, const std::string& folder) const override {
    if (p.text("isa") == "sse4.2" && !__builtin_cpu_supports("sse4.2"))
      throw NotSupported("backend my_backend: this processor has no sse4.2; use isa \"scalar\"");
    return std::make_unique<Session>(p.text("isa"), folder);
  }
};

}  // namespace

DVRLAB_PLUGIN("backend", "my_backend", "0.1", MyBackend, parameters,
              "kernel modules of one instruction set on one thread", "")

}  // namespace dvrlab::my_backend
