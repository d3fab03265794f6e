// The axes of an experiment: which keys are varied, over which values.
#pragma once

#include <string>
#include <vector>

#include "framework/config/config_tree.h"
#include "framework/config/problems.h"

namespace dvrlab {

struct AxisValue {
  ConfigJson value;
  std::string label;   // readable, safe in file names, unique in its axis: "preintegrated", "0.5"
  std::string source;  // where the value is written: "axes.permutation.estimator[2]"
};

struct Axis {
  std::string key;       // the key path that it varies
  bool variant = false;  // all values must give the same bits
  std::vector<AxisValue> values;
};

/// Permutation axes in the order in which they are written, then variant axes. A list gives its values;
/// {"lin": [first, last, count]} equal distances; {"log2": [first, last]} and {"log10": [first, last]} factors of
/// 2 and 10.
std::vector<Axis> read_axes(const ConfigTree& tree, Problems& problems);

/// Letters that are safe in a file name on every system; anything else becomes '_'.
std::string file_safe(const std::string& text);

}  // namespace dvrlab
