#include "framework/config/key_check.h"

#include "framework/config/check_value.h"

namespace dvrlab {
namespace {

/// True for sections whose keys are key paths or free names. `at`: the keys that lead there from the config's root.
bool names_freely(const std::vector<std::string>& at) {
  if (at.empty()) return false;
  if (at[0] == "axes") return at.size() == 2 || (at.size() == 4 && at[2] == "zip");
  if (at[0] == "reference") return at.size() <= 2;  // a reference's name may have dots
  return at[0] == "expect" && at.size() == 3 && at[2] == "where";
}

class KeyCheck {
 public:
  KeyCheck(const ConfigTree& tree, Problems& problems) : tree_(tree), problems_(problems) {}

  void walk(const ConfigJson& value, const std::string& path) {
    if (value.is_object()) {
      const bool free = names_freely(at_);
      for (const auto& [key, inner] : value.items()) {
        const std::string here = child_path(path, key);
        if (key.empty()) {
          // At the top the path is empty too, and the place ends with its colon already.
          problems_.add(tree_.where(here) + (here.empty() ? "" : ": ") + "found the key \"\"; a key has a name");
        } else if (!free && key.find_first_of(".[") != std::string::npos) {
          problems_.add(tree_.where(here) + ": found the key " + short_text(key) +
                        "; key paths are possible in axes, reference, where and --set only (write sections within "
                        "sections)");
        } else {
          enter(key, inner, here);
        }
      }
    } else if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) enter("[]", value[i], child_path(path, i));
    }
  }

 private:
  void enter(const std::string& step, const ConfigJson& value, const std::string& path) {
    if (!value.is_structured()) return;
    at_.push_back(step);
    walk(value, path);
    at_.pop_back();
  }

  const ConfigTree& tree_;
  Problems& problems_;
  std::vector<std::string> at_;
};

}  // namespace

void check_keys(const ConfigTree& tree, const std::string& config, Problems& problems) {
  const ConfigJson* root = config.empty() ? &tree.root : tree.find(config);
  if (root != nullptr) KeyCheck(tree, problems).walk(*root, config);
}

}  // namespace dvrlab
