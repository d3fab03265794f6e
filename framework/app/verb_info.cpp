#include <cstdio>
#include <filesystem>

#include "framework/app/info_report.h"
#include "framework/app/plot/plot_of.h"
#include "framework/app/starter.h"
#include "framework/app/verbs.h"
#include "framework/image/atomic_file.h"
#include "framework/interfaces/error.h"
#include "framework/report/log.h"
#include "framework/report/pretty_json.h"

namespace dvrlab {
namespace {

constexpr int bins_for_people = 20, bins_for_machines = 256;

void write_starter(const Options& o, const LoadedData& data) {
  const std::filesystem::path file = std::filesystem::absolute(o.starter);
  write_text_atomically(o.starter, starter_config(data, file.parent_path().string()));
  log_line("config", o.starter + " renders this data: dvrlab render " + o.starter + " -o image.png");
}

}  // namespace

int info_verb(const Options& o) {
  if (o.force && o.starter.empty()) throw InputError("info: --force belongs to --starter FILE");
  std::error_code ec;
  if (!o.starter.empty() && !o.force && std::filesystem::exists(o.starter, ec))
    throw InputError("--starter " + o.starter + ": the file exists; --force overwrites it");
  if (std::filesystem::equivalent(o.starter, o.config, ec))
    throw InputError("--starter " + o.starter + ": is the data itself; name another file");
  if (!o.starter.empty()) require_writable(o.starter);
  const Registry registry(o.plugin_path);
  const bool data_alone = names_data(o.config, o.set, registry);
  if (!data_alone && !o.starter.empty())
    throw InputError("--starter: " + o.config + " is a config already; --starter makes one from a data file");
  if (!o.plot.empty()) check_plot_name(o.plot);
  if (!o.plot.empty()) require_writable(o.plot);
  const ConfigDocument document =
      data_alone ? data_document(o.config, o.set, registry) : load_document(o.config, o.set);
  const InfoReport info = make_info(load_data(document, registry));
  const int bins = o.bins > 0 ? o.bins : o.json ? bins_for_machines : bins_for_people;
  std::fputs(o.json ? (pretty_json(info_json(info, bins)) + "\n").c_str() : info_text(info, bins).c_str(), stdout);
  if (!o.starter.empty()) write_starter(o, info.data);
  if (!o.plot.empty()) {
    std::optional<Experiment> experiment;
    if (!data_alone) experiment = plan_experiment(document, registry);
    write_plot(o.plot, plot_of(info, experiment ? &*experiment : nullptr));
  }
  return 0;
}

}  // namespace dvrlab
