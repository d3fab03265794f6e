// What an unstructured mesh costs: set-up and memory, and a frame with each estimator that knows segments of any
// length; one segment per cell. Every contender renders one frame per round, round after round; ratios are to W8, the
// cheapest of Williams and Max 1992. Prints Markdown tables.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/support/config_scene.h"
#include "bench/support/march_scene.h"
#include "bench/support/process_memory.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

struct What {
  const char *name, *estimator, *density;  // density "": the config's
};
const char* const rgb =
    "optical_model.density=[[0,1.5,1.5,1.5],[0.3,0.1,0.2,0.5],[0.6,0.05,0.05,0.05],[0.75,0.8,0.3,0.1],[1,0.1,0.3,0.9]]";
const What whats[] = {
    {"W8: average, linear_opacity", R"({"type":"average","rule":"linear_opacity","shading":"constant"})", ""},
    {"W6: average, mean_density", R"({"type":"average","rule":"mean_density","shading":"constant"})", ""},
    {"W5: average, exact_depth", R"({"type":"average","rule":"exact_depth","shading":"constant"})", ""},
    {"approximative", R"({"type":"approximative","shading":"constant"})", ""},
    {"power_series, order 1", R"({"type":"power_series","shading":"constant"})", ""},
    {"preintegrated 256, ratios at 8 lengths", R"({"type":"preintegrated","table_size":256,"shading":"constant"})", ""},
    {"rk4, one step", R"({"type":"rk4","steps":1})", ""},
    {"exact", R"({"type":"exact"})", ""},
    {"W8, three densities", R"({"type":"average","rule":"linear_opacity","shading":"constant"})", rgb},
    {"exact, three densities", R"({"type":"exact"})", rgb}};

const char* const config = "bench/configs/meshes.json";

struct Contender {
  const What* what;
  Scene scene;
  std::unique_ptr<BackendSession> session;
  std::vector<double> cpu = {}, wall = {}, ratio = {};
  FrameCounters counters = {};
};

std::vector<std::string> keys_of(const What& w, const std::vector<std::string>& set) {
  std::vector<std::string> keys = set;
  keys.push_back(std::string("estimator=") + w.estimator);
  if (*w.density != '\0') keys.emplace_back(w.density);
  return keys;
}

std::string section(const std::string& backend) { return R"({"type":")" + backend + "\"}"; }

double seconds_of(const std::vector<PhaseTime>& times, const std::string& phase) {
  for (const PhaseTime& t : times)
    if (t.phase == phase) return t.seconds;
  return 0;
}

// Nothing else may have been loaded before: memory is what the process has grown by.
void set_up(const std::string& backend, const std::vector<std::string>& set) {
  const auto session = open_backend(section(backend));
  const double before = resident_bytes();
  const double start = wall_seconds();
  const Scene scene = config_scene(config, "", keys_of({"exact", R"({"type":"exact"})", ""}, set));
  const double loaded = wall_seconds() - start;
  const FrameCost first = measure_frame(*session, scene.job);
  const double kept = resident_bytes() - before, peak = peak_bytes() - before;
  std::vector<double> wall;
  for (int k = 0; k < 3; ++k) wall.push_back(measure_frame(*session, scene.job).wall_ms);
  const auto& mesh = dynamic_cast<const MeshField&>(*scene.field);
  const double tables = 1e3 * seconds_of(scene.times, "frame tables"), index = first.wall_ms - least(wall);
  const auto cells = static_cast<double>(mesh.cells());
  std::printf(
      "| mesh | cells | load, ms | adjacency and buffers, ms | entry faces' BVH and upload, ms | set-up, ms | bytes "
      "per cell, "
      "kept | bytes per cell, peak of the load |\n|---|---|---|---|---|---|---|---|\n");
  std::printf("| %s, %s | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f | %.0f |\n\n",
              mesh.source.substr(mesh.source.rfind('/') + 1).c_str(), backend.c_str(), cells, 1e3 * loaded - tables,
              tables, index, tables + index, kept / cells, peak / cells);
  std::fflush(stdout);
}

void compare(const std::string& backend, int rounds, const std::vector<std::string>& set) {
  std::vector<Contender> all;
  for (const What& w : whats)
    all.push_back({&w, config_scene(config, "", keys_of(w, set)), open_backend(section(backend))});
  for (int r = 0; r <= rounds; ++r) {
    for (Contender& c : all) {
      const FrameCost cost = measure_frame(*c.session, c.scene.job);
      c.counters = cost.counters;
      if (r == 0) continue;
      c.cpu.push_back(cost.cpu_ms);
      c.wall.push_back(cost.wall_ms);
    }
    if (r == 0) continue;
    for (Contender& c : all) c.ratio.push_back(c.cpu.back() / all.front().cpu.back());
  }
  for (const Contender& c : all)
    std::printf("| %s | %s | %.0f | %.0f | %.2f | %.2f | %.1f |\n", c.what->name, backend.c_str(), least(c.wall),
                least(c.cpu), least(c.cpu) / least(all.front().cpu), median(c.ratio),
                1e-6 * double(c.counters.samples));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"What an unstructured mesh costs: set-up, memory, and a frame with each estimator"};
  int rounds = 5;
  std::vector<std::string> backends = {"cpu"}, set;
  app.add_option("--rounds", rounds, "timed frames of each")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--backend", backends, "backends");
  app.add_option("--set", set, std::string("key=value of ") + config);
  CLI11_PARSE(app, argc, argv);
  try {
    set_up(backends.front(), set);
    std::printf(
        "| estimator | backend | wall ms, least | CPU ms, least | ratio of the least | median ratio | million segments "
        "|\n|---|---|---|---|---|---|---|\n");
    for (const std::string& b : backends) compare(b, rounds, set);
  } catch (const NotSupported& reason) {
    std::printf("not supported: %s\n", reason.what());
  }
  return 0;
}
