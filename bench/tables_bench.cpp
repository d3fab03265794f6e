// What pre-integration tables cost: a new table, the straightforward scalar build beside it, and partial updates.
// All contenders run once per round, round after round, so that a change of the machine's load meets all of them.
// Prints a Markdown table.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "backends/cpu/isa.h"
#include "bench/support/scalar_table.h"
#include "framework/interfaces/error.h"
#include "framework/scene/bin_groups.h"
#include "framework/scene/mean_table.h"
#include "plugins/estimator/power_series/moment_table.h"
#include "plugins/estimator/preintegrated/table_build.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::preintegrated;
using Kind = OutputChannel::Kind;

struct Options {
  int rounds = 5;
  std::vector<int> sizes = {256, 1024, 4096};
  std::string filter;  // only contenders whose name has this part
};

struct Contender {
  std::string name;
  std::function<void()> work;
  std::function<void()> prepare = [] {};  // not measured
  double goal = 0;                        // wall ms on two idle cores; 0 for none
  std::vector<double> wall = {}, cpu = {};
};

double cpu_ms() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

void measure(std::vector<Contender>& contenders, int rounds) {
  for (Contender& c : contenders) {
    c.prepare();
    c.work();
  }
  for (int round = 0; round < rounds; ++round) {
    for (Contender& c : contenders) {
      c.prepare();
      const double before = cpu_ms();
      const auto start = std::chrono::steady_clock::now();
      c.work();
      c.wall.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
      c.cpu.push_back(cpu_ms() - before);
    }
  }
}

void print(std::vector<Contender>& contenders) {
  for (Contender& c : contenders) {
    std::sort(c.wall.begin(), c.wall.end());
    std::sort(c.cpu.begin(), c.cpu.end());
    std::printf("| %s | %.4g | %.4g | %.4g | ", c.name.c_str(), c.wall[0], c.wall[c.wall.size() / 2], c.cpu[0]);
    if (c.goal > 0) std::printf("<= %g: %s", c.goal, c.wall[0] <= c.goal ? "yes" : "no");
    std::printf(" |\n");
  }
}

// A soft transfer function with every term, of so many intervals. Values in [lo, hi] are altered by `edit`.
Medium medium(double lo = 0, double hi = 0, double edit = 0, int intervals = 1000) {
  Medium m;
  for (int k = 0; k < intervals; ++k) {
    MediumInterval i{double(k) / intervals, double(k + 1) / intervals, {}};
    const double v = 0.5 * (i.v0 + i.v1), more = v > lo && v < hi ? 1 + edit : 1;
    for (int t = 0; t < term_count; ++t) {
      for (int ch = 0; ch < 3; ++ch) {
        const bool extinction = t == int(Term::tau_l) || t == int(Term::tau_s);
        const double color = extinction ? 1 : 0.5 + 0.5 * std::sin(7 * v + 2 * ch + t);
        i.c[std::size_t(column(static_cast<Term>(t), ch))] = {more * color * (1 + std::sin(11 * v + (t % 2))), 0.01, 0};
      }
    }
    m.interval.push_back(i);
  }
  return m;
}

TableRequest unshaded() {
  TableRequest r;
  for (int ch = 0; ch < 3; ++ch) r.columns.push_back({.E = true, .P = true, .channel = ch});
  r.outputs = {{Kind::total, 0}, {Kind::total, 1}, {Kind::total, 2}, {Kind::transmittance, 0}};
  return r;
}

// Source and T; S and W; their back parts: 12 channels.
TableRequest hybrid() {
  TableRequest r = unshaded();
  for (int ch = 0; ch < 3; ++ch) r.columns.push_back({.S = true, .channel = ch});
  r.columns.push_back({.W = true});
  for (Kind kind : {Kind::total, Kind::back})
    for (int c = 3; c < 7; ++c) r.outputs.push_back({kind, c});
  return r;
}

TableRequest as_ratio(TableRequest r) {
  for (OutputChannel& o : r.outputs)
    if (o.kind == Kind::transmittance) o = {};
  r.ratio = true;
  return r;
}

BuildMeans means(int threads = 0, const std::string& isa = "auto") { return {DVRLAB_TABLE_MODULES, isa, threads}; }

