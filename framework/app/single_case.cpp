#include "framework/app/single_case.h"

#include "framework/config/views.h"
#include "framework/interfaces/error.h"

namespace dvrlab {

namespace {

/// What leaves one case of these: a view of the orbit, no axes, or both.
std::string how_to_have_one(const Experiment& experiment) {
  bool views = false, axes = false;
  for (const PlannedCase& c : experiment.cases) {
    for (const AxisChoice& choice : c.choices) (choice.key == view_key ? views : axes) = true;
  }
  if (!views) return "fix the axes: --set 'axes={}'";
  return std::string("choose a view of the orbit: --set camera.view=0") +
         (axes ? ", without axes: --set 'axes={}'" : "");
}

}  // namespace

PlannedCase single_case(const Options& o, const Registry& registry) {
  ConfigDocument document = load_document(o.config, o.set);
  document.tree.root.erase("expect");  // of the whole experiment: one case may be too few for them
  Experiment experiment = plan_experiment(document, registry);
  PlannedCase* only = nullptr;
  std::size_t count = 0;
  for (PlannedCase& c : experiment.cases) {
    if (!c.reference_name.empty()) continue;
    only = &c;
    ++count;
  }
  if (count != 1) {
    throw InputError(o.config + ": the config asks for " + std::to_string(count) +
                     " cases, this verb takes one (use `dvrlab run`, or " + how_to_have_one(experiment) + ")");
  }
  return std::move(*only);
}

}  // namespace dvrlab
