#include "framework/report/view_report.h"

#include "framework/report/text_table.h"
#include "framework/report/view_statistics.h"

namespace dvrlab {
namespace {

std::string name_of(const ViewRow& row) {
  std::string text;
  for (const AxisChoice& c : row.choices) text += (text.empty() ? "" : ",") + c.key + "=" + c.label;
  return text.empty() ? "case" : text;
}

}  // namespace

std::string view_text(const std::vector<CaseRecord>& records, std::size_t most) {
  std::vector<std::vector<std::string>> table = {{"over views of", "metric", "mean", "worst", "in view", "views"}};
  std::size_t rows = 0;
  for (const ViewRow& row : view_rows(records)) {
    if (!row.headline || ++rows > most) continue;
    table.push_back(
        {name_of(row), row.metric + " against " + row.against, short_number(row.statistic.mean),
         short_number(row.statistic.worst), row.worst_view,
         std::to_string(row.views) + (row.views < row.planned ? " of " + std::to_string(row.planned) : std::string())});
  }
  if (rows == 0) return "";
  return text_table(table) + (rows > most ? "(" + std::to_string(rows - most) + " more rows: see views.csv)\n" : "");
}

nlohmann::ordered_json view_json(const std::vector<CaseRecord>& records) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ViewRow& row : view_rows(records)) {
    nlohmann::ordered_json choices = nlohmann::ordered_json::object();
    for (const AxisChoice& c : row.choices) choices[c.key] = c.label;
    list.push_back({{"choices", choices},
                    {"against", row.against},
                    {"metric", row.metric},
                    {"mean", json_number(row.statistic.mean)},
                    {"worst", json_number(row.statistic.worst)},
                    {"worst_view", row.worst_view},
                    {"views", row.views},
                    {"planned", row.planned},
                    {"perfect", row.statistic.perfect}});
  }
  return list;
}

}  // namespace dvrlab
