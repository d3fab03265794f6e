#include "framework/app/single_case.h"

#include "framework/interfaces/error.h"

namespace dvrlab {

PlannedCase single_case(const Options& o, const Registry& registry) {
  Experiment experiment = plan_experiment(load_document(o.config, o.set), registry);
  PlannedCase* only = nullptr;
  std::size_t count = 0;
  for (PlannedCase& c : experiment.cases) {
    if (!c.reference_name.empty()) continue;
    only = &c;
    ++count;
  }
  if (count != 1) {
    throw InputError(o.config + ": the config asks for " + std::to_string(count) +
                     " cases, this verb takes one (use `dvrlab run`, or fix the axes: --set 'axes={}')");
  }
  return std::move(*only);
}

}  // namespace dvrlab
