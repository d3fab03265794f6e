#include "framework/config/experiment.h"

#include <algorithm>
#include <map>
#include <set>

#include "framework/config/axes.h"
#include "framework/config/case_trees.h"
#include "framework/config/problems.h"
#include "framework/config/resolve_planned.h"
#include "framework/config/views.h"
#include "framework/config/words.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

constexpr std::size_t max_cases = 100000;
constexpr std::size_t max_id = 160;  // letters; file systems allow 255 bytes

bool decides(const std::vector<std::string>& paths, const std::string& key) {
  return std::any_of(paths.begin(), paths.end(), [&](const std::string& p) { return lies_in(key, p); });
}

class Planner {
 public:
  Planner(const ConfigDocument& document, const Registry& registry)
      : document_(document), registry_(registry), trees_(document.tree, axes_) {}

  Experiment plan() {
    experiment_.name = document_.name;
    std::vector<std::string> unread;
    axes_ = read_axes(document_.tree, unread, problems_);
    const bool axes_read = problems_.empty();
    Problems of_references, of_expectations;
    check_references(document_.tree, of_references);
    references_read_ = of_references.empty();
    experiment_.expectations = read_expectations(document_.tree, of_expectations);
    if (may_orbit(trees_.base(), axes_)) outer_ = order_around_views(axes_);
    if (axes_read) {
      plan_all();
    } else {
      check_first_case(unread);
    }
    problems_.add(of_references);
    const bool sound = problems_.empty();
    check_expectations(experiment_, document_.tree, sound, of_expectations);
    problems_.add(of_expectations);
    problems_.raise();
    return std::move(experiment_);
  }

 private:
  void plan_all() {
    try {
      plan_cases();
    } catch (const InputError& e) {
      problems_.add(e.what());
      check_first_case({});
    }
  }

  /// The first value of every axis, where the cases cannot be planned: the rest of the config may be wrong too.
  void check_first_case(const std::vector<std::string>& unread) {
    Choice choice{std::vector<std::size_t>(axes_.size(), 0), {}};
    if (asked_views(trees_.of_case(choice, problems_)) > 0) choice.view = 0;
    const ConfigTree tree = trees_.of_case(choice, problems_);
    const bool complete = std::all_of(unread.begin(), unread.end(), [&](const std::string& key) {
      return wrong_path(key).empty() && tree.find(key) != nullptr;
    });
    if (!complete) return;  // who knows what that axis would have brought
    PlannedCase c;
    resolve(tree, document_.name, c);
    experiment_.cases.push_back(std::move(c));
  }

  void plan_cases() {
    std::size_t outer = 1, inner = 1, variants = 1;
    for (std::size_t a = 0; a < axes_.size(); ++a) {
      std::size_t& product = axes_[a].variant ? variants : a < outer_ ? outer : inner;
      product *= axes_[a].count();
      if (product > max_cases) too_many();
    }
    if (outer * inner > max_cases || outer * inner * variants > max_cases) too_many();
    Choice choice{std::vector<std::size_t>(axes_.size(), 0), {}};
    std::vector<std::size_t> views;  // for every choice on the outer axes
    for (std::size_t o = 0; o < outer; ++o) {
      choose(choice, 0, outer_, false, o);
      views.push_back(views_of(choice));
    }
    std::size_t images = 0;
    for (const std::size_t n : views) images += std::max<std::size_t>(n, 1);
    if (images * inner * variants > max_cases) too_many();
    for (std::size_t o = 0; o < outer; ++o) {
      choose(choice, 0, outer_, false, o);
      for (std::size_t v = 0; v < std::max<std::size_t>(views[o], 1); ++v) {
        if (views[o] > 0) choice.view = v;
        views_ = views[o];
        for (std::size_t i = 0; i < inner; ++i) {
          choose(choice, outer_, axes_.size(), false, i);
          plan_permutation(choice, variants);
        }
      }
      choice.view.reset();
    }
  }

  [[noreturn]] void too_many() const {
    throw InputError(document_.tree.where("axes") + ": more than " + std::to_string(max_cases) +
                     " cases (take values or views away, or split the experiment)");
  }

  /// The axes of one role from `begin` to `end` as digits of `number`, the first axis outermost.
  void choose(Choice& choice, std::size_t begin, std::size_t end, bool variant, std::size_t number) const {
    for (std::size_t a = end; a-- > begin;) {
      if (axes_[a].variant != variant) continue;
      choice.value[a] = number % axes_[a].count();
      number /= axes_[a].count();
    }
  }

