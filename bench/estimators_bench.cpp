// What a frame costs with each estimator at equal steps, the same tables of 4096 entries and the same scene: every
// contender renders one frame per round, round after round. Ratios are to full pre-integration with the plain look-up
// (PI_2D of Lee and Shin 2013). Prints a Markdown table.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/support/config_scene.h"
#include "bench/support/march_scene.h"
#include "framework/interfaces/error.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

struct What {
  const char *name, *estimator;
};
const What whats[] = {
    {"preintegrated, plain (PI_2D)",
     R"({"type":"preintegrated","table_size":4096,"lookup":"plain","shading":"constant"})"},
    {"preintegrated, corrected", R"({"type":"preintegrated","table_size":4096,"shading":"constant"})"},
    {"power_series, order 1", R"({"type":"power_series","shading":"constant"})"},
    {"the same without opaque prediction",
     R"({"type":"power_series","shading":"constant","opaque_prediction":"off","max_extinction":1000})"},
    {"power_series, order 3, split", R"({"type":"power_series","order":3,"shading":"constant"})"},
    {"power_series, order 3, else order 1",
     R"({"type":"power_series","order":3,"shading":"constant","fallback":"order1"})"},
    {"approximative", R"({"type":"approximative","shading":"constant"})"},
    {"kye_1d (PI_1D)", R"({"type":"kye_1d","shading":"constant"})"},
    {"engel_1d", R"({"type":"engel_1d","shading":"constant"})"},
    {"direct (PC)", R"({"type":"direct"})"},
    {"preintegrated 1024, plain, nonlinear (NLPI_2D)",
     R"({"type":"preintegrated","table_size":1024,"lookup":"plain","shading":"nonlinear"})"},
    {"power_series, order 1, nonlinear (NLPI_PS)", R"({"type":"power_series","shading":"nonlinear"})"}};

struct Contender {
  const What* what;
  Scene scene;
  std::unique_ptr<BackendSession> session;
  std::vector<double> cpu = {}, ratio = {};
  FrameCounters counters = {};
};

void compare(const std::string& backend, int rounds, const std::vector<std::string>& set) {
  std::vector<Contender> all;
  for (const What& w : whats) {
    std::vector<std::string> keys = set;
    keys.push_back(std::string("estimator=") + w.estimator);
    all.push_back({&w, config_scene("bench/configs/estimators.json", "", keys),
                   open_backend(std::string(R"({"type":")") + backend + "\"}")});
  }
  for (int r = 0; r <= rounds; ++r) {
    for (Contender& c : all) {
      const FrameCost cost = measure_frame(*c.session, c.scene.job);
      if (r > 0) c.cpu.push_back(cost.cpu_ms);
      c.counters = cost.counters;
    }
    if (r == 0) continue;
    for (Contender& c : all) c.ratio.push_back(c.cpu.back() / all.front().cpu.back());
  }
  for (const Contender& c : all)
    std::printf("| %s | %s | %.0f | %.2f | %.2f | %.1f | %.1f |\n", c.what->name, backend.c_str(), least(c.cpu),
                least(c.cpu) / least(all.front().cpu), median(c.ratio), 1e-6 * double(c.counters.samples),
                1e-6 * double(c.counters.samples) * c.scene.job.table_fetches);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"What a frame costs with each estimator"};
  int rounds = 5;
  std::vector<std::string> backends = {"cpu"}, set;
  app.add_option("--rounds", rounds, "timed frames of each")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--backend", backends, "backends");
  app.add_option("--set", set, "key=value of bench/configs/estimators.json");
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| estimator | backend | CPU ms, least | ratio of the least | median ratio | million samples | million table "
      "fetches "
      "|\n|---|---|---|---|---|---|---|\n");
  for (const std::string& b : backends) {
    try {
      compare(b, rounds, set);
    } catch (const NotSupported& reason) {
      std::printf("| all | %s | not supported: %s | | | | |\n", b.c_str(), reason.what());
    }
  }
  return 0;
}
