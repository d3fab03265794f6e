#include <algorithm>
#include <filesystem>

#include "framework/app/doctor.h"
#include "framework/config/resolve.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace fs = std::filesystem;
namespace {

/// For a backend that reports nothing: can it be opened with its defaults?
BackendReport report_of_open(const BackendPlugin& backend, const PluginEntryInfo& entry) {
  const PluginDescriptor& d = *entry.descriptor;
  Problems problems;
  nlohmann::json defaults = nlohmann::json::object();
  const ParameterSet parameters =
      resolve_keys({}, "backend", {{d.parameters, d.parameters + d.parameter_count}, {}, {}}, problems, defaults);
  if (!problems.empty()) return {{}, "needs parameters that have no default", ""};
  const DeviceInfo info = backend.open(parameters, entry.folder)->device(Precision::strict);
  return {{{info.device, info.driver, info.api, false, {{"detail", info.detail}}}}, "", ""};
}

BackendFinding examine_backend(const Registry& registry, const PluginEntryInfo& entry) {
  BackendFinding f{entry.name, false, {}};
  if (entry.descriptor == nullptr) {
    f.report.problem = entry.problem;
    return f;
  }
  try {
    const auto& backend = registry.get<BackendPlugin>("backend", entry.name);
    f.report = backend.report();
    if (f.report.device.empty() && f.report.problem.empty()) f.report = report_of_open(backend, entry);
    f.runs = f.report.problem.empty();
  } catch (const std::exception& e) {
    f.report.problem = e.what();
  } catch (...) {  // another compiler's code: whatever it throws is a finding
    f.report.problem = "throws something that is no std::exception";
  }
  return f;
}

/// Instruction sets by the files "<name>.<isa>.so" beside a plugin.
std::vector<std::string> module_isas(const PluginEntryInfo& entry) {
  std::vector<std::string> isas;
  std::error_code ec;
  for (const fs::directory_entry& e : fs::directory_iterator(entry.folder, ec)) {
    const std::string file = e.path().filename().string();
    const std::size_t dot = file.find('.');
    if (!file.starts_with(entry.name + ".")) continue;               // what a plugin has beside its kernel
    if (!file.ends_with(".so") || dot + 3 == file.size()) continue;  // <name>.so is the host side
    isas.push_back(file.substr(dot + 1, file.size() - dot - 4));
  }
  return isas;
}

}  // namespace

std::vector<BackendFinding> examine_backends(const Registry& registry) {
  std::vector<BackendFinding> findings;
  for (const PluginEntryInfo& e : registry.entries())
    if (e.kind == "backend") findings.push_back(examine_backend(registry, e));
  return findings;
}

std::vector<ModuleFinding> examine_modules(const Registry& registry) {
  std::map<std::string, int> present;
  int with_kernels = 0;
  for (const PluginEntryInfo& e : registry.entries()) {
    const std::vector<std::string> isas = module_isas(e);
    const bool has_kernel = fs::exists(e.folder + "/" + e.name + ".kernel");
    if (isas.empty() && !has_kernel) continue;
    ++with_kernels;
    for (const std::string& isa : isas) ++present[isa];
  }
  std::vector<ModuleFinding> findings;
  for (const auto& [isa, count] : present) findings.push_back({isa, count, with_kernels});
  return findings;
}

}  // namespace dvrlab
