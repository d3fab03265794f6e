// The scene and backend stages of one case, with what is kept from one case to the next.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "framework/interfaces/backend.h"
#include "framework/plugin/registry.h"
#include "framework/report/case_record.h"
#include "framework/scene/memory_bill.h"
#include "framework/scene/scene.h"

namespace dvrlab {

/// Loads data once, builds a scene once for cases that differ only in their backend, and keeps backends open.
class CaseRenderer {
 public:
  explicit CaseRenderer(const Registry& registry);

  /// For who has loaded the case's data already.
  void keep(const ResolvedCase& c, std::shared_ptr<const Field> field) { fields_.keep(c, std::move(field)); }

  /// Scene stage. Throws NotSupported for optional data that is missing; else what build_scene throws.
  const Scene& scene(const ResolvedCase& c, CaseRecord& record);

  /// Backend stage: warm-up and repeats; fills device, counters and times. The image is that of the last repeat.
  /// Throws NotSupported when the device, its library or the memory is missing.
  FrameImage render(const ResolvedCase& c, const Scene& scene, CaseRecord& record);

 private:
  BackendSession& session(const ResolvedCase& c, Precision precision);
  /// Logs what was not said before: cases share their notes.
  void say(const std::string& note);
  /// With the limit of the case, nothing stated yet.
  MemoryBill bill(const ResolvedCase& c) const;

  const Registry& registry_;
  std::uint64_t memory_at_start_;  // bytes that were available
  FieldCache fields_;
  std::string scene_key_;
  std::unique_ptr<Scene> scene_;
  nlohmann::json scene_record_;
  std::set<std::string> said_;
  std::map<std::string, std::unique_ptr<BackendSession>> sessions_;  // by the resolved backend section
};

}  // namespace dvrlab
