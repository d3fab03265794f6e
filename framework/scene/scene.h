// The scene stage: a resolved case becomes a FrameJob (kernels, uniforms, buffers), with everything said aloud.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/resolved_case.h"
#include "framework/interfaces/backend.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/medium.h"
#include "framework/plugin/registry.h"
#include "framework/scene/memory_bill.h"

namespace dvrlab {

struct Scene {
  std::shared_ptr<const Field> field;
  Medium medium;  // in stored units
  FrameJob job;
  double step = 0;               // world units
  int rays_per_side = 1;         // rays per pixel along x and along y: the job's image is so much larger
  std::vector<PhaseTime> times;  // of the build: medium, frame tables, estimator tables
  std::vector<std::pair<std::string, double>> blocks;  // BlockedField::statistics, where the field lies in such
  std::vector<std::string> notes;                      // conversions, caps: what the log and the result file say
};

/// Where the case's data plugin finds files.
LoadContext load_context(const ResolvedCase& c);

/// Throws NotSupported where optional data is not there.
void require_data(const ResolvedCase& c);

/// Loads the case's data (through a cache by resolved data section, so that an experiment loads each file once).
class FieldCache {
 public:
  /// Throws NotSupported for optional data that is missing.
  std::shared_ptr<const Field> load(const ResolvedCase& c, const Registry& registry);
  /// What load() would load for this case, for who has it already.
  void keep(const ResolvedCase& c, std::shared_ptr<const Field> field);

 private:
  std::vector<std::pair<std::string, std::shared_ptr<const Field>>> entries_;
};

Precision precision_of(const ResolvedCase& c);

/// States what build_scene will allocate beside the field: the parts of the framework, sampler, estimator and passes.
void state_scene_bytes(const ResolvedCase& c, const Registry& registry, const Field& field, MemoryBill& memory);

/// Throws InputError (impossible combination) or NotSupported (memory).
Scene build_scene(const ResolvedCase& c, const Registry& registry, std::shared_ptr<const Field> field);

}  // namespace dvrlab
