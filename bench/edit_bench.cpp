// From an edit of the transfer function to the first frame, per phase: medium, the framework's tables, the estimator's
// tables, and the frame with its uploads. Every round edits one node, so that no table is found in a cache.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <map>

#include "bench/support/config_scene.h"
#include "bench/support/march_scene.h"
#include "framework/interfaces/error.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

struct Contender {
  const char *name, *estimator, *edit;
};
// The first kind of edit raises a narrow peak, which changes 16 % of the values; the second the colour of everything.
const char* const narrow = "optical_model.surface.opacity=[[70,0],[90,0.35],[110,0],[165,0],[180,%.6f],[195,0]]";
const char* const color = "optical_model.color=[[0,0.85,0.8,%.6f],[160,0.85,0.8,0.7],[190,1,0.65,0.25]]";
const Contender contenders[] = {
    {"direct", R"({"type":"direct"})", narrow},
    {"approximative", R"({"type":"approximative"})", narrow},
    {"power_series, order 1", R"({"type":"power_series","shading":"constant"})", narrow},
    {"power_series, order 1, linear light", R"({"type":"power_series"})", narrow},
    {"preintegrated 1024, full", R"({"type":"preintegrated","table_size":1024,"update":"full"})", narrow},
    {"preintegrated 1024, partial", R"({"type":"preintegrated","table_size":1024,"update":"partial"})", narrow},
    {"preintegrated 1024, partial, colour", R"({"type":"preintegrated","table_size":1024,"update":"partial"})", color},
    {"preintegrated 256, full", R"({"type":"preintegrated","table_size":256,"update":"full"})", narrow},
};

using Times = std::map<std::string, std::vector<double>>;  // ms

void edit(const Contender& c, int round, BackendSession& session, Times& times, bool counts) {
  char assignment[200];
  std::snprintf(assignment, sizeof(assignment), c.edit, 0.5 + 0.002 * round);
  const auto start = std::chrono::steady_clock::now();
  const Scene scene =
      config_scene("bench/configs/edit.json", "", {std::string("estimator=") + c.estimator, assignment});
  FrameResult frame;
  session.render(scene.job, frame);
  const std::chrono::duration<double, std::milli> all = std::chrono::steady_clock::now() - start;
  if (!counts) return;
  for (const PhaseTime& t : scene.times) times[t.phase].push_back(1e3 * t.seconds);
  for (const PhaseTime& t : frame.times) times["frame: " + t.phase].push_back(1e3 * t.seconds);
  times["all"].push_back(all.count());
}

double of(const Times& times, const std::string& phase) {
  const auto found = times.find(phase);
  return found == times.end() ? 0 : median(found->second);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"From an edit of the transfer function to the first frame"};
  int rounds = 7;
  app.add_option("--rounds", rounds, "edits of each")->capture_default_str()->check(CLI::Range(1, 200));
  CLI11_PARSE(app, argc, argv);
  std::printf("Medians of %d edits, wall ms. `all` has the reading of the config, too.\n\n", rounds);
  std::printf("| estimator | backend | medium | frame tables | estimator tables | upload | march | all |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const Contender& c : contenders) {
    for (const char* backend : {"cpu", "vulkan", "opengl"}) {
      try {
        const auto session = open_backend(std::string(R"({"type":")") + backend + "\"}");
        Times times;
        for (int r = 0; r <= rounds; ++r) edit(c, r, *session, times, r > 0);
        double march = 0, upload = 0;
        for (const auto& [phase, list] : times) {
          if (!phase.starts_with("frame: ")) continue;
          (phase == "frame: upload" ? upload : march) += median(list);
        }
        std::printf("| %s | %s | %.2f | %.1f | %.1f | %.1f | %.0f | %.0f |\n", c.name, backend, of(times, "medium"),
                    of(times, "frame tables"), of(times, "estimator tables"), upload, march, of(times, "all"));
      } catch (const NotSupported& reason) {
        std::printf("| %s | %s | not supported: %s | | | | | |\n", c.name, backend, reason.what());
      }
      std::fflush(stdout);
    }
  }
  return 0;
}
