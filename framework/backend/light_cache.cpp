#include "framework/backend/light_cache.h"

#include <algorithm>
#include <set>
#include <span>

#include "framework/backend/light_sum.h"
#include "framework/scene/phase_clock.h"
#include "framework/scene/sha256.h"

namespace dvrlab {
namespace {

/// What decides a volume, as bytes.
class Text {
 public:
  template <class T>
  void add(const T& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    text_.append(reinterpret_cast<const char*>(&x), sizeof x);
  }
  void add(const std::string& x) {
    add(x.size());
    text_ += x;
  }
  void add(const std::vector<Uniform>& uniforms) {
    for (const Uniform& u : uniforms) {
      add(u.name);
      add(u.f);
      add(u.i);
    }
  }
  /// Tables by what they hold, the field's memory by where it lies.
  void add(const Buffer& b, bool by_address) {
    add(b.name);
    add(b.count);
    if (by_address)
      add(b.data.get());
    else
      add(std::string(static_cast<const char*>(b.data.get()), b.bytes()));
  }
  std::string hash() const { return sha256({std::as_bytes(std::span(text_))}); }

 private:
  std::string text_;
};

StageJob stage_job(const FrameJob& job, const LightStage& stage) {
  const LightWork& work = *job.light;
  StageJob s;
  s.grid = stage.grid;
  s.rgb = work.rgb;
  s.precision = job.precision;
  s.rays = work.rays;
  s.sampler = work.sampler;
  s.kernel_folder = job.kernel_folder;
  s.gpu_buffer_limit = job.gpu_buffer_limit;
  s.long_loops = stage.long_loops;
  s.stage.plugin = stage.kernel;
  s.stage.folder = stage.folder;
  s.stage.uniforms = stage.uniforms;
  s.stage.buffers = stage.buffers;
  std::array<double, 3> step;
  for (std::size_t a = 0; a < 3; ++a) step[a] = (work.hi[a] - work.lo[a]) / std::max(stage.grid.dims[a] - 1, 1);
  s.stage.uniforms.insert(
      s.stage.uniforms.end(),
      {Uniform::integer("stage_nx", stage.grid.dims[0]), Uniform::integer("stage_ny", stage.grid.dims[1]),
       Uniform::integer("stage_nz", stage.grid.dims[2]),
       Uniform::constant_integer("stage_channels", stage.grid.channels),
       Uniform::constant_integer("stage_blocks", stage.grid.blocks ? 1 : 0),
       Uniform::constant_integer("stage_light", stage.first_light),
       Uniform::vector("stage_lo", work.lo[0], work.lo[1], work.lo[2]),
       Uniform::vector("stage_step", step[0], step[1], step[2]),
       Uniform::vector("stage_scale", 1 / step[0], 1 / step[1], 1 / step[2])});
  return s;
}

void add_read(const StageRead& read, const LightVolume* volume, const LightWork& work, KernelUnit& unit) {
  static const auto nothing = std::make_shared<std::vector<float>>(8);
  static const auto nothing64 = std::make_shared<std::vector<double>>(8);
  Buffer b;
  b.name = read.buffer;
  b.element = Element::f32;
  b.data = {nothing, nothing->data()};
  b.data64 = {nothing64, nothing64->data()};
  if (volume != nullptr) {
    b.count = volume->values->size();
    b.data = {volume->values, volume->values->data()};
    if (volume->values64) b.data64 = {volume->values64, volume->values64->data()};
    if (!volume->values64) b.data64 = nullptr;
  }
  unit.buffers.push_back(std::move(b));
  if (!read.placed || volume == nullptr) return;
  const auto& n = volume->grid.dims;
  const auto scale = [&](std::size_t a) { return (n[a] - 1) / (work.hi[a] - work.lo[a]); };
  unit.uniforms.insert(unit.uniforms.end(),
                       {Uniform::integer(read.buffer + "_nx", n[0]), Uniform::integer(read.buffer + "_ny", n[1]),
                        Uniform::integer(read.buffer + "_nz", n[2]),
                        Uniform::vector(read.buffer + "_lo", work.lo[0], work.lo[1], work.lo[2]),
                        Uniform::vector(read.buffer + "_scale", scale(0), scale(1), scale(2))});
}

}  // namespace

/// One call of volume(): stages are run when somebody asks for them.
struct LightCache::Run {
  const FrameJob& job;
  const Fill& fill;
  std::map<std::string, LightVolume>& kept;
  std::vector<std::string> key;
  std::vector<PhaseTime> times;

