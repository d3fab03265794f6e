#include "backends/cpu/tiles.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <new>

#include "backends/cpu/denormals.h"
#include "backends/cpu/entry_index.h"
#include "backends/cpu/isa.h"

namespace dvrlab::cpu {

namespace {

dvr_bindings view_of(const FrameJob& job, Bindings& bindings) {
  for (const KernelUnit* unit : {&job.frame, &job.sampler, &job.estimator}) bindings.add(*unit);
  // An index lives as long as the job's surface.
  for (const EntrySurface& s : job.sampler.surfaces)
    bindings.add({s.name.c_str(), entry_index_of(s).get(), EntryIndex::find, EntryIndex::find64});
  return bindings.view();
}

int features_of(const FrameJob& job) { return (job.rgb ? DVR_FEATURE_RGB : 0) | (job.full ? DVR_FEATURE_FULL : 0); }

}  // namespace

template <class Real>
FrameModules<Real>::FrameModules(const FrameJob& job, const std::string& isa, const std::string& march_folder,
                                 ModuleCache& modules)
    : FrameModules(job, modules.get(job.sampler.folder, job.sampler.plugin, isa),
                   modules.get(job.estimator.folder, job.estimator.plugin, isa),
                   modules.get(march_folder, "march", isa), Bindings()) {}

template <class Real>
FrameModules<Real>::FrameModules(const FrameJob& job, const dvr_kernel_module* sampler_module,
                                 const dvr_kernel_module* estimator_module, const dvr_kernel_module* march_module,
                                 Bindings bindings)
    : sampler(sampler_module, view_of(job, bindings), features_of(job)),
      estimator(estimator_module, bindings.view(), features_of(job)),
      march(march_module, bindings.view(), features_of(job)),
      width(march_module->width),
      columns(march_module->packet_columns),
      packet_bytes(sampler_module->packet_bytes) {}

template struct FrameModules<float>;
template struct FrameModules<double>;

WalkMemory::WalkMemory(unsigned bytes) : memory_(bytes == 0 ? nullptr : ::operator new(bytes, std::align_val_t(64))) {}
WalkMemory::~WalkMemory() { ::operator delete(memory_, std::align_val_t(64)); }

namespace {

struct Rect {
  int x0, y0, x1, y1;
};

/// Where a module's numbers go: the image, and its double when they are double.
void put(std::size_t at, float color, float trans, FrameImage& image) {
  image.color[at] = color;
  image.trans[at] = trans;
}
void put(std::size_t at, double color, double trans, FrameImage& image) {
  put(at, static_cast<float>(color), static_cast<float>(trans), image);
  image.color64[at] = color;
  image.trans64[at] = trans;
}

/// A packet with the memory of its march.
template <class Real>
struct OpenPacket {
  explicit OpenPacket(unsigned bytes) : walk(bytes) { packet.walk = walk.get(); }
  typename ScalarAbi<Real>::packet packet{};
  typename ScalarAbi<Real>::chunk chunk{};
  WalkMemory walk;
};

/// Neighbours in x and y that march in turn, a chunk each: the voxels that one has read are still in the L1 cache when
/// the next one wants them.
template <class Real>
struct PacketBlock {
  static constexpr int side = 2;
  explicit PacketBlock(unsigned bytes) {
    for (auto& p : packets) p = std::make_unique<OpenPacket<Real>>(bytes);
  }
  std::array<std::unique_ptr<OpenPacket<Real>>, std::size_t(side* side)> packets;
};

template <class Real>
void start_packet(const FrameModules<Real>& m, int x, int y, const FrameJob& job,
                  typename ScalarAbi<Real>::packet& packet) {
  m.march.calls().march.begin(m.march.state(), x, y, &packet);
  m.sampler.calls().sampler.start(m.sampler.state(), &packet);
  for (int l = 0; l < m.width; ++l)  // lanes beside the image have no ray
    if (packet.x[l] >= job.width || packet.y[l] >= job.height) packet.n[l] = 0;
}

/// False when every ray of the packet is through.
template <class Real>
bool march_chunk(const FrameModules<Real>& m, OpenPacket<Real>& p) {
  if (m.sampler.calls().sampler.fill(m.sampler.state(), &p.packet, &p.chunk) <= 0) return false;
  m.estimator.calls().estimator.integrate(m.estimator.state(), &p.packet, &p.chunk);
  m.march.calls().march.composite(m.march.state(), &p.packet, &p.chunk);
  return true;
}

template <class Real>
void finish_packet(const FrameModules<Real>& m, const FrameJob& job, typename ScalarAbi<Real>::packet& packet,
                   FrameResult& result, FrameCounters& counters) {
  m.march.calls().march.finish(m.march.state(), &packet);
  for (int l = 0; l < m.width; ++l) {
    if (packet.x[l] >= job.width || packet.y[l] >= job.height) continue;
    const std::size_t pixel = 3 * (std::size_t(packet.y[l]) * std::size_t(job.width) + std::size_t(packet.x[l]));
    for (std::size_t c = 0; c < 3; ++c) put(pixel + c, packet.color[c][l], packet.trans[c][l], result.image);
    counters.samples += unsigned(packet.samples[l]);
    counters.skipped += unsigned(packet.skipped[l]);
    counters.terminated += unsigned(packet.terminated[l]);
  }
}

/// The packets of a block from (x0, y0) on, as far as they lie in the tile.
template <class Real>
void render_block(const FrameModules<Real>& m, int x0, int y0, const Rect& r, PacketBlock<Real>& block,
                  const FrameJob& job, FrameResult& result, FrameCounters& counters) {
  const int side = PacketBlock<Real>::side, rows = m.width / m.columns;
  std::array<OpenPacket<Real>*, std::size_t(PacketBlock<Real>::side * PacketBlock<Real>::side)> open{};
  std::size_t count = 0;
  for (int y = y0; y < std::min(r.y1, y0 + side * rows); y += rows)
    for (int x = x0; x < std::min(r.x1, x0 + side * m.columns); x += m.columns) {
      open[count] = block.packets[count].get();
      start_packet(m, x, y, job, open[count++]->packet);
    }
  for (auto end = open.begin() + std::ptrdiff_t(count); end != open.begin();)
    end = std::remove_if(open.begin(), end, [&](OpenPacket<Real>* p) { return !march_chunk(m, *p); });
  for (std::size_t k = 0; k < count; ++k) finish_packet(m, job, block.packets[k]->packet, result, counters);
}

template <class Real>
void render_tile(const FrameModules<Real>& m, const Rect& r, PacketBlock<Real>& block, const FrameJob& job,
                 FrameResult& result, FrameCounters& counters) {
  const KeepDenormals keep;
  const int columns = PacketBlock<Real>::side * m.columns, rows = PacketBlock<Real>::side * (m.width / m.columns);
  for (int y = r.y0; y < r.y1; y += rows)
    for (int x = r.x0; x < r.x1; x += columns) render_block(m, x, y, r, block, job, result, counters);
}

double cpu_seconds() {
  rusage u{};
  getrusage(RUSAGE_SELF, &u);
  return double(u.ru_utime.tv_sec + u.ru_stime.tv_sec) + 1e-6 * double(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

void make_image(const FrameJob& job, FrameImage& image) {
  const std::size_t values = 3 * std::size_t(job.width) * std::size_t(job.height);
  const std::size_t values64 = job.precision == Precision::fp64 ? values : 0;
  image.width = job.width;
  image.height = job.height;
  image.color.assign(values, 0.0f);
  image.trans.assign(values, 0.0f);
  image.color64.assign(values64, 0.0);
  image.trans64.assign(values64, 0.0);
}

template <class Real>
void render_with(const FrameModules<Real>& m, const FrameJob& job, const TileOptions& options, FrameResult& result) {
  make_image(job, result.image);

  // Tiles are multiples of 4 pixels, so that no packet lies in two.
  const int tile = std::max(4, options.tile / 4 * 4);
  const int columns = (job.width + tile - 1) / tile, rows = (job.height + tile - 1) / tile;
  const int threads = thread_count(options.threads);
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = cpu_seconds();
  tbb::enumerable_thread_specific<FrameCounters> counters;
  tbb::enumerable_thread_specific<PacketBlock<Real>> blocks(m.packet_bytes);
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, std::size_t(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<int>(0, columns * rows, 1),
        [&](const tbb::blocked_range<int>& range) {
          for (int t = range.begin(); t < range.end(); ++t) {
            const int x = t % columns * tile, y = t / columns * tile;
            render_tile(m, {x, y, std::min(x + tile, job.width), std::min(y + tile, job.height)}, blocks.local(), job,
                        result, counters.local());
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

}  // namespace

void render_tiles(const FrameJob& job, const std::string& isa, const std::string& march_folder, ModuleCache& modules,
                  const TileOptions& options, FrameResult& result) {
  if (job.precision == Precision::fp64)
    render_with(FrameModules<double>(job, fp64_isa, march_folder, modules), job, options, result);
  else
    render_with(FrameModules<float>(job, isa, march_folder, modules), job, options, result);
}

}  // namespace dvrlab::cpu
