#include <algorithm>
#include <cstdio>

#include "framework/app/verbs.h"
#include "framework/config/check_value.h"
#include "framework/config/schema.h"
#include "framework/config/sections.h"
#include "framework/config/words.h"
#include "framework/interfaces/error.h"
#include "framework/plugin/registry.h"
#include "framework/report/text_table.h"

namespace dvrlab {
namespace {

struct Described {
  std::string kind, name, version, summary, citation;
  std::vector<Parameter> keys;
  std::vector<Parameter> shared;                                // keys that all of the kind have
  std::vector<std::pair<std::string, std::string>> parts = {};  // of a section: its types, or keys; with a sentence
};

/// What a section of the config is, and what it may hold; its sentences are the schema's.
Described section_of(const std::string& section, const std::vector<Described>& types,
                     const nlohmann::ordered_json& schema) {
  const nlohmann::ordered_json& entry = schema["properties"][section];
  Described d{section, "", "", entry["description"].get<std::string>(), "", {}, {}};
  const std::string kind = section == "metrics" ? "metric" : section;
  for (const Described& t : types) {
    if (t.kind == kind && !t.name.empty()) d.parts.emplace_back(kind + "." + t.name, t.summary);
    if (t.kind == kind && t.name.empty()) d.keys = t.keys;
  }
  if (section != "axes") return d;
  for (const auto& [key, part] : entry["properties"].items())
    d.parts.emplace_back(key, part["description"].get<std::string>());
  for (const auto& [key, range] : schema["definitions"]["range"]["properties"].items())
    d.parts.emplace_back("{\"" + key + "\": ...}", "values, " + range["description"].get<std::string>());
  return d;
}

std::vector<Described> everything(const Registry& registry) {
  std::vector<Described> all;
  for (const PluginEntryInfo& e : registry.entries()) {
    if (e.descriptor == nullptr) continue;
    const PluginDescriptor& d = *e.descriptor;
    const SectionType* common = find_section_type(e.kind, "");
    all.push_back({e.kind,
                   e.name,
                   d.version,
                   d.summary,
                   d.citation,
                   {d.parameters, d.parameters + d.parameter_count},
                   common != nullptr ? common->keys : std::vector<Parameter>{}});
  }
  for (const SectionType& s : section_types()) all.push_back({s.section, s.type, "", s.summary, "", s.keys, {}});
  const nlohmann::ordered_json schema = config_schema(registry);
  std::vector<Described> sections;
  for (const std::string& section : top_sections()) sections.push_back(section_of(section, all, schema));
  std::erase_if(all, [](const Described& d) { return d.name.empty() && d.kind != "case"; });  // now among the sections
  all.insert(all.end(), sections.begin(), sections.end());
  return all;
}

/// "camera.perspective"; "image" for a section without types.
std::string full_name(const Described& d) { return d.name.empty() ? d.kind : d.kind + "." + d.name; }

const char* affects_text(Affects a) {
  return a == Affects::pixels ? "pixels" : a == Affects::speed ? "speed" : "nothing";
}

/// With the choice that the key belongs to: "... (only with field=sinusoid)".
std::string summary_of(const Parameter& p) {
  return *p.only_with == '\0' ? p.summary : std::string(p.summary) + " (only with " + p.only_with + ")";
}

std::string key_table(const std::vector<Parameter>& keys) {
  std::vector<std::vector<std::string>> rows = {{"key", "unit", "default", "legal", "affects", "what it is"}};
  for (const Parameter& p : keys) {
    rows.push_back({p.name, *p.unit == '\0' ? "-" : p.unit, p.default_value == nullptr ? "(required)" : p.default_value,
                    legal_text(p), affects_text(p.affects), summary_of(p)});
  }
  return text_table(rows);
}

nlohmann::json key_list(const std::vector<Parameter>& keys) {
  nlohmann::json list = nlohmann::json::array();
  for (const Parameter& p : keys) {
    list.push_back({{"name", p.name},
                    {"unit", p.unit},
                    {"default", p.default_value == nullptr ? nlohmann::json() : nlohmann::json::parse(p.default_value)},
                    {"required", p.default_value == nullptr},
                    {"legal", legal_text(p)},
                    {"affects", affects_text(p.affects)},
                    {"only_with", p.only_with},
                    {"summary", p.summary}});
  }
  return list;
}

std::string text_of(const Described& d) {
  std::string text = full_name(d) + (d.version.empty() ? "" : " " + d.version) + "\n" + d.summary + "\n";
  if (!d.citation.empty()) text += "Source: " + d.citation + "\n";
  if (!d.parts.empty()) {
    std::vector<std::vector<std::string>> rows = {{d.kind == "axes" ? "key or value" : "type", "what it is"}};
    for (const auto& [name, sentence] : d.parts) rows.push_back({name, sentence});
    text += "\n" + text_table(rows);
  }
  if (!d.keys.empty() && !d.parts.empty()) text += "\nshared by every type:\n" + key_table(d.keys);
  if (!d.keys.empty() && d.parts.empty()) text.append("\n").append(key_table(d.keys));
  if (!d.shared.empty()) text += "\nshared by every " + d.kind + ":\n" + key_table(d.shared);
  return text;
}

}  // namespace

int describe_verb(const Options& o) {
  const Registry registry(o.plugin_path);
  std::vector<std::string> names;
  std::vector<Described> found;
  for (const Described& d : everything(registry)) {
    names.push_back(full_name(d));
    if (!d.name.empty()) names.push_back(d.name);
    if (o.name == full_name(d) || (!d.name.empty() && o.name == d.name)) found.push_back(d);
  }
  if (found.empty()) {
    for (const PluginEntryInfo& e : registry.entries()) {
      if (o.name == e.name || o.name == e.kind + "." + e.name)
        registry.find(e.kind, e.name);  // says what is wrong with it
    }
    std::erase_if(names, [](const std::string& n) {
      const std::vector<std::string>& sections = top_sections();
      return n.find('.') == std::string::npos && n != "case" &&
             std::find(sections.begin(), sections.end(), n) == sections.end();
    });
    std::sort(names.begin(), names.end());
    std::string last_part = o.name.substr(o.name.find('.') + 1);
    std::string nearest = nearest_name(o.name, names);
    for (std::size_t i = 0; i < names.size() && nearest.empty(); ++i) {
      if (!nearest_name(last_part, {names[i].substr(names[i].find('.') + 1)}).empty()) nearest = names[i];
    }
    throw InputError("no type '" + o.name + "' was found" +
                     (nearest.empty() ? "" : " (did you mean '" + nearest + "'?)") + "; there are " +
                     join_words(names));
  }
  nlohmann::json list = nlohmann::json::array();
  std::string text;
  for (const Described& d : found) {
    if (!text.empty()) text += "\n";
    nlohmann::json parts = nlohmann::json::array();
    for (const auto& [name, sentence] : d.parts) parts.push_back({{"name", name}, {"summary", sentence}});
    text += text_of(d);
    list.push_back({{"kind", d.kind},
                    {"name", d.name},
                    {"version", d.version},
                    {"summary", d.summary},
                    {"citation", d.citation},
                    {"parameters", key_list(d.keys)},
                    {"shared", key_list(d.shared)},
                    {"parts", parts}});
  }
  std::fputs(o.json ? (list.dump(1) + "\n").c_str() : text.c_str(), stdout);
  return 0;
}

}  // namespace dvrlab
