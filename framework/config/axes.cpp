#include "framework/config/axes.h"

#include "framework/config/check_value.h"
#include "framework/interfaces/error.h"
#include "framework/plugin/registry.h"

namespace dvrlab {
namespace {

class AxesReader {
 public:
  AxesReader(const ConfigTree& tree, std::vector<std::string>& unread, Problems& problems)
      : tree_(tree), unread_(unread), problems_(problems) {}

  void read_role(const std::string& role, const ConfigJson& section) {
    variant_ = role == "variant";
    const std::string path = child_path("axes", role);
    for (const auto& [key, written] : section.items()) {
      if (key == "zip") {
        read_zips(child_path(path, key), written);
      } else {
        axes_.push_back({variant_, {}});
        add_key(child_path(path, key), key, written);
      }
    }
  }

  std::vector<Axis> take() {
    std::erase_if(axes_, [](const Axis& axis) { return axis.keys.empty(); });
    return std::move(axes_);
  }

 private:
  /// "" or why the key cannot be varied.
  static std::string wrong_key(const std::string& key) {
    if (const std::string wrong = wrong_path(key); !wrong.empty()) return wrong;
    for (const char* whole : {"name", "schema", "base_folder", "include", "axes", "reference", "expect"}) {
      if (lies_in(key, whole)) return "an axis cannot change this key: it is one for all cases";
    }
    return "";
  }

  void bad(const std::string& path, const std::string& what) { problems_.add(tree_.where(path) + ": " + what); }

  /// A further key of the last axis; false when it cannot be one.
  bool add_key(const std::string& path, const std::string& key, const ConfigJson& written) {
    for (const Axis& axis : axes_) {
      for (const AxisKey& known : axis.keys) {
        if (known.key == key) bad(path, "the key is an axis twice (a key is a permutation or a variant, in one place)");
      }
    }
    const std::string wrong = wrong_key(key);
    if (!wrong.empty()) bad(path, wrong);
    AxisKey read{key, axis_values(tree_, path, written, problems_)};
    const bool good = wrong.empty() && !read.values.empty();
    if (good) axes_.back().keys.push_back(std::move(read));
    if (!good) unread_.push_back(key);
    return good;
  }

  void read_zips(const std::string& path, const ConfigJson& list) {
    const char* right =
        R"(; must be a list of sections of key path -> values, e.g. [{"seed": [1, 2], "repeat": [5, 3]}])";
    if (!list.is_array() || list.empty()) {
      unread_.push_back("zip");
      return bad(path, "found " + short_text(list) + right);
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string here = child_path(path, i);
      if (list[i].is_object() && !list[i].empty()) {
        read_zip(here, list[i]);
      } else {
        unread_.push_back("zip");
        bad(here, "found " + short_text(list[i]) + right);
      }
    }
  }

  void read_zip(const std::string& path, const ConfigJson& section) {
    axes_.push_back({variant_, {}});
    for (const auto& [key, written] : section.items()) {
      if (!add_key(child_path(path, key), key, written)) continue;
      const AxisKey &first = axes_.back().keys.front(), &last = axes_.back().keys.back();
      if (first.values.size() == last.values.size()) continue;
      bad(child_path(path, key), "found " + std::to_string(last.values.size()) + " values; must be " +
                                     std::to_string(first.values.size()) + ", as many as those of '" + first.key +
                                     "': the keys of a zip vary together");
    }
  }

  const ConfigTree& tree_;
  std::vector<std::string>& unread_;
  Problems& problems_;
  bool variant_ = false;
  std::vector<Axis> axes_;
};

}  // namespace

std::vector<Axis> read_axes(const ConfigTree& tree, std::vector<std::string>& unread, Problems& problems) {
  const ConfigJson* section = tree.find("axes");
  if (section == nullptr) return {};
  if (!section->is_object()) {
    unread.push_back("axes");
    problems.add(tree.where("axes") + ": found " + short_text(*section) +
                 "; must be a section with permutation and variant");
    return {};
  }
  for (const auto& [role, keys] : section->items()) {
    if (role != "permutation" && role != "variant") {
      for (const auto& [key, values] : keys.items()) unread.push_back(key);
      problems.add(tree.where_key("axes." + role) + ": unknown key '" + role + "'" +
                   did_you_mean(role, {"permutation", "variant"}) + "; legal: permutation, variant");
    } else if (!keys.is_object()) {
      unread.push_back("axes");
      problems.add(tree.where("axes." + role) + ": found " + short_text(keys) +
                   "; must be a section of key path -> values");
    }
  }
  AxesReader reader(tree, unread, problems);
  for (const char* role : {"permutation", "variant"}) {
    if (section->contains(role) && (*section)[role].is_object()) reader.read_role(role, (*section)[role]);
  }
  return reader.take();
}

}  // namespace dvrlab
