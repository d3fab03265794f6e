#include "framework/config/case_trees.h"

#include <algorithm>

#include "framework/config/expectation.h"
#include "framework/config/sections.h"
#include "framework/config/views.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

void decided_paths(const std::string& path, const ConfigJson& value, std::vector<std::string>& paths) {
  if (value.is_object() && !value.contains("type") && !value.empty()) {
    for (const auto& [key, inner] : value.items()) decided_paths(child_path(path, key), inner, paths);
  } else {
    paths.push_back(path);
  }
}

bool terminates(const ConfigTree& tree) {
  const ConfigJson* type = tree.find("sampling.type");
  const SectionType* sampling =
      find_section_type("sampling", type != nullptr && type->is_string() ? type->get<std::string>() : "uniform");
  return sampling != nullptr && std::any_of(sampling->keys.begin(), sampling->keys.end(),
                                            [](const Parameter& p) { return p.name == std::string("termination"); });
}

const ConfigJson& patch_of(const ConfigTree& document, const std::string& name) {
  return (*document.find("reference"))[name];
}

}  // namespace

CaseTrees::CaseTrees(const ConfigTree& document, const std::vector<Axis>& axes)
    : document_(document), axes_(axes), base_(document) {
  for (const char* key : {"axes", "reference", "expect"}) base_.root.erase(key);
}

ConfigTree CaseTrees::of_case(const Choice& choice, Problems& problems) const {
  std::vector<std::pair<const std::string*, const AxisValue*>> set;
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    for (const AxisKey& k : axes_[a].keys) set.emplace_back(&k.key, &k.values[choice.value[a]]);
  }
  // A whole section before the keys in it.
  std::stable_sort(set.begin(), set.end(), [](const auto& a, const auto& b) {
    return split_path(*a.first).size() < split_path(*b.first).size();
  });
  ConfigTree tree = base_;
  for (const auto& [key, v] : set) {
    try {
      tree.graft(*key, v->value, document_, v->source);
    } catch (const InputError& e) {
      problems.add(e.what());
    }
  }
  if (choice.view) tree.graft(view_key, *choice.view, document_, "camera.views");
  return tree;
}

std::vector<std::string> CaseTrees::decided_by_reference(const std::string& name) const {
  std::vector<std::string> decided = {"sampling.termination", "panel"};
  for (const auto& [key, value] : patch_of(document_, name).items()) decided_paths(key, value, decided);
  return decided;
}

ConfigTree CaseTrees::of_reference(const Choice& choice, const std::string& name, Problems& problems) const {
  const std::string source = child_path("reference", name);
  const ConfigJson& patch = patch_of(document_, name);
  ConfigTree tree = of_case(choice, problems);
  try {
    tree.merge(document_, source, patch);
  } catch (const InputError& e) {
    problems.add(e.what());
  }
  // A reference runs every ray to its end unless it says otherwise.
  const bool says =
      patch.contains("sampling.termination") ||
      (patch.contains("sampling") && patch["sampling"].is_object() && patch["sampling"].contains("termination"));
  if (!says && terminates(tree)) {
    tree.graft("sampling.termination", 0, document_, source);
  }
  tree.root.erase("panel");  // a word for the case, not for what it is measured against
  return tree;
}

void check_references(const ConfigTree& document, Problems& problems) {
  const ConfigJson* references = document.find("reference");
  if (references == nullptr) return;
  const auto bad = [&](const std::string& path, const std::string& what) {
    problems.add(document.where(path) + ": " + what);
  };
  if (!references->is_object()) return bad("reference", "must be a section of name -> patch");
  for (const auto& [name, patch] : references->items()) {
    const std::string path = child_path("reference", name);
    if (name == "variant" || name == own_reference || name.empty() || name != file_safe(name))
      bad(path, "is no name for a reference; letters, digits and _ are, except 'variant' and 'itself'");
    if (!patch.is_object()) {
      bad(path, "must be a section: a patch on the case");
      continue;
    }
    for (const auto& [key, value] : patch.items()) {
      if (const std::string wrong = wrong_path(key); !wrong.empty()) bad(child_path(path, key), wrong);
    }
    for (const char* key : {"name", "schema", "base_folder", "include", "axes", "reference", "metrics", "expect"}) {
      if (patch.contains(key)) bad(child_path(path, key), "a reference cannot change this key");
    }
  }
}

}  // namespace dvrlab
