#include <algorithm>
#include <cstdio>

#include "framework/app/verbs.h"
#include "framework/config/sections.h"
#include "framework/config/words.h"
#include "framework/interfaces/error.h"
#include "framework/plugin/registry.h"
#include "framework/report/log.h"
#include "framework/report/text_table.h"

namespace dvrlab {
namespace {

struct Row {
  std::string kind, name, version, summary, problem;
};

std::vector<Row> everything(const Registry& registry) {
  std::vector<Row> rows;
  for (const PluginEntryInfo& e : registry.entries()) {
    const PluginDescriptor* d = e.descriptor;
    const bool said = std::any_of(rows.begin(), rows.end(), [&](const Row& r) {  // both halves of a duplicate
      return !e.problem.empty() && r.kind == e.kind && r.name == e.name && r.problem == e.problem;
    });
    if (said) continue;
    rows.push_back({e.kind, e.name, d != nullptr ? d->version : "", d != nullptr ? d->summary : "", e.problem});
  }
  for (const SectionType& s : section_types()) {
    if (*s.type != '\0') rows.push_back({s.section, s.type, "built in", s.summary, ""});
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.kind < b.kind; });
  return rows;
}

}  // namespace

int list_verb(const Options& o) {
  const Registry registry(o.plugin_path, MissingRoots::found);
  for (const std::string& missing : registry.missing_roots()) log_line("plugins", missing);
  std::vector<Row> rows = everything(registry);
  if (!o.name.empty()) {
    std::vector<std::string> kinds;
    for (const Row& r : rows) {
      if (kinds.empty() || kinds.back() != r.kind) kinds.push_back(r.kind);
    }
    std::erase_if(rows, [&](const Row& r) { return r.kind != o.name; });
    if (rows.empty()) {
      throw InputError("nothing of kind '" + o.name + "' was found" + did_you_mean(o.name, kinds) + "; there are " +
                       join_words(kinds));
    }
  }
  std::vector<std::vector<std::string>> table = {{"kind", "name", "version", "what it is"}};
  nlohmann::json list = nlohmann::json::array();
  for (const Row& r : rows) {
    table.push_back(
        {r.kind, r.name, r.problem.empty() ? r.version : "broken", r.problem.empty() ? r.summary : r.problem});
    list.push_back(
        {{"kind", r.kind}, {"name", r.name}, {"version", r.version}, {"summary", r.summary}, {"problem", r.problem}});
  }
  std::fputs(o.json ? (list.dump(1) + "\n").c_str() : text_table(table).c_str(), stdout);
  return 0;
}

}  // namespace dvrlab
