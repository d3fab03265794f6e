// The march on every backend, instruction set and voxel type, with and without skipping, on one thread and on all.
// Manual time: wall time of a frame. Nothing is built or opened inside a timed frame.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <thread>

#include "bench/support/march_scene.h"
#include "framework/interfaces/error.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

struct Target {
  std::string name;
  std::string backend;  // section, without threads
  bool threads;         // has the parameter; a software GPU takes its own from LP_NUM_THREADS when it starts
};

const Target targets[] = {{"cpu-scalar", R"("type":"cpu","isa":"scalar")", true},
                          {"cpu-sse4.2", R"("type":"cpu","isa":"sse4.2")", true},
                          {"cpu-avx2", R"("type":"cpu","isa":"avx2")", true},
                          {"cpu-avx512", R"("type":"cpu","isa":"avx512")", true},
                          {"vulkan", R"("type":"vulkan")", false},
                          {"opengl", R"("type":"opengl")", false}};

/// What the last benchmark rendered: the library calls a benchmark several times while it looks for the number of
/// iterations, and neither scene nor warm-up may be repeated then.
struct Prepared {
  std::string scene_key, key;
  Scene scene;
  std::map<std::string, std::unique_ptr<BackendSession>> sessions;

  BackendSession& session(const std::string& section) {
    std::unique_ptr<BackendSession>& open = sessions[section];
    if (!open) open = open_backend(section);
    return *open;
  }
  /// A first frame uploads the data and compiles; software GPUs compile at their first dispatch.
  BackendSession& warm(const std::string& name, const std::string& section, const Variation& v) {
    const std::string wanted = v.voxel_type + (v.skipping ? " skipping" : "");
    BackendSession& s = session(section);
    if (wanted != scene_key) {
      scene = march_scene(v);
      scene_key = wanted;
    }
    if (name != key) measure_frame(s, scene.job);
    key = name;
    return s;
  }
};

void march(benchmark::State& state, const std::string& name, const std::string& section, const Variation& variation) {
  static Prepared prepared;
  try {
    BackendSession& session = prepared.warm(name, section, variation);
    std::vector<double> cpu;
    double wall_ms = 0;
    FrameCost cost;
    for ([[maybe_unused]] auto _ : state) {
      cost = measure_frame(session, prepared.scene.job);
      cpu.push_back(cost.cpu_ms);
      wall_ms += cost.wall_ms;
      state.SetIterationTime(1e-3 * cost.wall_ms);
    }
    const double samples = static_cast<double>(cost.counters.samples);
    state.counters["Msamples/s"] = 1e-3 * samples * static_cast<double>(cpu.size()) / wall_ms;
    state.counters["cpu_ms"] = median(cpu);
    state.counters["cpu_ms_best"] = least(cpu);
    state.counters["samples"] = samples;
    state.counters["skipped"] = static_cast<double>(cost.counters.skipped);
  } catch (const NotSupported& reason) {
    state.SkipWithError((std::string("not supported: ") + reason.what()).c_str());
  }
}

void add(const Target& target, const Variation& v, unsigned threads) {
  std::string name =
      "march/" + target.name + "/" + short_name(v.voxel_type) + "/skipping:" + (v.skipping ? "on" : "off");
  std::string section = "{" + target.backend;
  if (threads > 0) {
    name += "/threads:" + std::to_string(threads);
    section += ",\"threads\":" + std::to_string(threads);
  }
  section += "}";
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& s) { march(s, name, section, v); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

// Voxel types outermost: one field is in memory at a time.
void add_all() {
  const unsigned all = std::max(1u, std::thread::hardware_concurrency());
  for (const char* type : {"float32", "uint8", "uint16", "int16", "int8"}) {
    for (bool skipping : {false, true}) {
      for (const Target& target : targets) {
        if (target.threads) add(target, {type, skipping}, 1);
        if (!target.threads || all > 1) add(target, {type, skipping}, target.threads ? all : 0);
      }
    }
  }
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
