#include "framework/config/resolve.h"

#include <algorithm>

#include "framework/config/check_value.h"
#include "framework/config/key_pointer.h"
#include "framework/config/words.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

const ConfigJson empty_section = ConfigJson::object();

std::string unknown_word(const std::string& what, const std::string& found, std::vector<std::string> legal) {
  std::sort(legal.begin(), legal.end());
  return "unknown " + what + " '" + found + "'" + did_you_mean(found, legal) + "; legal: " + join_words(legal);
}

bool fits(const Declaration& declaration, const Parameter& p, const nlohmann::json& value) {
  for (const JsonShape& shape : declaration.shapes) {
    if (std::string(p.name) == shape.key) return shape.fits(value);
  }
  return true;
}

/// "" or why the key is not read: the choice that it belongs to is another one.
std::string unread_with(const Parameter& p, const nlohmann::json& resolved) {
  if (*p.only_with == '\0') return "";
  const std::vector<std::string> condition = split_words(p.only_with, '=');
  const std::vector<std::string> values = split_words(condition.at(1));
  const auto chosen = resolved.find(condition.at(0));
  if (chosen == resolved.end() || !chosen->is_string()) return "";  // the choice itself is wrong
  const std::string found = chosen->get<std::string>();
  if (std::find(values.begin(), values.end(), found) != values.end()) return "";
  return "is read only where " + condition[0] + " is " + join_words(values, " or ") + "; here it is " + found +
         " (remove the key, or change " + condition[0] + ")";
}

/// The group of a declared name: "surface" of "surface.opacity"; "" for a plain key.
std::string group_of(const std::string& name) {
  const std::size_t dot = name.find('.');
  return dot == std::string::npos ? "" : name.substr(0, dot);
}

/// The section with the keys of its groups at the top: {"surface": {"opacity": x}} -> {"surface.opacity": x}.
ConfigJson flattened(const ConfigTree& tree, const std::string& path, const ConfigJson& section,
                     const std::vector<Parameter>& keys, Problems& problems) {
  ConfigJson flat = ConfigJson::object();
  for (const auto& [key, value] : section.items()) {
    std::vector<std::string> members;
    for (const Parameter& p : keys)
      if (group_of(p.name) == key) members.push_back(std::string(p.name).substr(key.size() + 1));
    if (members.empty()) {
      flat[key] = value;
    } else if (value.is_object()) {
      for (const auto& [member, x] : value.items()) flat[key + "." + member] = x;
    } else {
      problems.add(tree.where(child_path(path, key)) + ": found " + short_text(value) +
                   "; must be a section with the keys " + join_words(members));
    }
  }
  return flat;
}

class CaseResolver {
 public:
  CaseResolver(const ConfigTree& tree, const Registry& registry, Problems& problems)
      : tree_(tree), registry_(registry), problems_(problems) {}

  ResolvedCase resolve(const std::string& base_folder) {
    ResolvedCase c;
    c.base_folder = base_folder;
    c.config = nlohmann::json::object();
    Declaration top = framework_declaration("case", "");
    top.also = top_sections();
    c.top = resolve_keys(tree_, "", top, problems_, c.config);
    c.data = plugin_section("data", "data", "", true, c.config["data"]);
    if (tree_.find("sampler") != nullptr)
      c.sampler = plugin_section("sampler", "sampler", "", false, c.config["sampler"]);
    c.optical_model = plugin_section("optical_model", "optical_model", "", true, c.config["optical_model"]);
    c.estimator = plugin_section("estimator", "estimator", "", true, c.config["estimator"]);
    c.backend = plugin_section("backend", "backend", "cpu", true, c.config["backend"]);
    c.camera = framework_section("camera", "camera", "", c.config["camera"]);
    c.sampling = framework_section("sampling", "sampling", "uniform", c.config["sampling"]);
    c.image = plain_section("image", "image", c.config["image"]);
    c.limits = plain_section("limits", "limits", c.config["limits"]);
    each("lights", c.config["lights"], [&](const std::string& path, nlohmann::json& out) {
      c.lights.push_back(framework_section(path, "lights", "", out));
    });
    each("illumination", c.config["illumination"], [&](const std::string& path, nlohmann::json& out) {
      c.illumination.push_back(plugin_section(path, "illumination", "", false, out));
    });
    each("clip", c.config["clip"], [&](const std::string& path, nlohmann::json& out) {
      c.clip.push_back({"clip", plain_section(path, "clip", out), nullptr, ""});
    });
    each("metrics", c.config["metrics"], [&](const std::string& path, nlohmann::json& out) {
      c.metrics.push_back(plugin_section(path, "metric", "", false, out));
    });
    if (c.lights.size() > most_lights)
      problems_.add(tree_.where("lights") + ": found " + std::to_string(c.lights.size()) + " lights; at most " +
                    std::to_string(most_lights) + " are possible");
    return c;
  }

