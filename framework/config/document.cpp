#include "framework/config/document.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "framework/config/environment.h"
#include "framework/config/json_reader.h"
#include "framework/config/override.h"
#include "framework/config/words.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace fs = std::filesystem;
namespace {

std::string read_text(const std::string& file, const std::string& where) {
  std::error_code ec;
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file, ec))
    throw InputError(where + "cannot read the config '" + file + "' (does it exist?)");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A result file's `config` section is a config; its places stay those in the result file.
ConfigTree config_of(ConfigTree tree) {
  if (!tree.root.contains("config") || !tree.root.contains("report") || !tree.root["config"].is_object()) return tree;
  ConfigTree inner;
  inner.merge(tree, "config", tree.root["config"]);
  return inner;
}

class Loader {
 public:
  explicit Loader(Problems& problems) : problems_(problems) {}

  ConfigTree read(const std::string& text, const std::string& file, const std::string& folder) {
    ConfigTree written = read_json(text, file, problems_);
    problems_.raise();
    if (!written.root.is_object()) throw InputError(file + ": a config is a section {...}, this is something else");
    written = config_of(std::move(written));
    for (const auto& [key, value] : written.root.items()) {
      if (key.find_first_of(".[") != std::string::npos) {
        problems_.add(written.where(key) +
                      ": key paths are possible in axes, reference and --set only; write sections within sections");
      }
    }
    problems_.raise();
    ConfigTree tree;
    for (const auto& [name, where] : included(written)) include(tree, name, folder, where);
    written.root.erase("include");
    written.root.erase("$schema");  // for editors (docs/editor.md)
    tree.merge(written, "", written.root);
    return tree;
  }

 private:
  /// Names of files, and where they were written.
  static std::vector<std::pair<std::string, std::string>> included(const ConfigTree& tree) {
    const ConfigJson* include = tree.find("include");
    if (include == nullptr) return {};
    const ConfigJson list = include->is_array() ? *include : ConfigJson::array({*include});
    std::vector<std::pair<std::string, std::string>> names;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string where = tree.where(include->is_array() ? child_path("include", i) : "include");
      if (!list[i].is_string()) throw InputError(where + ": must be a file's name or a list of them");
      names.emplace_back(expand_environment(list[i].get<std::string>(), where), where);
    }
    return names;
  }

  void include(ConfigTree& tree, const std::string& name, const std::string& folder, const std::string& where) {
    const fs::path path = fs::path(name).is_absolute() ? fs::path(name) : fs::path(folder) / name;
    const std::string key = fs::weakly_canonical(path).string();
    if (std::find(open_.begin(), open_.end(), key) != open_.end()) {
      throw InputError(where + ": '" + name + "' includes itself: " + join_words(open_, " -> ") + " -> " + key);
    }
    open_.push_back(key);
    const std::string text = read_text(path.string(), where + ": ");
    const ConfigTree fragment = read(text, path.string(), path.parent_path().string());
    tree.merge(fragment, "", fragment.root);
    open_.pop_back();
  }

  Problems& problems_;
  std::vector<std::string> open_;  // the files that are being read, outermost first
};

}  // namespace

ConfigDocument parse_document(const std::string& text, const std::string& file, const std::string& base_folder,
                              const std::vector<std::string>& set) {
  Problems problems;
  ConfigDocument document;
  document.file = file;
  document.tree = Loader(problems).read(text, file, base_folder);
  for (const std::string& assignment : set) override_key(document.tree, assignment);
  const auto text_at = [&](const char* key) {
    const ConfigJson* value = document.tree.find(key);
    return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
  };
  const std::string moved = expand_environment(text_at("base_folder"), document.tree.where("base_folder"));
  document.base_folder = fs::weakly_canonical(fs::absolute(base_folder.empty() ? "." : base_folder) / moved).string();
  document.name = text_at("name").empty() ? fs::path(file).stem().string() : text_at("name");
  return document;
}

ConfigDocument load_document(const std::string& file, const std::vector<std::string>& set) {
  return parse_document(read_text(file, ""), file, fs::path(file).parent_path().string(), set);
}

}  // namespace dvrlab
