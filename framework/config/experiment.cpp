#include "framework/config/experiment.h"

#include <algorithm>
#include <map>
#include <set>

#include "framework/config/axes.h"
#include "framework/config/problems.h"
#include "framework/config/resolve.h"
#include "framework/config/words.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/scene.h"

namespace dvrlab {
namespace {

constexpr std::size_t max_cases = 100000;
constexpr std::size_t max_id = 160;  // letters; file systems allow 255 bytes

/// Every key path that a patch decides: a section that names its type is decided as a whole.
void decided_paths(const std::string& path, const ConfigJson& value, std::vector<std::string>& paths) {
  if (value.is_object() && !value.contains("type") && !value.empty()) {
    for (const auto& [key, inner] : value.items()) decided_paths(child_path(path, key), inner, paths);
  } else {
    paths.push_back(path);
  }
}

bool decides(const std::vector<std::string>& paths, const std::string& key) {
  return std::any_of(paths.begin(), paths.end(), [&](const std::string& p) {
    return key.compare(0, p.size(), p) == 0 && (key.size() == p.size() || key[p.size()] == '.' || key[p.size()] == '[');
  });
}

class Planner {
 public:
  Planner(const ConfigDocument& document, const Registry& registry)
      : document_(document), registry_(registry), base_(document.tree) {
    for (const char* key : {"axes", "reference", "expect"}) base_.root.erase(key);
  }

  Experiment plan() {
    experiment_.name = document_.name;
    axes_ = read_axes(document_.tree, problems_);
    check_references();
    experiment_.expectations = read_expectations(document_.tree, problems_);
    problems_.raise();
    std::size_t permutations = 1, variants = 1;
    for (const Axis& a : axes_) (a.variant ? variants : permutations) *= std::min(a.values.size(), max_cases);
    if (permutations > max_cases || variants > max_cases || permutations * variants > max_cases) {
      throw InputError(document_.tree.where("axes") + ": more than " + std::to_string(max_cases) +
                       " cases (take values away, or split the experiment)");
    }
    for (std::size_t p = 0; p < permutations; ++p) plan_permutation(p, variants);
    problems_.raise();
    return std::move(experiment_);
  }

 private:
  using Choice = std::vector<std::size_t>;  // an index of a value for every axis

  /// The axes of one role as digits of `number`, the first axis outermost.
  void choose(Choice& choice, bool variant, std::size_t number) const {
    for (std::size_t a = axes_.size(); a-- > 0;) {
      if (axes_[a].variant != variant) continue;
      choice[a] = number % axes_[a].values.size();
      number /= axes_[a].values.size();
    }
  }

  void plan_permutation(std::size_t permutation, std::size_t variants) {
    Choice choice(axes_.size(), 0);
    choose(choice, false, permutation);
    const auto references = plan_references(choice);
    const std::size_t first = experiment_.cases.size();
    for (std::size_t v = 0; v < variants; ++v) {
      choose(choice, true, v);
      PlannedCase c;
      std::vector<std::string> words;
      for (std::size_t a = 0; a < axes_.size(); ++a) {
        c.choices.push_back({axes_[a].key, axes_[a].values[choice[a]].label});
        words.push_back(axes_[a].key + "=" + c.choices.back().label);
      }
      c.id = unique_id(words.empty() ? "case" : join_words(words, ","));
      c.first_variant = first;
      c.references = references;
      resolve(tree_of(choice), c, axes_.empty() ? document_.name : document_.name + "." + c.id);
      experiment_.cases.push_back(std::move(c));
    }
  }

  std::vector<std::pair<std::string, std::size_t>> plan_references(const Choice& choice) {
    std::vector<std::pair<std::string, std::size_t>> found;
    const ConfigJson* references = document_.tree.find("reference");
    if (references == nullptr) return found;
    for (const auto& [name, patch] : references->items()) {
      std::vector<std::string> decided;
      for (const auto& [key, value] : patch.items()) decided_paths(key, value, decided);
      PlannedCase c;
      c.reference_name = name;
      std::vector<std::string> words = {"reference=" + name};
      for (std::size_t a = 0; a < axes_.size(); ++a) {
        if (decides(decided, axes_[a].key)) continue;
        c.choices.push_back({axes_[a].key, axes_[a].values[choice[a]].label});
        if (!axes_[a].variant) words.push_back(axes_[a].key + "=" + c.choices.back().label);
      }
      // Permutations that differ only in what the patch decides share one reference.
      const std::string key = join_words(words, ",");
      auto known = references_.find(key);
      if (known == references_.end()) {
        known = references_.emplace(key, experiment_.cases.size()).first;
        c.id = unique_id(key);
        c.first_variant = experiment_.cases.size();
        resolve(reference_tree(choice, name, patch, decided), c, document_.name + "." + c.id);
        experiment_.cases.push_back(std::move(c));
      }
      found.emplace_back(name, known->second);
    }
    return found;
  }