  Section data() {
    nlohmann::json resolved;
    return plugin_section("data", "data", "", true, resolved);
  }

 private:
  static Declaration framework_declaration(const std::string& section, const std::string& type) {
    const SectionType* s = find_section_type(section, type);
    return s == nullptr ? Declaration{} : Declaration{s->keys, s->shapes, {}};
  }

  /// The section at `path`, or nullptr and a problem when it is no section. A missing one is as good as {}.
  const ConfigJson* section_at(const std::string& path) {
    const ConfigJson* section = tree_.find(path);
    if (section == nullptr) return &empty_section;
    if (section->is_object()) return section;
    problems_.add(tree_.where(path) + ": found " + short_text(*section) + "; must be a section {...}");
    return nullptr;
  }

  /// The section's type; "" and a problem when there is none that is right.
  std::string type_at(const std::string& path, const char* default_type, const std::vector<std::string>& legal) {
    const ConfigJson* section = section_at(path);
    if (section == nullptr) return "";
    if (!section->contains("type")) {
      if (*default_type != '\0') return default_type;
      problems_.add(tree_.where(path) + (tree_.find(path) == nullptr ? ": section is missing" : ": 'type' is missing") +
                    "; types: " + join_words(legal));
      return "";
    }
    const ConfigJson& type = (*section)["type"];
    if (type.is_string()) return type.get<std::string>();
    problems_.add(tree_.where(path + ".type") + ": found " + short_text(type) + "; must be one of " +
                  join_words(legal));
    return "";
  }

  Section plugin_section(const std::string& path, const std::string& kind, const char* default_type, bool common,
                         nlohmann::json& out) {
    std::vector<std::string> there;
    for (const PluginEntryInfo& e : registry_.entries()) {
      if (e.kind == kind && e.descriptor != nullptr) there.push_back(e.name);
    }
    std::sort(there.begin(), there.end());
    Section s;
    s.type = type_at(path, default_type, there);
    if (s.type.empty()) return s;
    try {
      const PluginEntryInfo& entry = registry_.find(kind, s.type);
      s.plugin = entry.descriptor;
      s.folder = entry.folder;
    } catch (const InputError& e) {
      problems_.add(tree_.where(path + ".type") + ": " + e.what());
      return s;
    }
    Declaration declaration = common ? framework_declaration(kind, "") : Declaration{};
    declaration.keys.insert(declaration.keys.end(), s.plugin->parameters,
                            s.plugin->parameters + s.plugin->parameter_count);
    const std::size_t before = problems_.lines().size();
    finish(path, std::move(declaration), s, out);
    if (problems_.lines().size() == before) check(kind, s);
    return s;
  }

  /// What the plugin itself has to say of its values.
  void check(const std::string& kind, const Section& s) {
    try {
      located([&] { registry_.get<Plugin>(kind, s.type).check(s.parameters); });
    } catch (const NotSupported&) {  // a plugin that cannot be made: the verdict of its cases, not a wrong config
    }
  }

  Section framework_section(const std::string& path, const std::string& section, const char* default_type,
                            nlohmann::json& out) {
    Section s;
    s.type = type_at(path, default_type, types_of(section));
    if (s.type.empty()) return s;
    if (find_section_type(section, s.type) == nullptr) {
      problems_.add(tree_.where(path + ".type") + ": " + unknown_word("type", s.type, types_of(section)));
      return s;
    }
    const std::size_t before = problems_.lines().size();
    finish(path, framework_declaration(section, s.type), s, out);
    const auto check_keys = find_section_type(section, s.type)->check;
    if (check_keys != nullptr && problems_.lines().size() == before) {
      located([&] { check_keys(s.parameters); });
    }
    return s;
  }

