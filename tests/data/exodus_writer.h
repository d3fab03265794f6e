// Exodus II files that tests write themselves, with netCDF.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/interfaces/mesh.h"

namespace dvrlab::test {

struct ExodusContents {
  struct Block {
    std::string type;       // "HEX20"
    int nodes = 0;          // of each cell
    std::vector<int> node;  // points from 1, in the order of Exodus
  };
  /// Per time step and variable: a number of each point, or of each cell, block after block.
  using Values = std::vector<std::vector<std::vector<double>>>;
  std::vector<Vector3> points;
  std::vector<Block> blocks;
  std::vector<std::string> of_points, of_cells;
  Values point_values, cell_values;
  std::vector<std::pair<int, int>> absent = {};  // (variable of the cells, block) without values, from 1
  int axes = 3;
};

enum class NetcdfKind { classic, offset64, data64, netcdf4 };

/// Numbers are of 8 bytes, or of 4 where `single`.
void write_exodus(const std::string& file, const ExodusContents& c, NetcdfKind kind = NetcdfKind::classic,
                  bool single = false);

}  // namespace dvrlab::test