  /// How many views the camera of the choice stands for. An axis that decides which views there are says so itself.
  std::size_t views_of(const Choice& choice) {
    const std::size_t views = asked_views(trees_.of_case(choice, problems_));
    for (std::size_t a = 0; a < axes_.size() && views > 0; ++a) {
      for (const AxisKey& k : axes_[a].keys) {
        if (axes_[a].variant && decides_views(k.key)) return 0;  // refuse_open_views has the words
        if (k.key == view_key)
          throw InputError(document_.tree.where(k.values[choice.value[a]].source) +
                           ": null stands for all views, which are an axis of their own; give the index of a view");
      }
    }
    return views;
  }

  struct ChosenKey {
    AxisChoice choice;
    bool variant;
  };

  /// What the choice says of every key, in running order.
  std::vector<ChosenKey> chosen(const Choice& choice) const {
    std::vector<ChosenKey> keys;
    for (std::size_t a = 0; a <= axes_.size(); ++a) {
      if (a == outer_ && choice.view)
        keys.push_back({{view_key, view_label(*choice.view, views_), axes_.size()}, false});
      if (a == axes_.size()) break;
      for (const AxisKey& k : axes_[a].keys)
        keys.push_back({{k.key, k.values[choice.value[a]].label, a}, axes_[a].variant});
    }
    return keys;
  }

  /// True for the keys that vary together with `panel`, whose word names the case.
  bool named_by_panel(const AxisChoice& c) const {
    return c.key != "panel" && c.axis < axes_.size() &&
           std::any_of(axes_[c.axis].keys.begin(), axes_[c.axis].keys.end(),
                       [](const AxisKey& k) { return k.key == "panel"; });
  }

  void plan_permutation(Choice& choice, std::size_t variants) {
    choose(choice, 0, axes_.size(), true, 0);
    const auto references = plan_references(choice);
    const std::size_t first = experiment_.cases.size();
    for (std::size_t v = 0; v < variants; ++v) {
      choose(choice, 0, axes_.size(), true, v);
      PlannedCase c;
      std::vector<std::string> words;
      for (ChosenKey& k : chosen(choice)) {
        if (!named_by_panel(k.choice)) words.push_back(k.choice.key + "=" + k.choice.label);
        c.choices.push_back(std::move(k.choice));
      }
      c.id = unique_id(words.empty() ? "case" : join_words(words, ","));
      c.first_variant = first;
      c.references = references;
      resolve(trees_.of_case(choice, problems_), words.empty() ? document_.name : document_.name + "." + c.id, c);
      experiment_.cases.push_back(std::move(c));
    }
  }

  std::vector<std::pair<std::string, std::size_t>> plan_references(const Choice& choice) {
    std::vector<std::pair<std::string, std::size_t>> found;
    const ConfigJson* references = document_.tree.find("reference");
    if (references == nullptr || !references_read_) return found;
    for (const auto& [name, patch] : references->items()) {
      const std::vector<std::string> decided = trees_.decided_by_reference(name);
      PlannedCase c;
      c.reference_name = name;
      std::vector<std::string> words = {"reference=" + name};
      for (ChosenKey& k : chosen(choice)) {
        if (decides(decided, k.choice.key)) continue;
        if (!k.variant) words.push_back(k.choice.key + "=" + k.choice.label);
        c.choices.push_back(std::move(k.choice));
      }
      // Permutations that differ only in what the patch decides share one reference.
      const std::string key = join_words(words, ",");
      auto known = references_.find(key);
      if (known == references_.end()) {
        known = references_.emplace(key, experiment_.cases.size()).first;
        c.id = unique_id(key);
        c.first_variant = experiment_.cases.size();
        resolve(trees_.of_reference(choice, name, problems_), document_.name + "." + c.id, c);
        experiment_.cases.push_back(std::move(c));
      }
      found.emplace_back(name, known->second);
    }
    return found;
  }

  void resolve(const ConfigTree& tree, const std::string& name, PlannedCase& c) {
    resolve_planned(tree, document_.base_folder, registry_, c, problems_);
    c.resolved.config["name"] = name;
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
  std::vector<Axis> axes_;
  bool references_read_ = true;
  std::size_t outer_ = 0;  // the first axes, which run outside the views of an orbit
  std::size_t views_ = 0;  // of the orbit that is being planned
  CaseTrees trees_;
  Problems problems_;
  Experiment experiment_;
  std::map<std::string, std::size_t> references_;
  std::set<std::string> ids_;
};

}  // namespace

Experiment plan_experiment(const ConfigDocument& document, const Registry& registry) {
  return Planner(document, registry).plan();
}

}  // namespace dvrlab
