// The table at the end of a run, for people and for machines.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/report/case_record.h"

namespace dvrlab {

struct RunSummary {
  std::string folder;  // of the results
  std::vector<CaseRecord> records;
  bool stopped = false;  // by Ctrl-C
  std::size_t planned = 0;
  std::shared_ptr<const Experiment> experiment;  // the records point into it
};

/// 0 all good; 1 an expectation or a comparison failed; 3 a case ended with an error, no case could run, an expectation
/// of a case that ran has no value, nothing at all could be compared with a variant or with a reference although
/// the experiment has them, or the run was stopped. "Not supported" beside what was compared is a counted verdict, not
/// a failure.
int exit_code(const RunSummary& summary);

/// One row per case, of more than 100 only those that did not pass (case, backend, median of the march, verdict,
/// largest difference to the first variant), mean and worst over views, the worst difference, the expectations and
/// the count of every verdict.
std::string summary_text(const RunSummary& summary);
nlohmann::ordered_json summary_json(const RunSummary& summary);

}  // namespace dvrlab
