// The figures that the project holds itself to, in one run: every contender renders one frame per round, round after
// round, so that a change of the machine's load or clock meets all of them. Prints Markdown tables.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <thread>

#include "bench/support/march_scene.h"
#include "framework/interfaces/error.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

struct Contender {
  std::string name, voxel_type, backend;
  std::unique_ptr<BackendSession> session;  // its own, so that no contender uploads or compiles for another
  std::string refusal;                      // why it cannot run here
  DeviceInfo device;
  std::vector<double> wall, cpu;  // ms per frame
  FrameCounters counters;
};

struct Options {
  int rounds = 9;
  std::vector<std::string> set;
};

const char* const isas[] = {"scalar", "sse4.2", "avx2", "avx512"};

unsigned processors() { return std::max(1u, std::thread::hardware_concurrency()); }

std::vector<Contender> contenders() {
  std::vector<Contender> all;
  const auto add = [&](const std::string& name, const std::string& type, const std::string& backend) {
    all.push_back({name, type, "{" + backend + "}", nullptr, "", {}, {}, {}, {}});
  };
  for (const char* type : {"float32", "uint8"}) {
    for (const std::string isa : isas) add("cpu " + isa, type, R"("type":"cpu","isa":")" + isa + '"');
    add("cpu, 1 thread", type, R"("type":"cpu","threads":1)");
    add("cpu, 2 threads", type, R"("type":"cpu","threads":2)");
    add("vulkan", type, R"("type":"vulkan")");
    add("opengl", type, R"("type":"opengl")");
  }
  return all;
}

/// One frame of a contender; the first one of all is the warm-up.
void frame(Contender& c, const Scene& scene, bool counts) {
  if (!c.refusal.empty()) return;
  try {
    if (!c.session) {
      c.session = open_backend(c.backend);
      c.device = c.session->device(Precision::strict);
    }
    const FrameCost cost = measure_frame(*c.session, scene.job);
    if (!counts) return;
    c.wall.push_back(cost.wall_ms);
    c.cpu.push_back(cost.cpu_ms);
    c.counters = cost.counters;
  } catch (const NotSupported& reason) {
    c.refusal = reason.what();
  }
}

/// Wall time of `dvrlab list`, process start included, in ms.
double list_milliseconds() {
  const char* const arguments[] = {DVRLAB_PROGRAM, "list", nullptr};
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", 1 /* O_WRONLY */, 0);
  posix_spawn_file_actions_addopen(&quiet, 2, "/dev/null", 1, 0);
  const auto start = std::chrono::steady_clock::now();
  pid_t child = 0;
  int status = -1;
  const int refused =
      posix_spawn(&child, DVRLAB_PROGRAM, &quiet, nullptr, const_cast<char* const*>(arguments), environ);
  if (refused == 0) waitpid(child, &status, 0);
  posix_spawn_file_actions_destroy(&quiet);
  if (status != 0) throw NotSupported(std::string(DVRLAB_PROGRAM) + " list failed");
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

std::string load_average() {
  std::ifstream in("/proc/loadavg");
  std::string one;
  in >> one;
  return one.empty() ? "unknown" : one;
}

void print_times(const std::vector<Contender>& all) {
  std::printf(
      "\n| contender | voxels | CPU ms, least | CPU ms, median | wall ms, least | wall ms, median | Msamples/s of "
      "wall, best |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const Contender& c : all) {
    std::printf("| %s | %s | ", c.name.c_str(), short_name(c.voxel_type).c_str());
    if (c.cpu.empty()) {
      std::printf("not supported: %s | | | | |\n", c.refusal.c_str());
      continue;
    }
    std::printf("%.0f | %.0f | %.0f | %.0f | %.1f |\n", least(c.cpu), median(c.cpu), least(c.wall), median(c.wall),
                1e-3 * static_cast<double>(c.counters.samples) / least(c.wall));
  }
}

const Contender* find(const std::vector<Contender>& all, const std::string& name, const std::string& type) {
  for (const Contender& c : all)
    if (c.name == name && c.voxel_type == type && !c.cpu.empty()) return &c;
  return nullptr;
}

/// A ratio of two contenders: of their least values, and the median of the rounds' own ratios.
struct Ratio {
  double of_least, of_rounds;
};
Ratio ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> rounds;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) rounds.push_back(a[k] / b[k]);
  return {least(a) / least(b), median(rounds)};
}

/// The goals in milliseconds hold for one kind of machine: AMD Zen 5, which calls itself family 26.
bool is_zen5() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("cpu family", 0) == 0) return line.ends_with(" 26");
  return false;
}

void figure(const char* what, double best, double typical, const char* goal, const char* reached) {
  std::printf("| %s | %.2f | %.2f | %s | %s |\n", what, best, typical, goal, reached);
}
const char* yes(bool met) { return met ? "yes" : "no"; }

