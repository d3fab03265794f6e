// The axes of an experiment: which keys are varied, over which values.
#pragma once

#include <string>
#include <vector>

#include "framework/config/config_tree.h"
#include "framework/config/problems.h"

namespace dvrlab {

/// That a range may have.
inline constexpr int most_axis_values = 10000;

struct AxisValue {
  ConfigJson value;
  std::string label;  // readable, safe in file names; other values of the key have other labels: "preintegrated", "0.5"
  std::string source;  // where the value is written: "axes.permutation.estimator[2]"
};

/// A key path that is varied, and its values.
struct AxisKey {
  std::string key;
  std::vector<AxisValue> values;
};

/// One factor of the product. The keys of a zip are one axis: their first values belong together, and so on.
struct Axis {
  bool variant = false;       // all values must give the same bits
  std::vector<AxisKey> keys;  // of equal length
  std::size_t count() const { return keys.front().values.size(); }
};

/// Permutation axes in the order in which they are written, then variant axes. A key's values are a list or a range
/// (axis_values); "zip" holds a list of sections of key path -> values, one axis each. Keys whose values cannot be read
/// are left out; they are added to `unread`, what is wrong with them to `problems`.
std::vector<Axis> read_axes(const ConfigTree& tree, std::vector<std::string>& unread, Problems& problems);

/// The values of a key that is written at `path`: a list gives its values; {"lin": [first, last, count]} equal
/// distances; {"log2": [first, last]} and {"log10": [first, last]} factors of 2 and 10. Empty after a problem.
std::vector<AxisValue> axis_values(const ConfigTree& tree, const std::string& path, const ConfigJson& written,
                                   Problems& problems);

/// Letters that are safe in a file name on every system; anything else becomes '_'.
std::string file_safe(const std::string& text);

}  // namespace dvrlab
