#include <algorithm>

#include "framework/config/experiment.h"
#include "framework/config/words.h"

namespace dvrlab {

void check_expectations(const Experiment& experiment, const ConfigTree& tree, Problems& problems) {
  for (std::size_t i = 0; i < experiment.expectations.size(); ++i) {
    const Expectation& e = experiment.expectations[i];
    const std::string where = tree.where(child_path("expect", i)) + ": ";
    std::vector<std::string> metrics, against = {"variant"};
    bool applied = false, ordered = false;
    for (const PlannedCase& c : experiment.cases) {
      if (!c.reference_name.empty() || !applies(e, c.resolved.config)) continue;
      if (metrics.empty()) {
        for (const Section& m : c.resolved.metrics) metrics.push_back(m.type);
        for (const auto& [name, index] : c.references) against.push_back(name);
      }
      applied = true;
      const nlohmann::json* by = e.order_by.empty() ? nullptr : value_at(c.resolved.config, e.order_by);
      ordered = ordered || (by != nullptr && by->is_number());
    }
    const auto name_in = [&](const char* what, const std::string& name, const std::vector<std::string>& legal) {
      if (std::find(legal.begin(), legal.end(), name) != legal.end()) return;
      problems.add(where + "there is no " + what + " '" + name + "'" + did_you_mean(name, legal) +
                   "; there are: " + join_words(legal));
    };
    if (!applied) {
      problems.add(where + "no case is meant: none has all the values of `where`");
      continue;
    }
    name_in("metric", e.metric.substr(0, e.metric.find('.')), metrics);
    name_in("reference", e.against, against);
    if (!e.order_by.empty() && !ordered)
      problems.add(where + "the order's key '" + e.order_by + "' is no number in any case that is meant");
  }
}

}  // namespace dvrlab
