// Which array of a mesh file is the scalar field, and its numbers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/interfaces/mesh.h"
#include "framework/interfaces/parameter_set.h"
#include "framework/scene/voxels.h"

namespace dvrlab {

/// An array that a file offers.
struct MeshArray {
  std::string name;
  long long components = 1;
  bool cells = false;   // one entry per cell, not per point
  bool active = false;  // the file names it as the active scalars
};

/// The chosen one of them.
struct MeshChoice {
  std::size_t array = 0;
  long long component = 0;  // -1: the norm
};

/// By the keys `array` and `component` (mesh_keys.h). Without a name: the active one, else the only one of the points,
/// else the only one. A choice that was not the only one is said in `notes`. Throws InputError with the names that
/// there are; `name` is the file.
MeshChoice choose_mesh_array(const std::vector<MeshArray>& arrays, const ParameterSet& p, const std::string& name,
                             std::vector<std::string>& notes);

/// Appends points: x, y, z of each.
void add_points(MeshField& mesh, const std::vector<double>& places);
/// Values of cells, averaged to their points and noted.
void set_cell_values(MeshField& mesh, const std::vector<double>& values);

/// Numbers of a file in this machine's byte order. `count` of them.
std::vector<double> to_doubles(const SourceVoxels& source, std::uint64_t count);
/// Throws InputError, `where` in front, for numbers that are not whole or have no 64 bits.
std::vector<std::int64_t> to_integers(const SourceVoxels& source, std::uint64_t count, const std::string& where);

/// The component or the norm of entries of `components` numbers.
std::vector<double> scalars_of(const std::vector<double>& numbers, long long components, long long component);

/// Cells as VTK's files list them: of type types[c] (VTK's number), with the nodes connectivity[ends[c - 1] .. ends[c])
/// plus `offset`. Cells without a volume are left out and noted; `kept` gets the indices of the others. Throws
/// InputError, `where` in front, for a type that is not read and for counts that do not fit.
void add_vtk_cells(MeshField& mesh, const std::vector<std::int64_t>& types,
                   const std::vector<std::int64_t>& connectivity, const std::vector<std::int64_t>& ends,
                   std::uint64_t offset, std::vector<std::uint64_t>& kept, const std::string& where);

}  // namespace dvrlab
