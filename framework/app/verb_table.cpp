#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "framework/app/data_input.h"
#include "framework/app/verbs.h"
#include "framework/image/atomic_file.h"
#include "framework/image/image_io.h"
#include "framework/interfaces/error.h"
#include "framework/report/log.h"
#include "framework/report/number_text.h"
#include "framework/report/pretty_json.h"
#include "framework/report/text_table.h"
#include "framework/scene/scene.h"
#include "framework/table_study.h"

namespace dvrlab {
namespace {

std::string size_text(std::uint64_t bytes) {
  char text[32];
  if (bytes < (1u << 20))
    std::snprintf(text, sizeof text, "%.1f KiB", static_cast<double>(bytes) / 1024);
  else
    std::snprintf(text, sizeof text, "%.1f MiB", static_cast<double>(bytes) / 1048576);
  return text;
}

std::string class_name(const DepthClass& d) {
  return number_text(d.from, 3) + (d.to < 1e300 ? " - " + number_text(d.to, 3) : " and more");
}

std::string grid_csv(const TableStudy& s) {
  std::ostringstream text;
  text << "v0,v1,depth,error\n";
  text.precision(9);
  const std::size_t n = s.value.size();
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x)
      text << s.value[x] << ',' << s.value[y] << ',' << s.depth[y * n + x] << ',' << s.error[y * n + x] << '\n';
  return text.str();
}

nlohmann::ordered_json json_of(const PlannedCase& c, const TableStudy& s) {
  nlohmann::ordered_json choices = nlohmann::ordered_json::object();
  for (const AxisChoice& choice : c.choices) choices[choice.key] = choice.label;
  nlohmann::ordered_json classes = nlohmann::ordered_json::array();
  for (const DepthClass& d : s.classes)
    classes.push_back({{"depth_from", d.from},
                       {"depth_to", d.to < 1e300 ? nlohmann::ordered_json(d.to) : nlohmann::ordered_json()},
                       {"pairs", d.pairs},
                       {"worst", d.worst},
                       {"rms", d.rms}});
  return {{"id", c.id},
          {"choices", choices},
          {"bytes", s.bytes},
          {"build_s", s.build_seconds},
          {"segment_length", s.length},
          {"worst", s.worst},
          {"rms", s.rms},
          {"by_depth", classes}};
}

}  // namespace

int table_verb(const Options& o) {
  const Registry registry(o.plugin_path);
  refuse_data(o.config, o.set, registry);
  ConfigDocument document = load_document(o.config, o.set);
  for (const char* key : {"expect", "reference"}) document.tree.root.erase(key);  // of images
  const Experiment experiment = plan_experiment(document, registry);
  const std::string folder = o.out + "/" + experiment.name + "/tables";
  FieldCache fields;
  std::vector<std::vector<std::string>> rows = {{"case", "size", "build", "worst error", "rms error"}};
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  bool missing = false;
  for (const PlannedCase& c : experiment.cases) {
    try {
      const TableStudy s =
          study_table(c.resolved, registry, *fields.load(c.resolved, registry), o.points, std::max(o.repeat, 1));
      if (rows.front().size() == 5)
        for (const DepthClass& d : s.classes) rows.front().push_back("depth " + class_name(d));
      rows.push_back({c.id, size_text(s.bytes), number_text(1e3 * s.build_seconds, 3) + " ms", number_text(s.worst, 3),
                      number_text(s.rms, 3)});
      for (const DepthClass& d : s.classes) rows.back().push_back(d.pairs > 0 ? number_text(d.worst, 2) : "-");
      list.push_back(json_of(c, s));
      const std::string to = folder + "/" + c.id;
      std::filesystem::create_directories(to);
      write_png(to + "/error.png", error_picture(s), false);
      write_text_atomically(to + "/error.csv", grid_csv(s));
      write_text_atomically(to + "/table.json", pretty_json(list.back()) + "\n");
    } catch (const NotSupported& e) {
      missing = true;
      log_line("scene", c.id + ": not supported: " + e.what());
      list.push_back({{"id", c.id}, {"not_supported", e.what()}});
    }
  }
  if (o.json) std::fputs((pretty_json(list) + "\n").c_str(), stdout);
  if (!o.json && rows.size() > 1) std::fputs(text_table(rows).c_str(), stdout);
  log_line("report", "error.png, error.csv and table.json of every case lie in " + folder);
  return missing ? 3 : 0;
}

}  // namespace dvrlab
