// What `dvrlab info` says of data.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "framework/app/data_input.h"
#include "framework/scene/histogram.h"
#include "framework/scene/mesh/mesh_summary.h"

namespace dvrlab {

struct InfoReport {
  LoadedData data;
  const GridField* grid = nullptr;     // nullptr for a formula or a mesh
  const MeshField* mesh = nullptr;     // nullptr for others
  std::optional<Histogram> histogram;  // of a grid
  std::optional<MeshSummary> summary;  // of a mesh
};

InfoReport make_info(LoadedData data);

/// `bins`: at most so many bars.
std::string info_text(const InfoReport& info, int bins);
nlohmann::ordered_json info_json(const InfoReport& info, int bins);

}  // namespace dvrlab