/// A table that the contenders share, each with its own edit of the values in [lo, hi] of the transfer functions.
struct Edited {
  Edited(const CellGrid& g, const TableRequest& request)
      : grid(g), plain(integrate_cells(medium(), grid)), table(plain, request, 1.0, means()) {}
  Contender edit(const std::string& name, double lo, double hi, const BuildMeans& how = means(), double goal = 0) {
    const Cells edited = integrate_cells(medium(lo, hi, 0.3), grid);
    return {name,
            [=, this] {
              if (!table.update(edited, how)) throw std::runtime_error("tables bench: the edit changes nothing");
            },
            [this] { table.update(plain, means()); }, goal};
  }
  CellGrid grid;
  Cells plain;
  Table table;
};

/// What a one-dimensional table costs, from the medium to what a kernel reads: one thread, unshaded RGBA, a transfer
/// function of 20 intervals. `moments`: of a power series.
struct OneDimensional {
  int bins, order, places;
  bool fp64;
  Medium source = medium(0, 0, 0, 20);
  MediumTableOptions options = {};
  void operator()() const {
    const BinMedium means = bin_groups(source, MediumLayout(source, options), options.lo, options.hi, bins, false);
    KernelUnit unit;
    add_means(means, false, fp64, unit);
    if (order * places > 1) power_series::moment_table(means, order, places, fp64);
  }
};

void compare(int n, const Options& o) {
  const CellGrid grid{n, 0, 1};
  const Medium m = medium();
  Edited rgba(grid, unshaded()), full(grid, hybrid()), ratios(grid, as_ratio(unshaded())),
      all_ratios(grid, as_ratio(hybrid()));
  bench::ScalarTable scalar;
  std::vector<Contender> all;
  all.push_back({"cells of the medium", [&] { integrate_cells(m, grid); }});
  all.push_back({"RGBA, new table in fresh memory", [&] { Table(rgba.plain, unshaded(), 1.0, means()); }});
  all.push_back(rgba.edit("RGBA, whole rebuild in place", 0, 1, means(), n == 1024 ? 10 : n == 4096 ? 250 : 0));
  for (const std::string& isa : cpu::usable_isas())
    all.push_back(rgba.edit("the same, 1 thread, " + isa, 0, 1, means(1, isa)));
  all.push_back(
      {"straightforward scalar incremental build, 1 thread", [&] { bench::build_scalar(rgba.plain, 1.0, scalar); }});
  const auto one = [&](const char* name, int order, int places, bool fp64, double goal) {
    all.push_back({name, OneDimensional{n, order, places, fp64}, [] {}, n == 4096 ? goal : 0});
  };
  one("1-D, power series of order 1, 1 thread", 1, 1, false, 0.06);
  one("1-D, power series of order 3, 1 thread", 3, 1, false, 0);
  one("1-D, power series of order 3 in fp64, 1 thread", 3, 1, true, 0.15);
  one("1-D, power series of order 1, cubic light, 1 thread", 1, 4, false, 0);
  all.push_back(ratios.edit("RGB ratios, whole rebuild", 0, 1));
  all.push_back(full.edit("hybrid, 12 channels, whole rebuild", 0, 1));
  all.push_back(all_ratios.edit("hybrid ratios, 11 channels, whole rebuild", 0, 1));
  for (double width : {0.01, 0.1, 0.5}) {
    char name[80];
    std::snprintf(name, sizeof(name), "RGBA, update of %g %% in the middle", 100 * width);
    all.push_back(rgba.edit(name, 0.5 - width / 2, 0.5 + width / 2));
    std::snprintf(name, sizeof(name), "RGBA, update of %g %% at the end", 100 * width);
    all.push_back(rgba.edit(name, 1 - width, 1));
  }
  std::erase_if(all, [&](const Contender& c) { return c.name.find(o.filter) == std::string::npos; });
  std::printf(
      "\n%d values, %.1f MiB of RGBA\n\n| what | wall ms, least | wall ms, median | CPU ms, least | goal "
      "|\n|---|---|---|---|---|\n",
      n, double(Table::bytes(n, unshaded())) / (1 << 20));
  measure(all, o.rounds);
  print(all);
  std::fflush(stdout);
}
}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app("Times of pre-integration tables, as Markdown tables");
  app.add_option("--rounds", o.rounds, "calls of every contender")->check(CLI::PositiveNumber);
  app.add_option("--sizes", o.sizes, "values per table")->check(CLI::Range(2, 65000));
  app.add_option("--filter", o.filter, "only contenders whose name has this part");
  CLI11_PARSE(app, argc, argv);
  try {
    std::printf("%s, %d threads, %s\n", cpu::processor_name().c_str(), cpu::thread_count(0),
                cpu::choose_isa("auto").c_str());
    for (int n : o.sizes) compare(n, o);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "dvrlab_tables_bench: %s\n", e.what());
    return 3;
  }
  return 0;
}
