#include <algorithm>

#include "framework/config/experiment.h"
#include "framework/config/views.h"
#include "framework/config/words.h"

namespace dvrlab {

void check_expectations(const Experiment& experiment, const ConfigTree& tree, Problems& problems) {
  for (std::size_t i = 0; i < experiment.expectations.size(); ++i) {
    const Expectation& e = experiment.expectations[i];
    const std::string where = tree.where(child_path("expect", i)) + ": ";
    std::vector<std::string> metrics, against;
    bool applied = false, ordered = false, viewed = false, varied = false;
    for (std::size_t k = 0; k < experiment.cases.size(); ++k) {
      const PlannedCase& c = experiment.cases[k];
      if (!c.reference_name.empty() || !applies(e, c.resolved.config)) continue;
      if (metrics.empty()) {
        for (const Section& m : c.resolved.metrics) metrics.push_back(m.type);
        for (const auto& [name, index] : c.references) against.push_back(name);
      }
      applied = true;
      varied = varied || c.first_variant != k;
      viewed = viewed || std::any_of(c.choices.begin(), c.choices.end(),
                                     [](const AxisChoice& choice) { return choice.key == view_key; });
      const nlohmann::json* by = e.order_by.empty() ? nullptr : value_at(c.resolved.config, e.order_by);
      ordered = ordered || (by != nullptr && by->is_number());
    }
    const auto name_in = [&](const char* what, const std::string& name, const std::vector<std::string>& legal) {
      if (std::find(legal.begin(), legal.end(), name) != legal.end()) return;
      problems.add(where + "there is no " + what + " '" + name + "'" + did_you_mean(name, legal) +
                   (legal.empty() ? "; there is none" : "; there are: " + join_words(legal)));
    };
    if (!applied) {
      problems.add(where + "no case is meant: none has all the values of `where`");
      continue;
    }
    if (varied) against.emplace_back("variant");
    name_in("metric", e.metric.substr(0, e.metric.find('.')), metrics);
    name_in("reference", e.against, against);
    if (e.over == Expectation::Over::views && !viewed)
      problems.add(where + "there are no views: the camera of no case that is meant is an orbit whose view is null");
    if (e.over == Expectation::Over::views && e.order_by == view_key)
      problems.add(where + "one value of all views cannot be put in order by camera.view; set `over` to \"cases\"");
    if (!e.order_by.empty() && !ordered)
      problems.add(where + "the order's key '" + e.order_by + "' is no number in any case that is meant");
  }
}

}  // namespace dvrlab