/// Goals that hold on any machine are judged by the better of the two estimates: load only makes them worse.
void print_figures(const std::vector<Contender>& all, const std::vector<double>& list) {
  std::printf("\n| figure | of the least values | median over rounds | goal | reached |\n|---|---|---|---|---|\n");
  struct Absolute {
    const char *what, *name, *type, *goal;
    double bound;
  };
  const Absolute absolutes[] = {
      {"cpu avx512 f32, CPU ms", "cpu avx512", "float32", "<= 300 (AMD Zen 5)", 300},
      {"cpu avx512 u8, CPU ms", "cpu avx512", "uint8", "<= 260 (AMD Zen 5)", 260},
      {"vulkan f32, CPU ms", "vulkan", "float32", "<= 1.25 x 1265 (lavapipe, AMD Zen 5)", 1.25 * 1265},
      {"vulkan u8, CPU ms", "vulkan", "uint8", "<= 1.25 x 1120 (lavapipe, AMD Zen 5)", 1.25 * 1120},
      {"opengl f32, CPU ms", "opengl", "float32", "<= 1.25 x 1265 (llvmpipe, AMD Zen 5)", 1.25 * 1265},
      {"opengl u8, CPU ms", "opengl", "uint8", "<= 1.25 x 1120 (llvmpipe, AMD Zen 5)", 1.25 * 1120}};
  const bool zen5 = is_zen5();
  for (const Absolute& a : absolutes)
    if (const Contender* c = find(all, a.name, a.type))
      figure(a.what, least(c->cpu), median(c->cpu), a.goal, zen5 ? yes(least(c->cpu) <= a.bound) : "another machine");
  for (const char* type : {"float32", "uint8"}) {
    const std::string name = short_name(type);
    const Contender *cpu = find(all, "cpu avx512", type), *vulkan = find(all, "vulkan", type);
    if (cpu != nullptr && vulkan != nullptr) {
      const Ratio r = ratio(vulkan->cpu, cpu->cpu);
      figure(("vulkan / cpu avx512 " + name + ", CPU ms").c_str(), r.of_least, r.of_rounds,
             ">= 4 when vulkan is lavapipe", yes(std::max(r.of_least, r.of_rounds) >= 4));
    }
    const Contender *one = find(all, "cpu, 1 thread", type), *two = find(all, "cpu, 2 threads", type);
    if (one != nullptr && two != nullptr && processors() > 1) {
      const Ratio r = ratio(one->wall, two->wall), work = ratio(one->cpu, two->cpu);
      figure(("1 thread / 2 threads " + name + ", wall ms").c_str(), r.of_least, r.of_rounds, ">= 1.85",
             yes(std::max(r.of_least, r.of_rounds) >= 1.85));
      std::printf("| twice the CPU ms of 1 thread / of 2 threads %s (needs no idle machine) | %.2f | %.2f | | |\n",
                  name.c_str(), 2 * work.of_least, 2 * work.of_rounds);
    }
    for (const char* isa : {"scalar", "sse4.2", "avx2"}) {
      const Contender* other = find(all, std::string("cpu ") + isa, type);
      if (cpu == nullptr || other == nullptr) continue;
      const Ratio r = ratio(other->cpu, cpu->cpu);
      std::printf("| cpu %s / cpu avx512 %s, CPU ms | %.2f | %.2f | | |\n", isa, name.c_str(), r.of_least, r.of_rounds);
    }
  }
  figure("dvrlab list, wall ms", least(list), median(list), "< 50", yes(least(list) < 50));
}

void print_machine(const std::vector<Contender>& all, const Options& o) {
  std::printf("Processor: ");
  for (const Contender& c : all) {
    if (c.name == "cpu, 1 thread" && !c.refusal.empty()) std::printf("%s", c.refusal.c_str());
    if (c.name == "cpu, 1 thread" && c.refusal.empty()) std::printf("%s", c.device.device.c_str());
    if (c.name == "cpu, 1 thread") break;
  }
  std::printf(", %u hardware threads. Compiler: %s %s.\n", processors(),
#ifdef __clang__
              "clang",
#else
              "g++",
#endif
              __VERSION__);
  for (const char* name : {"vulkan", "opengl"})
    if (const Contender* c = find(all, name, "float32"))
      std::printf("%s: %s, %s, %s.\n", name, c->device.device.c_str(), c->device.driver.c_str(), c->device.api.c_str());
  std::printf("Repeat: ./dev bench figures --rounds %d", o.rounds);
  for (const std::string& s : o.set) std::printf(" --set %s", s.c_str());
  std::printf("\n");
}

int run(const Options& o) {
  const std::string load = load_average();
  std::vector<Contender> all = contenders();
  const Scene f32 = march_scene({"float32", false}, o.set), u8 = march_scene({"uint8", false}, o.set);
  std::vector<double> list;
  for (int round = 0; round <= o.rounds; ++round) {
    if (isatty(2) != 0) std::fprintf(stderr, "\rround %d of %d ", round, o.rounds);
    for (Contender& c : all) frame(c, c.voxel_type == "uint8" ? u8 : f32, round > 0);
    for (int k = 0; k < 3; ++k) list.push_back(list_milliseconds());
  }
  if (isatty(2) != 0) std::fprintf(stderr, "\r                \r");
  print_machine(all, o);
  std::printf("Load average (1 minute): %s before, %s after; this program itself adds about %u.\n", load.c_str(),
              load_average().c_str(), processors());
  for (const Contender& c : all) {
    if (c.cpu.empty()) continue;
    std::printf("Frame: %d x %d pixels, %.2f million samples.\n", f32.job.width, f32.job.height,
                1e-6 * static_cast<double>(c.counters.samples));
    break;
  }
  print_times(all);
  print_figures(all, list);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app{"The figures that dvrlab holds itself to, measured in one interleaved run"};
  app.add_option("--rounds", o.rounds, "frames of every contender")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--set", o.set, "key.path=value over configs/march_table.json; may be given more than once")
      ->allow_extra_args(false);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(o);
  } catch (const NotSupported& e) {
    std::fprintf(stderr, "not supported: %s\n", e.what());
    return 3;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return 2;
  }
}
