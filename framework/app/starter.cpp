#include "framework/app/starter.h"

#include "framework/app/starter_kinds.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

[[noreturn]] void refuse(const Field& field) {
  throw InputError(field.source +
                   ": a starter config is made from voxels or from the points of a mesh, and this data has neither");
}

}  // namespace

std::string starter_words(const LoadedData& data) {
  const Field& field = *data.field;
  const auto* grid = dynamic_cast<const GridField*>(&field);
  const auto* mesh = dynamic_cast<const MeshField*>(&field);
  if (grid == nullptr && mesh == nullptr) refuse(field);
  return (grid != nullptr ? grid_starter_words(*grid) : mesh_starter_words(*mesh)) +
         "; seen from the left front, above" + (field.anatomical ? "" : ", with the file's z axis up");
}

std::string starter_config(const LoadedData& data, const std::string& folder) {
  if (const auto* grid = dynamic_cast<const GridField*>(data.field.get()))
    return grid_starter_config(data, *grid, folder);
  if (const auto* mesh = dynamic_cast<const MeshField*>(data.field.get()))
    return mesh_starter_config(data, *mesh, folder);
  refuse(*data.field);
}

}  // namespace dvrlab
