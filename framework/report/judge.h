// Holds an experiment's records to its expectations.
#pragma once

#include <vector>

#include "framework/config/experiment.h"
#include "framework/report/case_record.h"

namespace dvrlab {

/// Adds the result of every expectation to the records that it means and lowers their verdicts. A record that does
/// not have the number is "not supported" there, with the reason.
void judge_expectations(const Experiment& experiment, std::vector<CaseRecord>& records);

}  // namespace dvrlab
