// From one choice of axis values to the config of a case, and of a reference.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/axes.h"
#include "framework/config/config_tree.h"
#include "framework/config/problems.h"

namespace dvrlab {

struct Choice {
  std::vector<std::size_t> value;   // index of a value for every axis
  std::optional<std::size_t> view;  // of the orbit, where it is no axis of the config
};

class CaseTrees {
 public:
  /// `document` and `axes` must outlive it.
  CaseTrees(const ConfigTree& document, const std::vector<Axis>& axes);

  /// The config without the experiment's own sections.
  const ConfigTree& base() const { return base_; }
  ConfigTree of_case(const Choice& choice, Problems& problems) const;
  /// The case with `termination` 0 and then the reference's patch over it.
  ConfigTree of_reference(const Choice& choice, const std::string& name, Problems& problems) const;
  /// The key paths that the patch of a reference sets: a section that names its type is set as a whole.
  std::vector<std::string> decided_by_reference(const std::string& name) const;

 private:
  const ConfigTree& document_;
  const std::vector<Axis>& axes_;
  ConfigTree base_;
};

/// The names and patches of `reference`: adds what is wrong with them.
void check_references(const ConfigTree& document, Problems& problems);

}  // namespace dvrlab