  Run(const FrameJob& j, const Fill& f, std::map<std::string, LightVolume>& k) : job(j), fill(f), kept(k) {
    Text common;
    common.add(job.light->rays.uniforms);
    for (const Buffer& b : job.light->rays.buffers) common.add(b, false);
    const KernelUnit& sampler = job.light->sampler;
    common.add(sampler.plugin);
    common.add(sampler.uniforms);
    for (const Buffer& b : sampler.buffers) common.add(b, true);
    common.add(job.kernel_folder);
    common.add(job.precision);
    common.add(job.light->rgb);
    common.add(job.light->lo);
    common.add(job.light->hi);
    const std::string base = common.hash();
    for (const LightStage& s : job.light->plan.stages) {
      Text t;
      t.add(base);
      t.add(s.folder);
      t.add(s.kernel);
      t.add(s.grid.dims);
      t.add(s.grid.channels);
      t.add(s.first_light);
      t.add(s.uniforms);
      for (const Buffer& b : s.buffers) t.add(b, false);
      for (const StageRead& r : s.reads) {
        t.add(r.buffer);
        t.add(r.stage < 0 ? std::string() : key[std::size_t(r.stage)]);
      }
      key.push_back(t.hash());
      times.push_back({"light " + s.label, 0, 0});
    }
  }

  const LightVolume& need(std::size_t index) {
    const auto known = kept.find(key[index]);
    if (known != kept.end()) return known->second;
    const LightStage& stage = job.light->plan.stages[index];
    for (const StageRead& r : stage.reads)
      if (r.stage >= 0) need(std::size_t(r.stage));
    const PhaseClock clock;
    StageJob s = stage_job(job, stage);
    for (const StageRead& r : stage.reads)
      add_read(r, r.stage < 0 ? nullptr : &kept.at(key[std::size_t(r.stage)]), *job.light, s.stage);
    LightVolume volume;
    volume.grid = stage.grid;
    volume.values = std::make_shared<std::vector<float>>(stage.grid.numbers());
    if (job.precision == Precision::fp64) volume.values64 = std::make_shared<std::vector<double>>(stage.grid.numbers());
    fill(s, volume);
    times[index].seconds = clock.wall();
    times[index].cpu_seconds = clock.cpu();
    drop_parts(index);
    return kept.emplace(key[index], std::move(volume)).first->second;
  }

  /// Of stages of one kernel that build on each other (one direction after the other) only the last is kept.
  void drop_parts(std::size_t index) {
    const auto& stages = job.light->plan.stages;
    for (const StageRead& r : stages[index].reads) {
      if (r.stage < 0 || stages[std::size_t(r.stage)].kernel != stages[index].kernel) continue;
      bool wanted = false;
      for (std::size_t later = index + 1; later < stages.size(); ++later)
        for (const StageRead& other : stages[later].reads) wanted = wanted || other.stage == r.stage;
      for (const LightPart& p : job.light->plan.parts)
        wanted = wanted || std::find(p.stages.begin(), p.stages.end(), r.stage) != p.stages.end();
      if (!wanted) kept.erase(key[std::size_t(r.stage)]);
    }
  }
};

/// What was kept for another field is not kept any longer.
void LightCache::start(const FrameJob& job) {
  std::vector<std::shared_ptr<const void>> sources;
  for (const Buffer& b : job.light->sampler.buffers) sources.push_back(b.data);
  if (sources != sources_) kept_.clear();
  sources_ = std::move(sources);
}

void LightCache::keep_only(const std::set<std::string>& used) {
  std::erase_if(kept_, [&](const auto& item) { return !used.contains(item.first); });
}

void LightCache::image(const FrameJob& job, const Fill& fill, FrameResult& result) {
  start(job);
  Run run(job, fill, kept_);
  std::vector<const LightVolume*> parts;
  for (const int s : job.light->plan.image) parts.push_back(&run.need(std::size_t(s)));
  join_image(job, parts, result);
  keep_only({run.key.begin(), run.key.end()});
  result.times = std::move(run.times);
}

LightVolume LightCache::volume(const FrameJob& job, const Fill& fill, std::vector<PhaseTime>& times) {
  const LightWork& work = *job.light;
  start(job);
  Run run(job, fill, kept_);
  std::vector<std::vector<const LightVolume*>> parts;
  for (const LightPart& p : work.plan.parts) {
    parts.emplace_back();
    for (const int s : p.stages) parts.back().push_back(&run.need(std::size_t(s)));
  }
  Text t;
  for (const LightPart& p : work.plan.parts) {
    t.add(p.first_light);
    t.add(p.clamp);
    t.add(p.error);
    t.add(p.color);
    for (const int s : p.stages) t.add(run.key[std::size_t(s)]);
  }
  for (const auto& color : work.color) t.add(color);
  t.add(work.plan.bias);
  t.add(work.plan.blend);
  t.add(work.plan.storage);
  const std::string key = t.hash();
  run.times.push_back({"light combine", 0, 0});
  if (!kept_.contains(key)) {
    const PhaseClock clock;
    LightVolume v = sum_of_light(job, parts);
    run.times.back() = {"light combine", clock.wall(), clock.cpu()};
    kept_.emplace(key, std::move(v));
  }
  std::set<std::string> used(run.key.begin(), run.key.end());
  used.insert(key);
  keep_only(used);
  times.insert(times.end(), run.times.begin(), run.times.end());
  return kept_.at(key);
}

}  // namespace dvrlab
