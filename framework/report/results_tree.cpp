#include "framework/report/results_tree.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "framework/config/axes.h"
#include "framework/image/atomic_file.h"
#include "framework/image/image_io.h"
#include "framework/report/pretty_json.h"
#include "framework/report/view_statistics.h"

namespace dvrlab {
namespace fs = std::filesystem;
namespace {

void make_folder(const std::string& folder) {
  std::error_code ec;
  fs::create_directories(folder, ec);
  if (ec)
    throw std::runtime_error("cannot make the folder '" + folder + "': " + ec.message() +
                             " (choose another one with --out)");
}

/// Columns in the order of their first appearance; a row may lack any.
class Table {
 public:
  void begin_row() { rows_.emplace_back(columns_.size()); }
  void set(const std::string& column, const std::string& value) {
    std::size_t at = static_cast<std::size_t>(std::find(columns_.begin(), columns_.end(), column) - columns_.begin());
    if (at == columns_.size()) columns_.push_back(column);
    rows_.back().resize(columns_.size());
    rows_.back()[at] = value;
  }
  bool empty() const { return rows_.empty(); }
  std::string csv() const {
    std::string text;
    line(text, columns_);
    for (const auto& row : rows_) line(text, row);
    return text;
  }

 private:
  void line(std::string& text, const std::vector<std::string>& cells) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (i > 0) text += ',';
      if (i < cells.size()) text += quoted(cells[i]);
    }
    text += '\n';
  }
  static std::string quoted(const std::string& cell) {
    if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
    std::string text = "\"";
    for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
  }
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string text_of(double x) {
  const nlohmann::json n = json_number(x);
  return n.is_string() ? n.get<std::string>() : n.dump();
}

/// `folder` relative to `from` where both lie in one folder other than "/"; else as it is.
std::string movable(const std::string& folder, const std::string& from) {
  const fs::path there = fs::weakly_canonical(folder), here = fs::weakly_canonical(from);
  const bool together = std::next(there.begin()) != there.end() && std::next(here.begin()) != here.end() &&
                        *std::next(there.begin()) == *std::next(here.begin());
  return together ? there.lexically_relative(here).string() : there.string();
}

}  // namespace

ResultsTree::ResultsTree(const std::string& out, const std::string& experiment)
    : folder_(out + "/" + file_safe(experiment)) {
  make_folder(folder_ + "/cases");
}

void ResultsTree::write_images(const CaseRecord& r, const FrameImage& image) const {
  const std::string folder = case_folder(r.plan->id);
  make_folder(folder);
  const nlohmann::json header = {{"dvrlab:case", r.plan->id}, {"dvrlab:device", r.device.device}};
  write_exr(folder + "/image.exr", image, header);
  write_png(folder + "/image.png", image, r.plan->resolved.image.text("space") == "linear");
}

void ResultsTree::write_case(const CaseRecord& r) const {
  make_folder(case_folder(r.plan->id));
  std::error_code none;
  for (const char* image : {"/image.exr", "/image.png"})
    if (!r.ran) fs::remove(case_folder(r.plan->id) + image, none);  // of an earlier run
  nlohmann::ordered_json record = case_json(r);
  record["config"]["base_folder"] = movable(r.plan->resolved.base_folder, case_folder(r.plan->id));
  write_text_atomically(case_folder(r.plan->id) + "/case.json", pretty_json(record) + "\n");
}

void ResultsTree::write_table(const std::vector<CaseRecord>& records) const {
  Table table;
  for (const CaseRecord& r : records) {
    table.begin_row();
    table.set("id", r.plan->id);
    table.set("role", r.plan->reference_name.empty() ? "case" : "reference");
    for (const AxisChoice& c : r.plan->choices) table.set(c.key, c.label);
    table.set("backend.type", r.plan->resolved.backend.type);
    table.set("device", r.device.device);
    table.set("verdict", verdict_text(r.verdict));
    table.set("reason", one_line(r.reason));
    if (!r.ran) continue;
    table.set("samples", std::to_string(r.counters.samples));
    table.set("table_fetches", std::to_string(r.counters.table_fetches));
    table.set("skipped", std::to_string(r.counters.skipped));
    table.set("terminated", std::to_string(r.counters.terminated));
    for (const PhaseStatistics& t : r.times) {
      table.set(t.phase + "_s", text_of(t.median));
      table.set(t.phase + "_iqr_s", text_of(t.interquartile_range));
    }
    if (r.variant) table.set("variant_max_abs", text_of(r.variant->max_abs));
    for (const Measure& m : r.measures) {
      for (const auto& [name, value] : m.values) table.set(name + " against " + m.against, text_of(value));
    }
  }
  write_text_atomically(folder_ + "/results.csv", table.csv());
}

void ResultsTree::write_views(const std::vector<CaseRecord>& records) const {
  Table table;
  for (const ViewRow& row : view_rows(records)) {
    table.begin_row();
    for (const AxisChoice& c : row.choices) table.set(c.key, c.label);
    table.set("against", row.against);
    table.set("metric", row.metric);
    table.set("mean", text_of(row.statistic.mean));
    table.set("worst", text_of(row.statistic.worst));
    table.set("worst_view", row.worst_view);
    table.set("views", std::to_string(row.views));
    table.set("planned", std::to_string(row.planned));
    table.set("perfect", std::to_string(row.statistic.perfect));
  }
  std::error_code none;
  if (table.empty()) {
    fs::remove(folder_ + "/views.csv", none);  // of an earlier run
  } else {
    write_text_atomically(folder_ + "/views.csv", table.csv());
  }
}

}  // namespace dvrlab
