#include "bench/support/march_scene.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>

#include "framework/config/experiment.h"

namespace dvrlab::bench {
namespace {

ResolvedCase resolve(const std::vector<std::string>& set) {
  const Experiment e = plan_experiment(load_document(DVRLAB_BENCH_FOLDER "/configs/march_table.json", set), registry());
  return e.cases.front().resolved;
}

}  // namespace

const Registry& registry() {
  static const Registry found;
  return found;
}

Scene march_scene(const Variation& variation, const std::vector<std::string>& set) {
  static FieldCache fields;
  std::vector<std::string> all = {"data.voxel_type=" + variation.voxel_type,
                                  std::string("sampling.skipping=") + (variation.skipping ? "true" : "false")};
  all.insert(all.end(), set.begin(), set.end());
  const ResolvedCase c = resolve(all);
  return build_scene(c, registry(), fields.load(c, registry()));
}

std::shared_ptr<const Field> load_data(const std::string& section) {
  nlohmann::json config = {{"data", nlohmann::json::parse(section)},
                           {"optical_model", {{"type", "absorption_emission"}, {"opacity", {{0, 0}, {1, 0.1}}}}},
                           {"estimator", {{"type", "direct"}}},
                           {"camera", {{"type", "perspective"}, {"position", {0, -3, 0}}}},
                           {"sampling", {{"type", "uniform"}}}};
  const Experiment e = plan_experiment(parse_document(config.dump(), "data", DVRLAB_SOURCE), registry());
  return FieldCache().load(e.cases.front().resolved, registry());
}

std::unique_ptr<BackendSession> open_backend(const std::string& section) {
  const ResolvedCase c = resolve({"backend=" + section});
  return registry().get<BackendPlugin>("backend", c.backend.type).open(c.backend.parameters, c.backend.folder);
}

FrameCost measure_frame(BackendSession& session, const FrameJob& job) {
  FrameResult frame;
  const double cpu = process_seconds(), wall = wall_seconds();
  session.render(job, frame);
  return {1e3 * (wall_seconds() - wall), 1e3 * (process_seconds() - cpu), frame.counters};
}

std::string short_name(const std::string& voxel_type) {
  const std::size_t digits = voxel_type.find_first_of("0123456789");
  return voxel_type.substr(0, 1) + voxel_type.substr(digits);
}

double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double process_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

}  // namespace dvrlab::bench
