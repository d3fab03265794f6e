#include "backends/cpu/stages.h"

#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <type_traits>

#include "backends/cpu/denormals.h"
#include "backends/cpu/isa.h"
#include "framework/interfaces/error.h"

namespace dvrlab::cpu {
namespace {

template <class Real>
void fill_rows(const StageJob& job, const std::string& isa, int threads, ModuleCache& modules, Real* out) {
  Bindings field;
  field.add(job.sampler);
  field.add(job.rays);  // where its blocks are
  const ModuleFrame<Real> sampler(modules.get(job.sampler.folder, job.sampler.plugin, isa), field.view(),
                                  DVR_FEATURE_VALUES);
  const auto& calls = sampler.calls().sampler;
  if (calls.values == nullptr)
    throw NotSupported("sampler \"" + job.sampler.plugin +
                       "\" cannot be asked at positions, so that no light volume can be filled");
  Bindings bindings;
  bindings.add(job.rays);
  bindings.add(job.stage);
  dvr_field asked{sampler.state(), nullptr, nullptr};
  if constexpr (std::is_same_v<Real, double>)
    asked.values64 = calls.values;
  else
    asked.values = calls.values;
  dvr_bindings view = bindings.view();
  view.field = asked;
  const ModuleFrame<Real> stage(modules.get(job.stage.folder, job.stage.plugin, isa), view,
                                job.rgb ? DVR_FEATURE_RGB : 0);
  const auto [nx, ny, nz] = job.grid.dims;
  const int parallel = thread_count(threads);
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, std::size_t(parallel));
  tbb::task_arena arena(parallel);
  // Rows in columns of few y and many z: what neighbouring rows read of the volumes stays in a core's cache then.
  constexpr int few = 16, many = 64;
  const tbb::blocked_range2d<int> columns(0, ny, few, 0, nz, many);
  arena.execute([&, nx = nx, ny = ny] {
    tbb::parallel_for(
        columns,
        [&](const tbb::blocked_range2d<int>& part) {
          const KeepDenormals keep;
          for (int z = part.cols().begin(); z < part.cols().end(); ++z)
            for (int y = part.rows().begin(); y < part.rows().end(); ++y) {
              const std::size_t row = std::size_t(z) * std::size_t(ny) + std::size_t(y);
              stage.calls().stage.fill_row(stage.state(), 0, nx, y, z, out + row * std::size_t(nx), job.grid.points());
            }
        },
        tbb::simple_partitioner());
  });
}

}  // namespace

void fill_volume(const StageJob& job, const std::string& isa, int threads, ModuleCache& modules, LightVolume& volume) {
  if (job.precision != Precision::fp64) {
    fill_rows<float>(job, isa, threads, modules, volume.values->data());
    return;
  }
  fill_rows<double>(job, fp64_isa, threads, modules, volume.values64->data());
  std::transform(volume.values64->begin(), volume.values64->end(), volume.values->begin(),
                 [](double x) { return static_cast<float>(x); });
}

}  // namespace dvrlab::cpu
