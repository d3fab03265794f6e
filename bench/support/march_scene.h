// The march benchmarks' scene (configs/march_table.json) through the public pipeline, and what a frame of it costs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/interfaces/backend.h"
#include "framework/plugin/registry.h"
#include "framework/scene/scene.h"

namespace dvrlab::bench {

const Registry& registry();

struct Variation {
  std::string voxel_type = "float32";  // of data.voxel_type
  bool skipping = false;
};

/// The scene with a variation and further overrides ("key.path=value"). Scenes of equal data share the field.
Scene march_scene(const Variation& variation, const std::vector<std::string>& set = {});

/// Loads a data section (JSON text) anew, past every cache.
std::shared_ptr<const Field> load_data(const std::string& section);

/// A backend section such as {"type":"cpu","isa":"avx2","threads":1}, as JSON text. Throws NotSupported.
std::unique_ptr<BackendSession> open_backend(const std::string& section);

struct FrameCost {
  double wall_ms = 0;
  double cpu_ms = 0;  // user and system time of all threads of the process: a software GPU's too
  FrameCounters counters;
};

/// One call of the session, everything in it counted.
FrameCost measure_frame(BackendSession& session, const FrameJob& job);

/// "f32" for "float32", "u8" for "uint8", ...
std::string short_name(const std::string& voxel_type);

double least(const std::vector<double>& values);
double median(std::vector<double> values);

double wall_seconds();  // of a steady clock

/// User and system time of the process and of all its threads.
double process_seconds();

}  // namespace dvrlab::bench
