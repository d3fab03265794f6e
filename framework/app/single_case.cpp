#include "framework/app/single_case.h"

#include <filesystem>

#include "framework/app/data_input.h"
#include "framework/app/starter.h"
#include "framework/config/views.h"
#include "framework/interfaces/error.h"
#include "framework/report/log.h"

namespace dvrlab {
namespace {

/// The config that is named, or the starter config of the data that is named.
ConfigDocument document_of(const Options& o, const Registry& registry, std::shared_ptr<const Field>& field) {
  if (!names_data(o.config, o.set, registry)) return load_document(o.config, o.set);
  // Keys of the data section matter for reading it; the others are for the config.
  std::vector<std::string> set_data;
  for (const std::string& s : o.set)
    if (lies_in(s.substr(0, s.find('=')), "data")) set_data.push_back(s);
  const LoadedData data = load_data(data_document(o.config, set_data, registry), registry);
  log_line("config", o.config + " is data, so a starter config is made from it: " + starter_words(data));
  log_line("config", "to write and edit it: dvrlab info " + o.config + " --starter my.json");
  field = data.field;
  const std::string folder = std::filesystem::current_path().string();
  return parse_document(starter_config(data, folder), o.config, folder, o.set);
}

/// What leaves one case of these: a view of the orbit, no axes, or both.
std::string how_to_have_one(const Experiment& experiment) {
  bool views = false, axes = false;
  for (const PlannedCase& c : experiment.cases) {
    for (const AxisChoice& choice : c.choices) (choice.key == view_key ? views : axes) = true;
  }
  if (!views) return "fix the axes: --set 'axes={}'";
  return std::string("choose a view of the orbit: --set camera.view=0") +
         (axes ? ", without axes: --set 'axes={}'" : "");
}

/// The starter config reads what was loaded for it, unless --set leads elsewhere: to other values of an axis, or
/// another folder.
bool reads(const PlannedCase& c, const Field& field) {
  for (const AxisChoice& choice : c.choices)
    if (lies_in(choice.key, "data")) return false;
  const std::filesystem::path file = c.resolved.data.parameters.text("file");
  std::error_code ec;
  return std::filesystem::equivalent(c.resolved.base_folder / file, field.source, ec);
}

}  // namespace

SingleCase single_case(const Options& o, const Registry& registry) {
  std::shared_ptr<const Field> field;
  ConfigDocument document = document_of(o, registry, field);
  document.tree.root.erase("expect");  // of the whole experiment: one case may be too few for them
  Experiment experiment = plan_experiment(document, registry);
  PlannedCase* only = nullptr;
  std::size_t count = 0;
  for (PlannedCase& c : experiment.cases) {
    if (!c.reference_name.empty()) continue;
    only = &c;
    ++count;
  }
  if (count != 1) {
    throw InputError(o.config + ": the config asks for " + std::to_string(count) +
                     " cases, this verb takes one (use `dvrlab run`, or " + how_to_have_one(experiment) + ")");
  }
  if (field != nullptr && !reads(*only, *field)) field.reset();
  return {std::move(*only), std::move(field)};
}

}  // namespace dvrlab
