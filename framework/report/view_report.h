// Mean and worst over views, in the summary for people and for machines.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/report/case_record.h"

namespace dvrlab {

/// A table of the first value of every metric, at most `most` rows; "" where there are no views.
std::string view_text(const std::vector<CaseRecord>& records, std::size_t most);

/// A list of all rows of views.csv.
nlohmann::ordered_json view_json(const std::vector<CaseRecord>& records);

}  // namespace dvrlab
