// What light costs: every voxel's whole way to the light beside local piecewise integration, with the differences of
// the pictures; the updates of Hernell et al. 2008, figure 3: A (segments, shadow volume, direct light), B (one
// direction of scattering), C (a frame with the finished light). No early termination anywhere. Prints Markdown tables.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/support/config_scene.h"
#include "bench/support/march_scene.h"
#include "framework/interfaces/error.h"
#include "framework/metric/luv.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

const char* const config = "bench/configs/light.json";

struct Options {
  int rounds = 3;
  std::string backend = "cpu";
  std::vector<std::string> set;
};

std::string section(const std::string& backend) { return R"({"type":")" + backend + "\"}"; }

Scene scene_with(const std::string& illumination, const std::vector<std::string>& set) {
  std::vector<std::string> keys = set;
  keys.push_back("illumination=" + illumination);
  return config_scene(config, "", keys);
}

/// Seconds of the stages whose label begins with one of the words, or of all but the sum over lights.
double seconds_of(const std::vector<PhaseTime>& times, const std::vector<std::string>& words = {}) {
  double sum = 0;
  for (const PhaseTime& t : times) {
    const std::string label = t.phase.substr(6);
    const bool wanted = words.empty() ? label != "combine"
                                      : std::any_of(words.begin(), words.end(),
                                                    [&](const std::string& w) { return label.starts_with(w); });
    if (wanted) sum += t.seconds;
  }
  return sum;
}

/// World length from a grid point towards a directional light to the boundary of the box, over all points of a grid.
template <class Visit>
void ways_out(const Scene& scene, const std::array<int, 3>& dims, Visit visit) {
  const Field& f = *scene.field;
  const Buffer& source = *std::find_if(scene.job.light->rays.buffers.begin(), scene.job.light->rays.buffers.end(),
                                       [](const Buffer& b) { return b.name == "light_source"; });
  const auto* d = static_cast<const float*>(source.data.get());
  for (int z = 0; z < dims[2]; ++z)
    for (int y = 0; y < dims[1]; ++y)
      for (int x = 0; x < dims[0]; ++x) {
        double far = 1e300;
        const std::array<int, 3> at{x, y, z};
        for (std::size_t a = 0; a < 3; ++a) {
          const double p = f.lo[a] + (f.hi[a] - f.lo[a]) * at[a] / (dims[a] - 1);
          if (d[a] != 0) far = std::min(far, ((d[a] > 0 ? f.hi[a] : f.lo[a]) - p) / d[a]);
        }
        visit(far);
      }
}

double samples_full(const Scene& scene, double step) {
  double sum = 0;
  ways_out(scene, scene.job.light->dims, [&](double far) { sum += std::max(1.0, std::ceil(far / step)); });
  return sum;
}
double samples_piecewise(const Scene& scene, double segment, int per_segment, int ratio) {
  std::array<int, 3> coarse = scene.job.light->dims;
  for (int& n : coarse) n = (n - 1 + ratio - 1) / ratio + 1;
  double sum = 0;
  ways_out(scene, coarse, [&](double far) { sum += std::ceil(far / segment); });
  double own = per_segment;
  for (const int n : scene.job.light->dims) own *= n;
  return sum + own;
}

struct Difference {
  double rms, rate;
};
Difference difference(const FrameImage& a, const FrameImage& b) {
  double square = 0, above = 0;
  const std::size_t pixels = a.color.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto color = [&](const FrameImage& f) {
      return std::array{f.radiance(3 * i), f.radiance(3 * i + 1), f.radiance(3 * i + 2)};
    };
    const double e = luv_distance(color(a), color(b), false);
    square += e * e;
    above += e > 6 ? 1 : 0;
  }
  return {std::sqrt(square / double(pixels)), above / double(pixels)};
}

struct Piecewise {
  int segment, ratio;
};
std::string piecewise(const Piecewise& p, double step) {
  return R"([{"type":"local_piecewise","components":"direct","segment":)" + std::to_string(p.segment) +
         ",\"segment_samples\":" + std::to_string(int(p.segment / step)) + ",\"shadow_ratio\":[" +
         std::to_string(p.ratio) + "," + std::to_string(p.ratio) + "," + std::to_string(p.ratio) + "]}]";
}

/// The least time to fill a volume anew.
double fill(const Options& o, const Scene& scene, int rounds) {
  std::vector<double> seconds;
  for (int r = 0; r < rounds; ++r) {
    std::vector<PhaseTime> times;
    open_backend(section(o.backend))->illuminate(scene.job, times);
    seconds.push_back(seconds_of(times));
  }
  return least(seconds);
}

