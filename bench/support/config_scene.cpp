#include "bench/support/config_scene.h"

#include "bench/support/march_scene.h"
#include "framework/config/experiment.h"
#include "framework/interfaces/error.h"

namespace dvrlab::bench {
namespace {

ResolvedCase case_of(const std::string& file, const std::string& panel, const std::vector<std::string>& set) {
  const Experiment e = plan_experiment(load_document(std::string(DVRLAB_SOURCE "/") + file, set), registry());
  for (const PlannedCase& c : e.cases)
    if (c.reference_name.empty() && (panel.empty() || c.resolved.top.text("panel") == panel)) return c.resolved;
  throw InputError(file + ": has no panel '" + panel + "'");
}

}  // namespace

Scene config_scene(const std::string& file, const std::string& panel, const std::vector<std::string>& set) {
  static FieldCache fields;
  const ResolvedCase c = case_of(file, panel, set);
  try {
    return build_scene(c, registry(), fields.load(c, registry()));
  } catch (const InputError& e) {
    if (c.data.parameters.boolean("optional")) throw NotSupported(e.what());
    throw;
  }
}

nlohmann::json config_sections(const std::string& file, const std::vector<std::string>& set) {
  return case_of(file, "", set).config;
}

}  // namespace dvrlab::bench
