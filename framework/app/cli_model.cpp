#include "framework/app/cli_model.h"

#include <algorithm>

#include "framework/interfaces/plugin.h"

namespace dvrlab {
namespace {

nlohmann::ordered_json options_json(const std::vector<OptionModel>& options) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const OptionModel& o : options) {
    list.push_back({{"names", o.names},
                    {"value", o.value},
                    {"choices", o.choices},
                    {"description", o.description},
                    {"default", o.default_value},
                    {"required", o.required},
                    {"repeats", o.repeats}});
  }
  return list;
}

}  // namespace

const VerbModel* ProgramModel::find(const std::string& verb) const {
  const auto found = std::find_if(verbs.begin(), verbs.end(), [&](const VerbModel& v) { return v.name == verb; });
  return found == verbs.end() ? nullptr : &*found;
}

std::vector<std::string> ProgramModel::verb_names() const {
  std::vector<std::string> names;
  for (const VerbModel& v : verbs) names.push_back(v.name);
  return names;
}

std::vector<OptionModel> ProgramModel::general_options(const VerbModel& verb) const {
  std::vector<OptionModel> general;
  for (OptionModel o : options) {
    const bool json = std::find(o.names.begin(), o.names.end(), "--json") != o.names.end();
    if (json && verb.json.empty()) continue;
    if (json) o.description += ": " + verb.json;
    if (o.names[0] != "--version") general.push_back(std::move(o));
  }
  return general;
}

std::string usage_line(const ProgramModel& program, const VerbModel& verb) {
  std::string line = program.name + " " + verb.name + " [OPTIONS]";
  for (const OptionModel& o : verb.options) {
    if (!o.argument() && !o.required) continue;
    const std::string text = o.argument() ? o.value : o.names[0] + " " + o.value;
    line += o.required ? " " + text : " [" + text + "]";
  }
  return line;
}

nlohmann::ordered_json model_json(const ProgramModel& program) {
  nlohmann::ordered_json verbs = nlohmann::ordered_json::array(), codes = nlohmann::ordered_json::array();
  for (const VerbModel& v : program.verbs) {
    nlohmann::ordered_json examples = nlohmann::ordered_json::array();
    for (const Example& e : v.examples) examples.push_back({{"command", e.command}, {"what", e.what}});
    verbs.push_back({{"name", v.name},
                     {"group", v.group},
                     {"summary", v.summary},
                     {"description", v.description},
                     {"json", v.json},
                     {"options", options_json(v.options)},
                     {"examples", examples}});
  }
  for (const ExitCode& c : exit_codes()) codes.push_back({{"code", c.code}, {"meaning", c.meaning}});
  return {{"name", program.name},  {"version", DVRLAB_VERSION},
          {"abi", DVRLAB_ABI_TAG}, {"options", options_json(program.options)},
          {"verbs", verbs},        {"exit_codes", codes}};
}

std::string version_text() {
  return std::string("dvrlab ") + DVRLAB_VERSION + "\nplugin ABI " + DVRLAB_ABI_TAG + "\ncompiler " + DVRLAB_COMPILER +
         "\n";
}

}  // namespace dvrlab