void against_full(const Options& o, double step) {
  const std::string steps = step == 1 ? "steps of a voxel" : "steps of half a voxel";
  const Scene full = scene_with(R"([{"type":"shadow_full","step":)" + std::to_string(step) + "}]", o.set);
  const double full_seconds = fill(o, full, 1), full_samples = samples_full(full, step * full.field->voxel);
  const auto session = open_backend(section(o.backend));
  FrameResult truth;
  session->render(full.job, truth);
  std::printf("| %s, %s: shadow_full | %.2f | %.0f | 1 | 1 | 0 | 0 |\n", o.backend.c_str(), steps.c_str(), full_seconds,
              1e-6 * full_samples);
  std::fflush(stdout);
  for (const Piecewise& p : {Piecewise{4, 1}, Piecewise{8, 1}, Piecewise{16, 1}, Piecewise{8, 4}}) {
    const Scene scene = scene_with(piecewise(p, step), o.set);
    const double seconds = fill(o, scene, o.rounds);
    const double samples = samples_piecewise(scene, p.segment * scene.field->voxel, int(p.segment / step), p.ratio);
    FrameResult frame;
    session->render(scene.job, frame);
    const Difference d = difference(frame.image, truth.image);
    std::printf("| segments of %d voxels, shadow volume 1:%d | %.2f | %.0f | %.1f | %.1f | %.2f | %.2f %% |\n",
                p.segment, p.ratio, seconds, 1e-6 * samples, full_seconds / seconds, full_samples / samples, d.rms,
                100 * d.rate);
    std::fflush(stdout);
  }
}

void updates(const Options& o) {
  const Scene scene = scene_with(
      R"([{"type":"local_piecewise","progressive":true,"directions_done":4,"radius":16,"samples":8}])", o.set);
  std::vector<double> a, b, combine;
  for (int r = 0; r < o.rounds; ++r) {
    std::vector<PhaseTime> times;
    open_backend(section(o.backend))->illuminate(scene.job, times);
    a.push_back(seconds_of(times, {"segment", "shadow", "direct"}));
    b.push_back(seconds_of(times, {"scatter"}) / 4);
    combine.push_back(seconds_of(times, {"combine"}));
  }
  std::printf("\n| update, %s | seconds, least |\n|---|---|\n", o.backend.c_str());
  std::printf(
      "| A: segments of 8, shadow volume 1:4, direct light | %.3f |\n| B: one direction, radius 16, 8 samples | %.3f "
      "|\n",
      least(a), least(b));
  std::printf("| the sum over lights, bias | %.3f |\n", least(combine));
  std::printf("\n| C: frame, %s | unlit, ms | lit, ms | ratio of the least | median ratio |\n|---|---|---|---|---|\n",
              o.backend.c_str());
  const std::pair<const char*, const char*> tfs[] = {{"surface-like", ""},
                                                     {"soft", "optical_model.opacity=[[0,0],[0.05,0.01],[1,0.2]]"}};
  for (const auto& [name, tf] : tfs) {
    std::vector<std::string> set = o.set;
    if (*tf != '\0') set.emplace_back(tf);
    for (const std::string storage : {"float32", "unorm16"}) {
      const Scene unlit = scene_with("[]", set);
      const Scene lit =
          scene_with(R"([{"type":"local_piecewise","components":"direct","storage":")" + storage + "\"}]", set);
      const auto session = open_backend(section(o.backend)), other = open_backend(section(o.backend));
      std::vector<double> without, with, ratio;
      for (int r = 0; r <= o.rounds + 4; ++r) {
        const double x = measure_frame(*session, unlit.job).wall_ms, y = measure_frame(*other, lit.job).wall_ms;
        if (r == 0) continue;
        without.push_back(x);
        with.push_back(y);
        ratio.push_back(y / x);
      }
      std::printf("| %s, light in %s | %.0f | %.0f | %.2f | %.2f |\n", name, storage.c_str(), least(without),
                  least(with), least(with) / least(without), median(ratio));
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"What light costs: local piecewise integration beside full shadows, and its updates"};
  Options o;
  bool skip_full = false;
  app.add_option("--rounds", o.rounds, "timed fills and frames of each")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--backend", o.backend, "backend")->capture_default_str();
  app.add_option("--set", o.set, std::string("key=value of ") + config);
  app.add_flag("--updates", skip_full, "only the updates, without full shadows");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!skip_full) {
      std::printf(
          "| light | fill, s | million samples | times faster | times fewer samples | Delta E, RMS | above 6 "
          "|\n|---|---|---|---|---|---|---|\n");
      against_full(o, 1);
      against_full(o, 0.5);
    }
    updates(o);
  } catch (const NotSupported& reason) {
    std::printf("not supported: %s\n", reason.what());
  }
  return 0;
}