  template <class Check>
  void located(Check check) {
    try {
      check();
    } catch (const InputError& e) {
      problems_.add(tree_.located(e.what()));
    }
  }

  void finish(const std::string& path, Declaration declaration, Section& s, nlohmann::json& out) {
    out = {{"type", s.type}};
    declaration.also = {"type"};
    s.parameters = resolve_keys(tree_, path, declaration, problems_, out);
  }

  ParameterSet plain_section(const std::string& path, const std::string& section, nlohmann::json& out) {
    out = nlohmann::json::object();
    if (section_at(path) == nullptr) return {};
    return resolve_keys(tree_, path, framework_declaration(section, ""), problems_, out);
  }

  template <class One>
  void each(const std::string& path, nlohmann::json& out, One one) {
    out = nlohmann::json::array();
    const ConfigJson* list = tree_.find(path);
    if (list == nullptr) return;
    if (!list->is_array()) {
      problems_.add(tree_.where(path) + ": found " + short_text(*list) + "; must be a list [...]");
      return;
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
      out.push_back(nlohmann::json::object());
      one(child_path(path, i), out.back());
    }
  }

  const ConfigTree& tree_;
  const Registry& registry_;
  Problems& problems_;
};

}  // namespace

ParameterSet resolve_keys(const ConfigTree& tree, const std::string& path, const Declaration& declaration,
                          Problems& problems, nlohmann::json& resolved) {
  const ConfigJson* written = path.empty() ? &tree.root : tree.find(path);
  const ConfigJson section = flattened(
      tree, path, written != nullptr && written->is_object() ? *written : empty_section, declaration.keys, problems);
  for (const auto& [key, value] : section.items()) {
    std::vector<std::string> legal = declaration.also;
    for (const Parameter& p : declaration.keys) legal.emplace_back(p.name);
    if (std::find(legal.begin(), legal.end(), key) == legal.end()) {
      problems.add(tree.where_key(child_path(path, key)) + ": " + unknown_word("key", key, legal));
    }
  }
  for (const Parameter& p : declaration.keys) {
    const std::string here = child_path(path, p.name);
    if (!section.contains(p.name)) {
      if (p.default_value != nullptr) {
        resolved[key_pointer(p.name)] = nlohmann::json::parse(p.default_value);
      } else {
        problems.add(tree.where(path.empty() ? p.name : path) + ": '" + p.name + "' is missing; must be " +
                     legal_text(p) + ": " + p.summary);
      }
      continue;
    }
    const nlohmann::json value = section[p.name];
    std::string wrong = wrong_value(p, value);
    if (wrong.empty() && !fits(declaration, p, value))
      wrong = "found " + short_text(value) + "; must be " + legal_text(p);
    if (wrong.empty()) {
      resolved[key_pointer(p.name)] = stored_value(p, value);
    } else {
      problems.add(tree.where(here) + ": " + wrong);
    }
  }
  ParameterSet set(path, declaration.keys, resolved);
  for (const Parameter& p : declaration.keys) {
    const std::string unread = unread_with(p, resolved);
    if (unread.empty()) continue;
    if (section.contains(p.name)) problems.add(tree.where(child_path(path, p.name)) + ": " + unread);
    resolved.erase(p.name);  // what decides nothing is not part of the case
  }
  return set;
}

Section resolve_data(const ConfigTree& tree, const Registry& registry, Problems& problems) {
  return CaseResolver(tree, registry, problems).data();
}

ResolvedCase resolve_case(const ConfigTree& tree, const std::string& base_folder, const Registry& registry,
                          Problems& problems) {
  ConfigTree written = tree;
  if (!written.root.contains("lights")) written.root["lights"] = ConfigJson::parse(R"([{"type": "head"}])");
  if (written.root.contains("metrics") && written.root["metrics"].is_array()) {
    for (ConfigJson& metric : written.root["metrics"]) {
      if (metric.is_string()) metric = ConfigJson{{"type", metric}};  // a metric's type is short for its section
    }
  }
  ResolvedCase c = CaseResolver(written, registry, problems).resolve(base_folder);
  c.config["base_folder"] = base_folder;  // the config is written elsewhere; its paths keep their meaning
  return c;
}

}  // namespace dvrlab
