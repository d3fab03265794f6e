#include "framework/scene/check_case.h"

#include <cstdio>

#include "framework/config/sections.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/estimator.h"
#include "framework/scene/camera.h"
#include "framework/scene/case_medium.h"
#include "framework/scene/cells.h"
#include "framework/scene/lighting.h"
#include "framework/scene/scene.h"
#include "framework/scene/system_memory.h"

namespace dvrlab {
namespace {

/// A table that no run of this case could hold: said before any data is read.
void check_tables(const ResolvedCase& c, const EstimatorPlugin& estimator, const TableLayout& layout) {
  const auto bytes = static_cast<double>(estimator.bytes_needed(c.estimator.parameters, layout));
  const bool given = !c.limits.is_null("memory");
  const double limit =
      given ? c.limits.json("memory").get<double>() : 0.75 * static_cast<double>(system_memory().available);
  if (bytes <= limit) return;
  char text[160];
  std::snprintf(text, sizeof text, "its tables and their making take %.1f MiB; %s %.1f MiB. Take a smaller table_size",
                bytes / 1048576, given ? "limits.memory allows" : "75 % of what is available is", limit / 1048576);
  throw InputError("estimator: " + c.estimator.type + ": " + text);
}

/// The light of the case's passes alone; none where they are wrong, which is said elsewhere.
LocalShading light_of(const ResolvedCase& c, const Registry& registry) {
  try {
    return local_shading(c, registry, FormulaField(), false);
  } catch (const InputError&) {
    return {};
  }
}

/// One pass of each kind: another would replace it.
void check_passes(const ResolvedCase& c, const Registry& registry, Problems& problems) {
  const Section* shading = nullptr;
  const Section* volume = nullptr;
  for (std::size_t i = 0; i < c.illumination.size(); ++i) {
    const Section& s = c.illumination[i];
    const bool fills = registry.get<IlluminationPlugin>("illumination", s.type).fills_light_volume();
    const Section*& first = fills ? volume : shading;
    if (first != nullptr)
      problems.add("illumination[" + std::to_string(i) + "]: a second " +
                   (fills ? "pass of light volumes" : "local shading pass") + " would replace the first (" +
                   first->type + "); give one");
    first = &s;
  }
  if (c.lights.size() > most_shading_lights && (shading != nullptr || volume == nullptr))
    problems.add("lights: found " + std::to_string(c.lights.size()) + " lights; at most " +
                 std::to_string(most_shading_lights) + " are possible but for a pass of light volumes alone");
}

}  // namespace

void check_case(const ResolvedCase& c, const Registry& registry, Problems& problems) {
  const auto part = [&](auto check) {
    try {
      check();
    } catch (const InputError& e) {
      problems.add(e.what());
    } catch (const NotSupported&) {  // a plugin that cannot be made: the verdict of the case when it runs
    }
  };
  // Cameras, planes and lights that point nowhere do so in every box.
  FormulaField box;
  box.lo = {-1, -1, -1};
  part([&] {
    std::vector<std::string> notes;
    const Medium medium = model_medium(c, registry, 1.0, 0.0, 1.0, notes);
    const auto& estimator = registry.get<EstimatorPlugin>("estimator", c.estimator.type, "estimator.type");
    refuse_impossible(c, medium, estimator.declaration(c.estimator.parameters));
    check_tables(c, estimator,
                 table_layout(c, medium,
                              table_options(c, box, medium, light_of(c, registry),
                                            estimator.declaration(c.estimator.parameters))));
  });
  part([&] {
    const std::string refusal = registry.get<BackendPlugin>("backend", c.backend.type, "backend.type")
                                    .refuses(precision_of(c), c.backend.parameters);
    if (!refusal.empty()) throw InputError("precision: backend \"" + c.backend.type + "\" " + refusal);
  });
  part([&] { check_cells(c); });
  check_passes(c, registry, problems);
  KernelUnit unused;
  part([&] { add_camera(c.camera, box, 2, 2, unused); });
  for (const Section& plane : c.clip) part([&] { add_clipping({plane}, box, unused); });
  ResolvedCase alone;  // a light, then the passes
  alone.camera = c.camera;
  for (const Section& light : c.lights) {
    alone.lights = {light};
    part([&] { local_shading(alone, registry, box, false); });
  }
  alone.lights.clear();
  alone.illumination = c.illumination;
  part([&] { local_shading(alone, registry, box, false); });
}

}  // namespace dvrlab
