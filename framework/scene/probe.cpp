#include "framework/scene/probe.h"

#include <nlohmann/json.hpp>

namespace dvrlab {

std::vector<ProbeSegment> probe_ray(const Scene& scene, const Registry& registry, int x, int y) {
  const PluginEntryInfo& cpu = registry.find("backend", "cpu");
  nlohmann::json values = nlohmann::json::object();
  std::vector<Parameter> declared(cpu.descriptor->parameters,
                                  cpu.descriptor->parameters + cpu.descriptor->parameter_count);
  for (const Parameter& p : declared) values[p.name] = nlohmann::json::parse(p.default_value);
  // isa stays at its default: precision fp64 has modules of its own, and the others march the same bits.
  const auto session =
      registry.get<BackendPlugin>("backend", "cpu").open(ParameterSet("backend", declared, values), cpu.folder);
  return session->probe(scene.job, x, y);
}

}  // namespace dvrlab
