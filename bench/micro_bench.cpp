// The pieces of a frame on their own: the kernel modules of each instruction set through their C interface, one packet
// of rays at a time, and the host code that runs before a march.
#include <benchmark/benchmark.h>

#include <cstdio>

#include "backends/cpu/modules.h"
#include "bench/support/march_scene.h"
#include "framework/interfaces/error.h"
#include "framework/scene/macrocells.h"
#include "framework/scene/medium_table.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

/// The three modules of one instruction set, ready for the march scene.
struct Modules {
  cpu::Bindings bindings;
  std::unique_ptr<cpu::ModuleFrame<float>> sampler, estimator, march;
  int width, columns;

  Modules(const FrameJob& job, const std::string& isa) {
    static cpu::ModuleCache cache;
    for (const KernelUnit* unit : {&job.frame, &job.sampler, &job.estimator}) bindings.add(*unit);
    const auto open = [&](const std::string& folder, const std::string& name) {
      const dvr_kernel_module* module = cache.get(folder, name, isa);
      width = module->width;
      columns = module->packet_columns;
      return std::make_unique<cpu::ModuleFrame<float>>(module, bindings.view(), 0);
    };
    sampler = open(job.sampler.folder, job.sampler.plugin);
    estimator = open(job.estimator.folder, job.estimator.plugin);
    march = open(registry().find("backend", "cpu").folder, "march");
  }
  void begin(int x, int y, dvr_packet& packet) const {
    march->calls().march.begin(march->state(), x, y, &packet);
    sampler->calls().sampler.start(sampler->state(), &packet);
  }
  int fill(dvr_packet& packet, dvr_chunk& chunk) const {
    return sampler->calls().sampler.fill(sampler->state(), &packet, &chunk);
  }
};

const Scene& scene(const std::string& voxel_type) {
  static std::string known;
  static Scene kept;
  if (known != voxel_type) kept = march_scene({voxel_type, false});
  known = voxel_type;
  return kept;
}

bool runs_here(const std::string& isa, benchmark::State& state) {
  try {
    open_backend(R"({"type":"cpu","isa":")" + isa + "\"}");
    return true;
  } catch (const NotSupported& reason) {
    state.SkipWithError((std::string("not supported: ") + reason.what()).c_str());
    return false;
  }
}

/// Shown as a time: "per_sample=1.5ns".
void per_sample(benchmark::State& state, double samples) {
  state.counters["per_sample"] = benchmark::Counter(samples, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Every packet of the 64x64 pixels in the middle of the image, each to the end of its rays: voxels come from the
/// caches as they do in a frame. Lanes without a segment count.
void sampler(benchmark::State& state, const std::string& isa, const std::string& voxel_type) {
  if (!runs_here(isa, state)) return;
  const FrameJob& job = scene(voxel_type).job;
  const Modules m(job, isa);
  dvr_packet packet{};
  dvr_chunk chunk{};
  double samples = 0;
  for ([[maybe_unused]] auto _ : state) {
    for (int y = 0; y < 64; y += m.width / m.columns) {
      for (int x = 0; x < 64; x += m.columns) {
        m.begin(job.width / 2 - 32 + x, job.height / 2 - 32 + y, packet);
        while (const int rows = m.fill(packet, chunk)) samples += rows * m.width;
      }
    }
  }
  per_sample(state, samples);
}

/// The third chunk of the packet in the middle of the image, again and again: L1 resident, as in a frame. Nothing
/// branches on the packet's state, so it may end while the chunk is composited again.
void with_chunk(benchmark::State& state, const std::string& isa, bool composite) {
  if (!runs_here(isa, state)) return;
  const FrameJob& job = scene("float32").job;
  const Modules m(job, isa);
  dvr_packet packet{};
  dvr_chunk chunk{};
  m.begin(job.width / 2, job.height / 2, packet);
  for (int k = 0; k < 3; ++k) m.fill(packet, chunk);
  double samples = 0;
  m.estimator->calls().estimator.integrate(m.estimator->state(), &packet, &chunk);
  for ([[maybe_unused]] auto _ : state) {
    if (composite) {
      m.march->calls().march.composite(m.march->state(), &packet, &chunk);
    } else {
      m.estimator->calls().estimator.integrate(m.estimator->state(), &packet, &chunk);
    }
    benchmark::ClobberMemory();
    samples += chunk.n * m.width;
  }
  per_sample(state, samples);
}

void table(benchmark::State& state, int entries, bool nodes) {
  const Medium& medium = scene("float32").medium;
  for ([[maybe_unused]] auto _ : state) {
    KernelUnit unit;
    add_medium(medium, {nodes, entries, 0.0, 1.0, false, false, true}, unit);
    benchmark::DoNotOptimize(unit.buffers.data());
  }
}

void macrocells(benchmark::State& state, const std::string& voxel_type) {
  GridField grid = dynamic_cast<const GridField&>(*scene(voxel_type).field);
  for ([[maybe_unused]] auto _ : state) {
    grid.macrocells.reset();
    benchmark::DoNotOptimize(macrocells_of(grid));
  }
}

/// What every new transfer function costs, once the macrocells are there.
void empty_distances(benchmark::State& state) {
  const Scene& s = scene("float32");
  const MediumTableOptions options{false, 256, 0.0, 1.0, false, false, true};
  const auto cells = macrocells_of(dynamic_cast<const GridField&>(*s.field));
  for ([[maybe_unused]] auto _ : state)
    benchmark::DoNotOptimize(empty_distance(*cells, OccupiedBins(s.medium, options, 0)));
}

/// The shipped CT, with its decompression and its hash.
void load_engine(benchmark::State& state) {
  for ([[maybe_unused]] auto _ : state) {
    try {
      benchmark::DoNotOptimize(load_data(R"({"type":"nrrd","file":")" DVRLAB_SOURCE R"(/data/engine.nrrd"})"));
    } catch (const std::exception& e) {
      state.SkipWithError(e.what());
      return;
    }
  }
}

template <class... Arguments>
void add(const std::string& name, void (*function)(benchmark::State&, Arguments...),
         std::decay_t<Arguments>... arguments) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& s) {
    function(s, arguments...);
  })->Unit(benchmark::kMicrosecond);
}

void add_all() {
  for (const std::string type : {"float32", "uint8", "uint16", "int16", "int8"})
    for (const std::string isa : {"scalar", "sse4.2", "avx2", "avx512"})
      add("sampler/grid/" + isa + "/" + short_name(type), sampler, isa, type);
  for (const std::string isa : {"scalar", "sse4.2", "avx2", "avx512"}) {
    add("estimator/direct/" + isa, with_chunk, isa, false);
    add("compositor/" + isa, with_chunk, isa, true);
  }
  add("medium_table/256_entries", table, 256, false);
  add("medium_table/4096_entries", table, 4096, false);
  add("medium_table/nodes", table, 4096, true);
  add("macrocells/256^3_f32", macrocells, std::string("float32"));
  add("macrocells/256^3_u8", macrocells, std::string("uint8"));
  add("empty_distance/256^3", empty_distances);
  add("load/engine.nrrd", load_engine);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    add_all();
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return 3;
  }
  benchmark::Shutdown();
}
