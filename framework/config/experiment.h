// An experiment: all cases that a config asks for, resolved and checked before the first one runs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/config/document.h"
#include "framework/config/expectation.h"
#include "framework/config/resolved_case.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

/// The value of a key that an axis varies.
struct AxisChoice {
  std::string key, label;
  std::size_t axis = 0;  // keys with the same number vary together
};

struct PlannedCase {
  std::string id;                   // readable, unique, the name of its folder
  std::string reference_name;       // "" for an ordinary case
  std::vector<AxisChoice> choices;  // its value of every key of every axis, in running order
  ResolvedCase resolved;
  std::size_t first_variant = 0;  // index of the case that it must equal bit for bit; its own for the first
  std::vector<std::pair<std::string, std::size_t>> references;  // name -> index of the case
};

/// `cases` is the running order: a reference comes before the first case that is measured against it.
struct Experiment {
  std::string name;
  std::vector<PlannedCase> cases;
  std::vector<Expectation> expectations;
};

/// The full product of the axes, permutations outermost, and the references that it needs. An orbit camera whose view
/// is null adds the permutation axis camera.view. A reference is the case's
/// permutation with the first value of every variant axis, `termination` 0 and then its patch. Throws InputError
/// with everything that is wrong with any case, one line each.
Experiment plan_experiment(const ConfigDocument& document, const Registry& registry);

/// Part of plan_experiment: an expectation that no case can meet or miss is a mistake, for it would silently pass.
/// `sound`: nothing is wrong with the cases; else only names are judged, as far as they are known.
void check_expectations(const Experiment& experiment, const ConfigTree& tree, bool sound, Problems& problems);

}  // namespace dvrlab
