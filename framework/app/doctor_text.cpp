#include "framework/app/doctor_text.h"

#include "framework/app/cli_model.h"
#include "framework/config/words.h"
#include "framework/report/byte_text.h"
#include "framework/report/text_table.h"

namespace dvrlab {
namespace {

constexpr const char* indent = "  ";

std::string indented(const std::string& table) {
  std::string text;
  for (const std::string& line : split_words(table.substr(0, table.size() - 1), '\n')) text += indent + line + "\n";
  return text;
}

std::string device_text(const DeviceReport& d) {
  std::vector<std::vector<std::string>> rows;
  if (!d.driver.empty()) rows.push_back({"driver", d.driver});
  if (!d.api.empty()) rows.push_back({"interface", d.api});
  for (const auto& [name, value] : d.property) rows.push_back({name, value});
  return indent + d.name + (d.software ? " (software)" : "") + "\n" + indented(indented(text_table(rows)));
}

std::string backend_text(const BackendFinding& b) {
  std::string text = "backend " + b.name + ": " + (b.runs ? "can render" : "cannot render") + "\n";
  if (!b.report.problem.empty()) text += indent + b.report.problem + "\n";
  for (const DeviceReport& d : b.report.device) text += device_text(d);
  return text;
}

std::string modules_text(const std::vector<ModuleFinding>& modules) {
  std::vector<std::string> parts;
  for (const ModuleFinding& m : modules)
    parts.push_back(m.isa + " " + std::to_string(m.present) + " of " + std::to_string(m.expected));
  return "kernel modules (cpu): " + (parts.empty() ? "none" : join_words(parts)) + "\n";
}

std::string folders_text(const Doctor& d) {
  std::string text;
  for (const FolderFinding& f : d.folders) {
    std::vector<std::string> counts;
    for (const auto& [kind, count] : f.usable) counts.push_back(std::to_string(count) + " " + kind);
    text += "plugin folder " + f.path + ": " + (counts.empty() ? "empty" : join_words(counts)) + "\n";
  }
  return text.empty() ? "plugin folder: none was found\n" : text;
}

std::string cache_text(const CacheFinding& c) {
  std::string text = "cache " + c.folder + ": ";
  if (c.exists) text += std::to_string(c.files) + " files, " + byte_text(c.bytes) + "; ";
  return text +
         (c.problem.empty() ? c.exists ? "can be written" : "will be made at the first use"
                            : "cannot be used, shaders are compiled each time: " + c.problem) +
         "\n";
}

/// One line per thing that is missing, with what to do about it.
std::string missing_text(const Doctor& d) {
  std::string text;
  for (const BackendFinding& b : d.backends) {
    if (b.runs) continue;
    text += std::string(indent) + "backend " + b.name +
            (b.report.package.empty() ? ": see above" : ": apt-get install " + b.report.package) + "\n";
  }
  for (const std::string& folder : d.missing_folders) text += indent + folder + "\n";
  for (const PluginProblem& p : d.broken)
    text += std::string(indent) + "broken plugin " + p.plugin + " " + p.reason + "\n";
  for (const PluginProblem& p : d.not_built)
    text += std::string(indent) + "plugin that was not built: " + p.plugin + ": " + p.reason + "\n";
  return text.empty() ? "nothing is missing\n" : "missing:\n" + text;
}

}  // namespace

std::string doctor_text(const Doctor& d) {
  std::string text = version_text();
  for (const BackendFinding& b : d.backends) text += "\n" + backend_text(b);
  text += "\n" + modules_text(d.modules) + folders_text(d) + cache_text(d.cache);
  text += "memory: " +
          (d.memory_total == 0 ? std::string("unknown")
                               : byte_text(d.memory_available) + " of " + byte_text(d.memory_total) +
                                     " available; a case may use 75 % of it (limits.memory)") +
          "\n\n" + missing_text(d);
  if (!d.can_render()) text += "no backend can render\n";
  return text;
}

nlohmann::ordered_json doctor_json(const Doctor& d) {
  using Json = nlohmann::ordered_json;
  Json backends = Json::array(), modules = Json::array(), folders = Json::array();
  for (const BackendFinding& b : d.backends) {
    Json devices = Json::array();
    for (const DeviceReport& r : b.report.device) {
      Json properties = Json::object();
      for (const auto& [name, value] : r.property) properties[name] = value;
      devices.push_back({{"name", r.name},
                         {"driver", r.driver},
                         {"api", r.api},
                         {"software", r.software},
                         {"properties", properties}});
    }
    backends.push_back({{"name", b.name},
                        {"runs", b.runs},
                        {"problem", b.report.problem},
                        {"package", b.report.package},
                        {"devices", devices}});
  }
  for (const ModuleFinding& m : d.modules)
    modules.push_back({{"isa", m.isa}, {"present", m.present}, {"expected", m.expected}});
  for (const FolderFinding& f : d.folders) folders.push_back({{"path", f.path}, {"plugins", f.usable}});
  const auto problems = [](const std::vector<PluginProblem>& list) {
    Json result = Json::array();
    for (const PluginProblem& p : list) result.push_back({{"plugin", p.plugin}, {"reason", p.reason}});
    return result;
  };
  return {{"version", split_words(version_text().substr(0, version_text().size() - 1), '\n')},
          {"can_render", d.can_render()},
          {"backends", backends},
          {"kernel_modules", modules},
          {"plugin_folders", folders},
          {"missing_plugin_folders", d.missing_folders},
          {"broken_plugins", problems(d.broken)},
          {"plugins_not_built", problems(d.not_built)},
          {"cache",
           {{"folder", d.cache.folder},
            {"exists", d.cache.exists},
            {"writable", d.cache.problem.empty()},
            {"problem", d.cache.problem},
            {"files", d.cache.files},
            {"bytes", d.cache.bytes}}},
          {"memory", {{"total_bytes", d.memory_total}, {"available_bytes", d.memory_available}}}};
}

}  // namespace dvrlab
