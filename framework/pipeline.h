// The seven stages of dvrlab as seven calls:
//   config -> plugins -> scene -> backend -> image -> metrics -> report
// Start reading in pipeline.cpp.
#pragma once

#include <string>
#include <vector>

#include "framework/report/summary.h"

namespace dvrlab {

struct RunOptions {
  std::string config;                    // an experiment, or the case.json of an earlier one
  std::vector<std::string> set;          // "key.path=value", over the config
  std::vector<std::string> plugin_path;  // more plugin folders
  std::string out = "out";               // results go to <out>/<experiment>
};

/// Runs an experiment. All cases are resolved and checked before the first one runs; one that cannot run or fails
/// does not keep the others from it. Throws InputError when the config is wrong.
RunSummary run_experiment(const RunOptions& options);

}  // namespace dvrlab
