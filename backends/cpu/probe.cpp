#include "backends/cpu/probe.h"

#include "backends/cpu/denormals.h"
#include "backends/cpu/tiles.h"

namespace dvrlab::cpu {

namespace {

template <class Real>
std::vector<ProbeSegment> probe_with(const FrameModules<Real>& m, const FrameJob& job, int x, int y) {
  const KeepDenormals keep;
  const WalkMemory walk(m.packet_bytes);
  typename ScalarAbi<Real>::packet packet{};
  packet.walk = walk.get();
  typename ScalarAbi<Real>::chunk chunk{};
  std::vector<ProbeSegment> segments;
  // Lane 0 of a packet that starts at the pixel.
  m.march.calls().march.begin(m.march.state(), x, y, &packet);
  m.sampler.calls().sampler.start(m.sampler.state(), &packet);
  for (int l = 1; l < m.width; ++l) packet.n[l] = 0;
  while (m.sampler.calls().sampler.fill(m.sampler.state(), &packet, &chunk) > 0) {
    const int rows = chunk.n, first = packet.i[0] - rows;
    m.estimator.calls().estimator.integrate(m.estimator.state(), &packet, &chunk);
    // The compositor takes one row at a time, so that the ray's state behind each segment can be read.
    for (int k = 0; k < rows && packet.terminated[0] == 0; ++k) {
      typename ScalarAbi<Real>::chunk one = chunk;
      for (int r = 0; r < rows; ++r)
        if (r != k) one.len[r * m.width] = 0;
      m.march.calls().march.composite(m.march.state(), &packet, &one);
      const int a = k * m.width;
      if (!(chunk.len[a] > 0)) continue;
      ProbeSegment p;
      p.index = first + k;
      p.s = chunk.s[a + m.width];
      p.length = chunk.len[a];
      p.value = chunk.v[a + m.width];
      for (std::size_t c = 0; c < 3; ++c) {
        p.color[c] = chunk.c[c][a];
        p.trans[c] = chunk.t[job.rgb ? c : 0][a];
        p.color_behind[c] = packet.color[c][0];
        p.trans_behind[c] = packet.trans[job.rgb ? c : 0][0];
      }
      segments.push_back(p);
    }
  }
  return segments;
}

}  // namespace

std::vector<ProbeSegment> probe_ray(const FrameJob& job, const std::string& isa, const std::string& march_folder,
                                    ModuleCache& modules, int x, int y) {
  if (job.precision == Precision::fp64)
    return probe_with(FrameModules<double>(job, fp64_isa, march_folder, modules), job, x, y);
  return probe_with(FrameModules<float>(job, isa, march_folder, modules), job, x, y);
}

}  // namespace dvrlab::cpu
