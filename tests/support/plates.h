// A thin plate and what it shades, with nothing but empty blocks between.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/interfaces/blocks.h"
#include "tests/support/render.h"

namespace dvrlab::test {

/// 64 x 32 x 32 voxels: faint matter at x < 8, a plate from x = 33 to 35; light from the right.
inline nlohmann::json plates() {
  static const std::string file = [] {
    const auto path = std::filesystem::temp_directory_path() / ("dvrlab_plates_" + std::to_string(::getpid()) + ".raw");
    std::ofstream out(path, std::ios::binary);
    for (int i = 0; i < 64 * 32 * 32; ++i) {
      const int x = i % 64;
      out.put(static_cast<char>(x < 8 ? 60 : x >= 33 && x <= 35 ? 200 : 0));
    }
    return path.string();
  }();
  return {{"data", {{"type", "raw"}, {"file", file}, {"size", {64, 32, 32}}, {"voxel_type", "uint8"}}},
          {"optical_model",
           {{"type", "absorption_emission"},
            {"length_unit", "voxel"},
            {"opacity", {{0, 0}, {50, 0}, {60, 0.02}, {150, 0.02}, {200, 0.4}}}}},
          {"estimator", {{"type", "direct"}}},
          {"lights", {{{"type", "directional"}, {"direction", {1, 0, 0}}}}},
          {"illumination",
           {{{"type", "local_piecewise"}, {"components", "direct"}, {"segment", 8}, {"shadow_ratio", {1, 1, 1}}}}},
          {"camera", {{"type", "perspective"}, {"position", {1.2, -2.0, 0.9}}, {"up", {0, 0, 1}}}},
          {"sampling", {{"type", "uniform"}, {"step", 0.61}, {"termination", 0}}},
          {"image", {{"size", {40, 36}}}}};
}

/// Of plates(): the light at x = 2 in the middle of the cross section; with blocks that block is at full resolution.
inline double light_behind_the_plate(const LightVolume& light, const BlockedField* blocks) {
  if (blocks == nullptr) return double((*light.values)[(15 * 32 + 15) * 64 + 2]);
  const std::size_t n = std::size_t(blocks->count(0));
  return double((*light.values)[std::size_t(blocks->first(0)) + (15 * n + 15) * n + 2]);
}

}  // namespace dvrlab::test
