#include "framework/config/override.h"

#include "framework/config/axes.h"
#include "framework/config/check_value.h"
#include "framework/config/json_reader.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

/// Where the values of an axis stand, and the key path that they vary.
struct WrittenAxis {
  std::string place, key;
};

std::vector<WrittenAxis> written_axes(const ConfigTree& tree, const std::string& role) {
  std::vector<WrittenAxis> axes;
  const auto add = [&](const std::string& path, const ConfigJson& section) {
    if (!section.is_object()) return;
    for (const auto& [key, values] : section.items()) {
      if (key != "zip") axes.push_back({child_path(path, key), key});
    }
  };
  const ConfigJson* section = tree.find("axes." + role);
  if (section == nullptr || !section->is_object()) return axes;
  add("axes." + role, *section);
  if (!section->contains("zip") || !(*section)["zip"].is_array()) return axes;
  for (std::size_t i = 0; i < (*section)["zip"].size(); ++i)
    add(child_path("axes." + role + ".zip", i), (*section)["zip"][i]);
  return axes;
}

/// Sets the values of the axis `rest` ("sampling.step", "zip[0].sampling.step"): a key path is one key there.
void override_axis(ConfigTree& tree, const std::string& role, const std::string& rest, const ConfigJson& values,
                   const std::string& place) {
  for (const std::string& above : {std::string("axes"), "axes." + role}) {
    const ConfigJson* found = tree.find(above);
    if (found != nullptr && !found->is_object())
      throw InputError(tree.where(above) + ": found " + short_text(*found) + "; must be a section {...} (for " + place +
                       ")");
  }
  ConfigJson* section = &tree.root["axes"][role];
  std::string key = rest;
  if (rest.compare(0, 4, "zip[") == 0) {
    const std::size_t end = rest.find("].");
    const std::string group = "axes." + role + "." + rest.substr(0, end == std::string::npos ? end : end + 1);
    if (end == std::string::npos || tree.find(group) == nullptr || !tree.find(group)->is_object())
      throw InputError(place + ": there is no section '" + group + "' with key paths");
    section = &(*section)["zip"][std::stoul(rest.substr(4))];
    key = rest.substr(end + 2);
  }
  (*section)[key] = values;
  const std::string path = "axes." + role + "." + rest;
  tree.erase_places(path);
  tree.set_place(path, {"--set", 0, 0, path});
}

/// Read as a config is: nothing in it may be written twice.
ConfigJson value_of(const std::string& text, const std::string& place) {
  Problems problems;
  const ConfigTree tree = read_json(text, place, problems);
  problems.raise();
  return tree.root;
}

}  // namespace

void override_key(ConfigTree& tree, const std::string& assignment) {
  const std::size_t equal = assignment.find('=');
  const std::string place = "--set " + assignment;
  if (equal == std::string::npos || equal == 0) throw InputError(place + ": must be key.path=value");
  const std::string key = assignment.substr(0, equal), text = assignment.substr(equal + 1);
  if (const std::string wrong = wrong_path(key); !wrong.empty()) throw InputError(place + ": " + wrong);
  if (lies_in(key, "include")) throw InputError(place + ": include is read from files only; name it in the config");
  ConfigTree given;
  given.root = ConfigJson::accept(text) ? value_of(text, "--set " + key) : ConfigJson(text);
  given.set_place("", {"--set", 0, 0, key});
  for (const std::string role : {"permutation", "variant"}) {
    const std::string axes = "axes." + role + ".";
    if (key.compare(0, axes.size(), axes) == 0)
      return override_axis(tree, role, key.substr(axes.size()), given.root, place);
    for (const WrittenAxis& axis : written_axes(tree, role)) {
      if (lies_in(key, axis.key))
        throw InputError(place + ": the axis " + axis.place + " decides this key; set that, to one value in a list");
    }
  }
  tree.graft(key, given.root, given, "");
}

}  // namespace dvrlab
