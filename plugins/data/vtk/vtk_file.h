// The sections of a legacy VTK file with an unstructured grid.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "framework/scene/voxels.h"

namespace dvrlab::vtk {

/// Numbers somewhere in the file.
struct Numbers {
  SourceType type = SourceType::f32;
  std::uint64_t count = 0, at = 0;  // at: first byte
  std::string where;                // "file: POINTS"
};

struct DataArray {
  std::string name;
  long long components = 1;
  bool cells = false, active = false;
  Numbers numbers;
};

struct VtkFile {
  bool binary = false;
  std::uint64_t points = 0, cells = 0;
  Numbers places, types;
  /// Before version 5.1 one list: how many nodes, then these, for every cell. Else connectivity and its `offsets`, from
  /// 0.
  bool counted = true;
  Numbers connectivity, offsets;
  std::vector<DataArray> arrays;
};

/// Throws InputError for a bad file. `name` is the file, for messages.
VtkFile read_sections(std::span<const std::byte> file, const std::string& name);

/// Numbers of the file as 64-bit ones. Throws InputError for text that is none.
std::vector<double> doubles_of(const VtkFile& f, std::span<const std::byte> file, const Numbers& n);
std::vector<std::int64_t> integers_of(const VtkFile& f, std::span<const std::byte> file, const Numbers& n);

}  // namespace dvrlab::vtk
