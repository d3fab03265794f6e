#include "backends/cpu/tiles.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <new>

#include "backends/cpu/denormals.h"
#include "backends/cpu/isa.h"

namespace dvrlab::cpu {

namespace {

dvr_bindings view_of(const FrameJob& job, Bindings& bindings) {
  for (const KernelUnit* unit : {&job.frame, &job.sampler, &job.estimator}) bindings.add(*unit);
  return bindings.view();
}

int features_of(const FrameJob& job) { return (job.rgb ? DVR_FEATURE_RGB : 0) | (job.full ? DVR_FEATURE_FULL : 0); }

}  // namespace

FrameModules::FrameModules(const FrameJob& job, const std::string& isa, const std::string& march_folder,
                           ModuleCache& modules)
    : FrameModules(job, modules.get(job.sampler.folder, job.sampler.plugin, isa),
                   modules.get(job.estimator.folder, job.estimator.plugin, isa),
                   modules.get(march_folder, "march", isa), Bindings()) {}

FrameModules::FrameModules(const FrameJob& job, const dvr_kernel_module* sampler_module,
                           const dvr_kernel_module* estimator_module, const dvr_kernel_module* march_module,
                           Bindings bindings)
    : sampler(sampler_module, view_of(job, bindings), features_of(job)),
      estimator(estimator_module, bindings.view(), features_of(job)),
      march(march_module, bindings.view(), features_of(job)),
      width(march_module->width),
      columns(march_module->packet_columns),
      packet_bytes(sampler_module->packet_bytes) {}

WalkMemory::WalkMemory(const FrameModules& modules)
    : memory_(modules.packet_bytes == 0 ? nullptr : ::operator new(modules.packet_bytes, std::align_val_t(64))) {}
WalkMemory::~WalkMemory() { ::operator delete(memory_, std::align_val_t(64)); }

namespace {

struct Rect {
  int x0, y0, x1, y1;
};

void render_packet(const FrameModules& m, int x, int y, dvr_packet& packet, dvr_chunk& chunk, const FrameJob& job,
                   FrameResult& result, FrameCounters& counters) {
  m.march.calls().march.begin(m.march.state(), x, y, &packet);
  m.sampler.calls().sampler.start(m.sampler.state(), &packet);
  for (int l = 0; l < m.width; ++l)  // lanes beside the image have no ray
    if (packet.x[l] >= job.width || packet.y[l] >= job.height) packet.n[l] = 0;
  while (m.sampler.calls().sampler.fill(m.sampler.state(), &packet, &chunk) > 0) {
    m.estimator.calls().estimator.integrate(m.estimator.state(), &packet, &chunk);
    m.march.calls().march.composite(m.march.state(), &packet, &chunk);
  }
  m.march.calls().march.finish(m.march.state(), &packet);
  for (int l = 0; l < m.width; ++l) {
    if (packet.x[l] >= job.width || packet.y[l] >= job.height) continue;
    const std::size_t pixel = 3 * (std::size_t(packet.y[l]) * std::size_t(job.width) + std::size_t(packet.x[l]));
    for (std::size_t c = 0; c < 3; ++c) {
      result.image.color[pixel + c] = packet.color[c][l];
      result.image.trans[pixel + c] = packet.trans[c][l];
    }
    counters.samples += unsigned(packet.samples[l]);
    counters.skipped += unsigned(packet.skipped[l]);
    counters.terminated += unsigned(packet.terminated[l]);
  }
}

void render_tile(const FrameModules& m, const Rect& r, const FrameJob& job, FrameResult& result,
                 FrameCounters& counters) {
  const KeepDenormals keep;
  const WalkMemory walk(m);
  dvr_packet packet{};
  packet.walk = walk.get();
  dvr_chunk chunk{};
  const int rows = m.width / m.columns;
  for (int y = r.y0; y < r.y1; y += rows)
    for (int x = r.x0; x < r.x1; x += m.columns) render_packet(m, x, y, packet, chunk, job, result, counters);
}

double cpu_seconds() {
  rusage u{};
  getrusage(RUSAGE_SELF, &u);
  return double(u.ru_utime.tv_sec + u.ru_stime.tv_sec) + 1e-6 * double(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

}  // namespace

void render_tiles(const FrameJob& job, const std::string& isa, const std::string& march_folder, ModuleCache& modules,
                  const TileOptions& options, FrameResult& result) {
  const FrameModules m(job, isa, march_folder, modules);
  result.image.width = job.width;
  result.image.height = job.height;
  const std::size_t values = 3 * std::size_t(job.width) * std::size_t(job.height);
  result.image.color.assign(values, 0.0f);
  result.image.trans.assign(values, 0.0f);

  // Tiles are multiples of 4 pixels, so that no packet lies in two.
  const int tile = std::max(4, options.tile / 4 * 4);
  const int columns = (job.width + tile - 1) / tile, rows = (job.height + tile - 1) / tile;
  const int threads = thread_count(options.threads);
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  tbb::enumerable_thread_specific<FrameCounters> counters;
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, columns * rows, 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int t = range.begin(); t < range.end(); ++t) {
            const int x = t % columns * tile, y = t / columns * tile;
            render_tile(m, {x, y, std::min(x + tile, job.width), std::min(y + tile, job.height)}, job, result,
                        counters.local());
          }
        },
        tbb::simple_partitioner());
  });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  result.times.push_back({"march", seconds, cpu_seconds() - cpu});
  result.counters = {};
  for (const FrameCounters& c : counters) {
    result.counters.samples += c.samples;
    result.counters.skipped += c.skipped;
    result.counters.terminated += c.terminated;
  }
}

}  // namespace dvrlab::cpu