  ConfigTree tree_of(const Choice& choice) {
    ConfigTree tree = base_;
    std::vector<std::size_t> order(axes_.size());
    for (std::size_t a = 0; a < order.size(); ++a) order[a] = a;
    // A whole section before the keys in it.
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return split_path(axes_[a].key).size() < split_path(axes_[b].key).size();
    });
    for (const std::size_t a : order) {
      const AxisValue& v = axes_[a].values[choice[a]];
      try {
        tree.graft(axes_[a].key, v.value, document_.tree, v.source);
      } catch (const InputError& e) {
        problems_.add(e.what());
      }
    }
    return tree;
  }

  ConfigTree reference_tree(const Choice& choice, const std::string& name, const ConfigJson& patch,
                            const std::vector<std::string>& decided) {
    const std::string source = child_path("reference", name);
    ConfigTree tree = tree_of(choice);
    tree.merge(document_.tree, source, patch);
    const ConfigJson* type = tree.find("sampling.type");
    const SectionType* sampling =
        find_section_type("sampling", type != nullptr && type->is_string() ? type->get<std::string>() : "uniform");
    const bool terminates =
        sampling != nullptr && std::any_of(sampling->keys.begin(), sampling->keys.end(),
                                           [](const Parameter& p) { return p.name == std::string("termination"); });
    // A reference runs every ray to its end unless it says otherwise.
    if (terminates && std::find(decided.begin(), decided.end(), "sampling.termination") == decided.end() &&
        !(patch.contains("sampling") && patch["sampling"].is_object() && patch["sampling"].contains("termination"))) {
      tree.graft("sampling.termination", 0, document_.tree, source);
    }
    return tree;
  }

  void check_references() {
    const ConfigJson* references = document_.tree.find("reference");
    if (references == nullptr) return;
    const auto bad = [&](const std::string& path, const char* what) {
      problems_.add(document_.tree.where(path) + ": " + what);
    };
    if (!references->is_object()) return bad("reference", "must be a section of name -> patch");
    for (const auto& [name, patch] : references->items()) {
      const std::string path = child_path("reference", name);
      if (name == "variant" || name.empty() || name != file_safe(name))
        bad(path, "is no name for a reference; letters, digits and _ are, except 'variant'");
      if (!patch.is_object()) {
        bad(path, "must be a section: a patch on the case");
        continue;
      }
      for (const char* key : {"name", "schema", "base_folder", "include", "axes", "reference", "metrics", "expect"}) {
        if (patch.contains(key)) bad(child_path(path, key), "a reference cannot change this key");
      }
    }
  }

  void resolve(const ConfigTree& tree, PlannedCase& c, const std::string& name) {
    Problems problems;
    c.resolved = resolve_case(tree, document_.base_folder, registry_, problems);
    c.resolved.config["name"] = name;
    if (problems.empty()) check(tree, c.resolved, problems);
    problems_.add(problems);
  }

  void check(const ConfigTree& tree, const ResolvedCase& c, Problems& problems) const {
    std::set<std::string> metrics;
    for (const Section& m : c.metrics) {
      if (!metrics.insert(m.type).second)
        problems.add(tree.where("metrics") + ": metric '" + m.type + "' is listed twice (keep one)");
    }
    try {
      check_data_file(c);
      check_case(c, registry_);
    } catch (const InputError& e) {
      problems.add(tree.located(e.what()));
    } catch (const NotSupported&) {  // a plugin that cannot be made: the verdict of its cases when they run
    }
  }

  /// Data that is missing is found before the first case runs, unless it may be missing.
  static void check_data_file(const ResolvedCase& c) {
    const nlohmann::json& data = c.config["data"];
    if (data["optional"] == true || !data.contains("file") || !data["file"].is_string()) return;
    LoadContext context;
    context.base_folder = c.base_folder;
    resolve_path(data["file"].get<std::string>(), context, "data.file");
  }

  std::string unique_id(const std::string& text) {
    std::string id = file_safe(text);
    if (id.size() > max_id) id.resize(max_id);
    const std::string stem = id;
    for (int n = 2; !ids_.insert(id).second; ++n) id = stem + "+" + std::to_string(n);
    return id;
  }

  const ConfigDocument& document_;
  const Registry& registry_;
  ConfigTree base_;
  std::vector<Axis> axes_;
  Problems problems_;
  Experiment experiment_;
  std::map<std::string, std::size_t> references_;
  std::set<std::string> ids_;
};

}  // namespace

Experiment plan_experiment(const ConfigDocument& document, const Registry& registry) {
  Experiment experiment = Planner(document, registry).plan();
  Problems problems;
  check_expectations(experiment, document.tree, problems);
  problems.raise();
  return experiment;
}

}  // namespace dvrlab
