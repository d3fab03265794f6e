#include <cstdio>

#include "framework/app/data_input.h"
#include "framework/app/verbs.h"
#include "framework/pipeline.h"

namespace dvrlab {

int run_verb(const Options& o) {
  refuse_data(o.config, o.set, Registry(o.plugin_path));
  std::vector<std::string> set = o.set;
  if (o.repeat > 0) set.push_back("repeat=" + std::to_string(o.repeat));
  const RunSummary summary = run_experiment({o.config, set, o.plugin_path, o.out});
  if (o.json) std::printf("%s\n", summary_json(summary).dump(1).c_str());
  std::fputs(summary_text(summary).c_str(), stderr);
  return exit_code(summary);
}

}  // namespace dvrlab
