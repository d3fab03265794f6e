#include "framework/render_case.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "framework/config/expectation.h"
#include "framework/image/averaged.h"
#include "framework/interfaces/error.h"
#include "framework/report/interrupt.h"
#include "framework/report/log.h"
#include "framework/scene/system_memory.h"

namespace dvrlab {
namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// What a scene depends on: everything but the backend and what is only said about the case.
std::string scene_key(const ResolvedCase& c) {
  nlohmann::json key = c.config;
  for (const char* name : {"backend", "name", "panel", "repeat", "warmup", "metrics"}) key.erase(name);
  return key.dump();
}

double bytes_of(const FrameJob& job) {
  double bytes = 0;
  for (const KernelUnit* unit : {&job.frame, &job.sampler, &job.estimator}) {
    for (const Buffer& b : unit->buffers) bytes += static_cast<double>(b.bytes() + b.bytes64());
  }
  return bytes;
}

/// The times of the light volume's stages, which only a case's first frame has to fill.
std::vector<PhaseTime> take_light(std::vector<PhaseTime>& times) {
  const auto is_light = [](const PhaseTime& t) { return t.phase.starts_with("light "); };
  std::vector<PhaseTime> light;
  std::copy_if(times.begin(), times.end(), std::back_inserter(light), is_light);
  std::erase_if(times, is_light);
  return light;
}

/// What a case with a light volume or with blocks has without any comparison (own_values()).
Measure own_measure(const std::vector<std::pair<std::string, double>>& light,
                    const std::vector<std::pair<std::string, double>>& blocks,
                    const std::vector<PhaseStatistics>& times) {
  Measure m{own_reference, "light", {}, false};
  for (const auto& [name, value] : light) m.values.emplace_back("light." + name, value);
  for (const auto& [name, value] : blocks) m.values.emplace_back("blocks." + name, value);
  double filling = 0, direct = 0, march = 0;
  for (const PhaseStatistics& t : times) {
    if (t.phase.starts_with("light ")) filling += t.median;
    if (t.phase.starts_with("light ") && !t.phase.starts_with("light scatter")) direct += t.median;
    if (t.phase == "march") march = t.median;
  }
  m.values.insert(m.values.end(), {{"time.light", filling}, {"time.direct_light", direct}, {"time.march", march}});
  return m;
}

nlohmann::json scene_section(const Scene& s, double seconds) {
  const Field& f = *s.field;
  nlohmann::json phases = nlohmann::json::object();
  for (const PhaseTime& t : s.times) phases[t.phase] = t.seconds;
  nlohmann::json section = {
      {"source", f.source},
      {"sha256", f.sha256},
      {"sampler", s.job.sampler.plugin},
      {"value_range", {f.slope * f.stored_min + f.intercept, f.slope * f.stored_max + f.intercept}},
      {"voxel_world", f.voxel},
      {"step_world", s.step},
      {"terms", s.medium.terms().text()},
      {"notes", s.notes},
      {"seconds", seconds},
      {"phases", std::move(phases)}};
  if (const auto* grid = dynamic_cast<const GridField*>(&f)) section["dims"] = grid->dims;
  for (const auto& [name, value] : s.blocks) section["blocks"][name] = value;
  return section;
}

}  // namespace

CaseRenderer::CaseRenderer(const Registry& registry)
    : registry_(registry), memory_at_start_(system_memory().available) {}

const Scene& CaseRenderer::scene(const ResolvedCase& c, CaseRecord& record) {
  const std::string key = scene_key(c);
  if (scene_ == nullptr || key != scene_key_) {
    scene_.reset();
    require_data(c);
    const double start = now();
    const auto& data = registry_.get<DataPlugin>("data", c.data.type);
    MemoryBill memory = bill(c);
    memory.state("data", static_cast<double>(data.bytes_needed(c.data.parameters, load_context(c))));
    std::shared_ptr<const Field> field = fields_.load(c, registry_);
    state_scene_bytes(c, registry_, *field, memory);
    scene_ = std::make_unique<Scene>(build_scene(c, registry_, std::move(field)));
    scene_key_ = key;
    say(scene_->field->source);
    scene_record_ = scene_section(*scene_, now() - start);
    for (const auto& note : scene_record_["notes"]) say(note.get<std::string>());
  }
  record.scene = scene_record_;
  return *scene_;
}

void CaseRenderer::say(const std::string& note) {
  if (said_.insert(note).second) log_line("scene", note);
}

BackendSession& CaseRenderer::session(const ResolvedCase& c, Precision precision) {
  std::unique_ptr<BackendSession>& open = sessions_[c.config["backend"].dump()];
  if (open == nullptr) {
    const Section& b = c.backend;
    open = registry_.get<BackendPlugin>("backend", b.type).open(b.parameters, b.folder);
    const DeviceInfo info = open->device(precision);
    log_line("backend", b.type + ": " + info.device + (info.detail.empty() ? "" : ", " + info.detail));
  }
  return *open;
}

MemoryBill CaseRenderer::bill(const ResolvedCase& c) const {
  if (!c.limits.is_null("memory")) return {c.limits.json("memory").get<double>(), "limits.memory allows"};
  return {0.75 * static_cast<double>(memory_at_start_), "75 % of what was available is"};
}

FrameImage CaseRenderer::render(const ResolvedCase& c, const Scene& scene, CaseRecord& record) {
  BackendSession& backend = session(c, scene.job.precision);
  record.device = backend.device(scene.job.precision);
  MemoryBill memory = bill(c);
  memory.state("data and tables", bytes_of(scene.job));
  memory.state("backend '" + c.backend.type + "'", static_cast<double>(backend.bytes_needed(scene.job)));
  record.memory = memory.parts();
  FrameResult frame;
  std::vector<std::vector<PhaseTime>> repeats;
  bool light_is_new = true;
  for (long long i = 0; i < c.top.integer("warmup") && !interrupted(); ++i) {
    frame = {};
    backend.render(scene.job, frame);
    if (const std::vector<PhaseTime> light = take_light(frame.times); light_is_new && !light.empty())
      repeats.push_back(light);
    light_is_new = false;
  }
  for (long long i = 0; i < c.top.integer("repeat") && !(i > 0 && interrupted()); ++i) {
    frame = {};
    const double start = now();
    backend.render(scene.job, frame);
    frame.times.push_back({"frame", now() - start, -1.0});
    const std::vector<PhaseTime> light = take_light(frame.times);
    if (light_is_new) frame.times.insert(frame.times.begin(), light.begin(), light.end());
    light_is_new = false;
    repeats.push_back(std::move(frame.times));
  }
  record.times = phase_statistics(repeats);
  record.counters = frame.counters;
  if (!frame.light.empty() || !scene.blocks.empty())
    record.measures.push_back(own_measure(frame.light, scene.blocks, record.times));
  record.counters.table_fetches = record.counters.samples * static_cast<std::uint64_t>(scene.job.table_fetches);
  return averaged(std::move(frame.image), scene.rays_per_side);
}

}  // namespace dvrlab
