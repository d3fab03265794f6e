#include "framework/config/document.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "framework/config/environment.h"
#include "framework/config/json_reader.h"
#include "framework/config/key_check.h"
#include "framework/config/override.h"
#include "framework/config/words.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t most_bytes = 16 << 20;
constexpr int most_includes = 1000;

std::string read_text(const std::string& file, const std::string& where) {
  std::error_code ec;
  const fs::file_status status = fs::status(file, ec);
  // A pipe may wait for ever, a device may never end.
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw InputError(where + "cannot read the config '" + file + "': it is no regular file");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(where + "cannot read the config '" + file + "' (does it exist?)");
  if (fs::file_size(file, ec) > most_bytes)
    throw InputError(where + "cannot read the config '" + file + "': it is longer than 16 MiB");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool is_result(const ConfigJson& root) {
  return root.contains("config") && root.contains("report") && root["config"].is_object();
}

/// A result file's `config` section is a config; its places stay those in the result file.
ConfigTree config_of(ConfigTree tree) {
  if (!is_result(tree.root)) return tree;
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
    check_keys(written, is_result(written.root) ? "config" : "", problems_);
    problems_.raise();
    written = config_of(std::move(written));
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
    if (++included_ > most_includes)
      throw InputError(where + ": more than " + std::to_string(most_includes) +
                       " includes (a file that is included twice is read twice; include it once)");
    open_.push_back(key);
    const std::string text = read_text(path.string(), where + ": ");
    const ConfigTree fragment = read(text, path.string(), path.parent_path().string());
    tree.merge(fragment, "", fragment.root);
    open_.pop_back();
  }

  Problems& problems_;
  std::vector<std::string> open_;  // the files that are being read, outermost first
  int included_ = 0;               // of all files
};

}  // namespace

ConfigDocument parse_document(const std::string& text, const std::string& file, const std::string& base_folder,
                              const std::vector<std::string>& set) {
  Problems problems;
  ConfigDocument document;
  document.file = file;
  document.tree = Loader(problems).read(text, file, base_folder);
  for (const std::string& assignment : set) override_key(document.tree, assignment);
  check_keys(document.tree, "", problems);
  problems.raise();
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
