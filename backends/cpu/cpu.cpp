// The cpu backend: kernel modules of one instruction set, chosen at run time, over image tiles on all cores.
#include "backends/cpu/isa.h"
#include "backends/cpu/light_beside.h"
#include "backends/cpu/probe.h"
#include "backends/cpu/stages.h"
#include "backends/cpu/tiles.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/plugin.h"

namespace {
using namespace dvrlab;

const Parameter parameters[] = {
    {"isa", ParameterType::choice, "", "\"auto\"", "auto|scalar|sse4.2|avx2|avx512",
     "Instruction set of the kernel modules; auto takes the widest that the processor has, and the only one in fp64.",
     Affects::speed, "", "\"scalar\""},
    {"threads", ParameterType::integer, "", "0", "[0,1024]", "Worker threads; 0 takes one per hardware thread.",
     Affects::speed, "", "1"},
    {"tile", ParameterType::integer, "pixel", "16", "[4,1024]", "Side of the square image tiles that threads work on.",
     Affects::speed, "", "64"},
};

class CpuSession : public BackendSession {
 public:
  CpuSession(const ParameterSet& p, std::string folder)
      : isa_(cpu::choose_isa(p.text("isa"))), march_folder_(std::move(folder)) {
    options_.threads = static_cast<int>(p.integer("threads"));
    options_.tile = static_cast<int>(p.integer("tile"));
  }
  DeviceInfo device(Precision precision) const override {
    const std::string isa = precision == Precision::fp64 ? cpu::fp64_isa : isa_;
    return {cpu::processor_name(), "kernel modules " + isa, "C++ SIMD",
            "isa " + isa + ", " + std::to_string(cpu::thread_count(options_.threads)) + " threads, tile " +
                std::to_string(options_.tile)};
  }
  // The images, and light beside voxels; modules work in place on the job's buffers otherwise.
  std::uint64_t bytes_needed(const FrameJob& job) const override {
    const std::uint64_t number = sizeof(float) + (job.precision == Precision::fp64 ? sizeof(double) : 0);
    return std::uint64_t(job.width) * std::uint64_t(job.height) * 6 * number + cpu::LightBeside::bytes_for(job);
  }

 protected:
  void march(const FrameJob& job, FrameResult& result) override {
    if (job.precision == Precision::fast)
      throw NotSupported("backend cpu: precision \"fast\" is not built; use \"strict\"");
    std::vector<PhaseTime> times;
    const std::optional<FrameJob> with = beside_.add(job, times);
    cpu::render_tiles(with ? *with : job, isa_, march_folder_, modules_, options_, result);
    result.times.insert(result.times.end(), times.begin(), times.end());
  }
  std::vector<ProbeSegment> march_ray(const FrameJob& job, int x, int y) override {
    std::vector<PhaseTime> times;
    const std::optional<FrameJob> with = beside_.add(job, times);
    return cpu::probe_ray(with ? *with : job, isa_, march_folder_, modules_, x, y);
  }
  void fill(const StageJob& job, LightVolume& volume) override {
    cpu::fill_volume(job, isa_, options_.threads, modules_, volume);
  }

 private:
  std::string isa_, march_folder_;
  cpu::TileOptions options_;
  cpu::LightBeside beside_;
  cpu::ModuleCache modules_;
};

class Cpu : public BackendPlugin {
 public:
  BackendReport report() const override {
    std::string isas;
    for (const std::string& isa : cpu::usable_isas()) isas += (isas.empty() ? "" : ", ") + isa;
    DeviceReport d;
    d.name = cpu::processor_name();
    d.driver = "kernel modules";
    d.api = "C++ SIMD";
    d.property = {{"instruction sets", isas},
                  {"isa \"auto\"", cpu::choose_isa("auto")},
                  {"threads", std::to_string(cpu::thread_count(0))}};
    return {{d}, "", ""};
  }
  std::string refuses(Precision precision, const ParameterSet& p) const override {
    if (precision == Precision::fast) return "has no \"fast\" arithmetic; use \"strict\"";
    if (precision == Precision::fp64 && p.text("isa") != "auto")
      return "has one set of kernel modules in \"fp64\", for every processor; leave backend.isa at \"auto\"";
    return "";
  }
  std::unique_ptr<BackendSession> open(const ParameterSet& p, const std::string& folder) const override {
    return std::make_unique<CpuSession>(p, folder);
  }
};

}  // namespace

DVRLAB_PLUGIN("backend", "cpu", "1.0", Cpu, parameters,
              "SIMD kernel modules (scalar, SSE4.2, AVX2, AVX-512; fp64 for truth) over tiles with oneTBB", "")
