// What the hybrid model costs beside conventional shaded rendering, at equal steps and with the same estimator, without
// skipping and termination: the pairs of panels that Yang et al. 2012 compare in their table 1. Both frames of a pair
// are rendered in every round. Prints a Markdown table.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/support/config_scene.h"
#include "bench/support/march_scene.h"
#include "framework/interfaces/error.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

struct Pair {
  const char *name, *file, *conventional, *hybrid;
};
const Pair pairs[] = {{"figure 4 a, c", "configs/papers/yang2012/fig04.json", "a", "c"},
                      {"figure 4 a, d", "configs/papers/yang2012/fig04.json", "a", "d"},
                      {"figure 5 a, b", "configs/papers/yang2012/fig05.json", "a", "b"},
                      {"figure 5 c, d", "configs/papers/yang2012/fig05.json", "c", "d"}};
const char* const estimators[] = {R"({"type":"direct"})", R"({"type":"approximative"})", R"({"type":"preintegrated"})"};
const char* const backends[] = {R"({"type":"cpu"})", R"({"type":"vulkan"})", R"({"type":"opengl"})"};

struct Contender {
  Scene scene;
  std::unique_ptr<BackendSession> session;  // its own, so that neither uploads for the other
  std::vector<double> cpu, wall;

  void frame(bool counts) {
    const FrameCost cost = measure_frame(*session, scene.job);
    if (!counts) return;
    cpu.push_back(cost.cpu_ms);
    wall.push_back(cost.wall_ms);
  }
};

/// Where a zip decides the size, its values are replaced.
std::string size_override(const Pair& p, int side) {
  const nlohmann::json size = {side, side};
  if (std::string(p.file).find("fig05") == std::string::npos) return "image.size=" + size.dump();
  return "axes.permutation.zip[0].image.size=" + nlohmann::json{size, size, size, size}.dump();
}

void measure(const Pair& p, const std::string& estimator, const std::string& backend, int rounds, int side) {
  const std::vector<std::string> set = {"estimator=" + estimator, "sampling.skipping=false", size_override(p, side)};
  std::printf("| %s | %s | %s | ", p.name, nlohmann::json::parse(estimator).at("type").get<std::string>().c_str(),
              nlohmann::json::parse(backend).at("type").get<std::string>().c_str());
  try {
    Contender a{config_scene(p.file, p.conventional, set), open_backend(backend), {}, {}};
    Contender b{config_scene(p.file, p.hybrid, set), open_backend(backend), {}, {}};
    std::vector<double> ratio;
    for (int r = 0; r <= rounds; ++r) {
      a.frame(r > 0);
      b.frame(r > 0);
      if (r > 0) ratio.push_back(b.cpu.back() / a.cpu.back());
    }
    std::printf("%.0f | %.0f | %.2f | %.2f |\n", least(a.cpu), least(b.cpu), least(b.cpu) / least(a.cpu),
                median(ratio));
  } catch (const NotSupported& reason) {
    std::printf("not supported: %s | | | |\n", reason.what());
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"What the hybrid model costs beside conventional shaded rendering"};
  int rounds = 5, side = 256;
  app.add_option("--rounds", rounds, "timed frames of each")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--side", side, "pixels along each side of the image")
      ->capture_default_str()
      ->check(CLI::Range(16, 4096));
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| panels | estimator | backend | conventional, CPU ms, least | hybrid, CPU ms, least | ratio of the least | "
      "median ratio |\n|---|---|---|---|---|---|---|\n");
  for (const Pair& p : pairs)
    for (const char* estimator : estimators)
      for (const char* backend : backends) measure(p, estimator, backend, rounds, side);
  return 0;
}
