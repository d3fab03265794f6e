#include <cstdio>

#include "framework/app/data_input.h"
#include "framework/app/verbs.h"
#include "framework/config/experiment.h"
#include "framework/config/words.h"
#include "framework/interfaces/error.h"

namespace dvrlab {

int validate_verb(const Options& o) {
  const Registry registry(o.plugin_path);
  try {
    refuse_data(o.config, o.set, registry);
    const Experiment experiment = plan_experiment(load_document(o.config, o.set), registry);
    std::size_t references = 0;
    nlohmann::json ids = nlohmann::json::array();
    for (const PlannedCase& c : experiment.cases) {
      references += c.reference_name.empty() ? 0 : 1;
      ids.push_back(c.id);
    }
    if (o.json) std::printf("%s\n", nlohmann::json({{"valid", true}, {"cases", ids}}).dump(1).c_str());
    std::fprintf(stderr, "config: '%s' is valid: %zu cases and %zu references\n", experiment.name.c_str(),
                 experiment.cases.size() - references, references);
    return 0;
  } catch (const InputError& e) {
    if (o.json)
      std::printf("%s\n", nlohmann::json({{"valid", false}, {"errors", split_words(e.what(), '\n')}}).dump(1).c_str());
    throw;
  }
}

}  // namespace dvrlab
