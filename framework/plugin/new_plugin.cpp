#include "framework/plugin/new_plugin.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "framework/config/words.h"
#include "framework/interfaces/error.h"
#include "framework/plugin/open_library.h"

namespace dvrlab {
namespace fs = std::filesystem;
namespace {

/// The name becomes a namespace in C++, and the prefix of uniforms in C++ and GLSL.
const std::vector<std::string>& taken_words() {
  static const std::vector<std::string> words = split_words(
      "alignas|alignof|and|and_eq|asm|auto|bitand|bitor|bool|break|case|catch|char|class|compl|concept|const|consteval|"
      "constexpr|constinit|continue|decltype|default|delete|do|double|else|enum|explicit|export|extern|false|float|for|"
      "friend|goto|if|inline|int|long|mutable|namespace|new|noexcept|not|not_eq|nullptr|operator|or|or_eq|private|"
      "protected|public|register|requires|return|short|signed|sizeof|static|struct|switch|template|this|throw|true|try|"
      "typedef|typeid|typename|union|unsigned|using|virtual|void|volatile|while|xor|xor_eq|"
      // Prefixes of the framework's own uniforms, and of GLSL.
      "frame|medium|gl|dvr|dvrlab|std");
  return words;
}

/// "phase_function" -> "PhaseFunction"
std::string class_name(const std::string& name) {
  std::string camel;
  for (const std::string& word : split_words(name, '_')) {
    camel += word.substr(0, 1);
    if (!word.empty()) camel.back() = static_cast<char>(std::toupper(static_cast<unsigned char>(camel.back())));
    camel += word.empty() ? "" : word.substr(1);
  }
  return camel;
}

using Replacements = std::vector<std::pair<std::string, std::string>>;

std::string replaced(std::string text, const Replacements& replacements) {
  for (const auto& [from, to] : replacements) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  }
  return text;
}

void copy_text(const fs::path& from, const fs::path& to, const Replacements& replacements) {
  std::ifstream in(from, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::ofstream out(to, std::ios::binary);
  out << replaced(text, replacements);
  out.close();
  if (!in || !out) throw NotSupported("cannot write " + to.string() + " (is the folder writable, the disk full?)");
}

/// The source tree of dvrlab that holds the current folder; "" when there is none.
fs::path source_tree() {
  for (fs::path folder = fs::current_path(); folder != folder.root_path(); folder = folder.parent_path()) {
    if (fs::exists(folder / "framework/interfaces/plugin.h") && fs::exists(folder / "plugins/_template")) return folder;
  }
  return {};
}

void check_kind(const std::string& kind) {
  const std::vector<std::string> kinds(std::begin(plugin_kinds), std::end(plugin_kinds));
  if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) return;
  throw InputError("new-plugin: there is no kind '" + kind + "'" + did_you_mean(kind, kinds) + "; there are " +
                   join_words(kinds));
}

void check_name(const std::string& kind, const std::string& name, const Registry& registry) {
  const std::string wrong = wrong_plugin_name(name);
  if (!wrong.empty()) throw InputError("new-plugin: " + wrong);
  for (const PluginEntryInfo& e : registry.entries()) {
    if (e.kind == kind && e.name == name)
      throw InputError("new-plugin: there is a plugin " + kind + " '" + name + "' already (" + e.folder +
                       "); choose another name");
  }
}

}  // namespace

std::string wrong_plugin_name(const std::string& name) {
  const bool letters = !name.empty() && name.front() >= 'a' && name.front() <= 'z' &&
                       name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
  if (!letters)
    return "'" + name + "' cannot name a plugin; a name begins with a small letter and has small letters, digits and _";
  if (name.find("__") != std::string::npos || name.back() == '_')
    return "'" + name +
           "' cannot name a plugin: GLSL keeps names with two _ in a row; use single ones, none at the end";
  const std::vector<std::string>& taken = taken_words();
  if (std::find(taken.begin(), taken.end(), name) != taken.end())
    return "'" + name + "' cannot name a plugin: the word belongs to C++, GLSL or dvrlab itself; choose another name";
  return "";
}

NewPlugin new_plugin(const std::string& kind, const std::string& name, const std::string& out,
                     const Registry& registry) {
  check_kind(kind);
  check_name(kind, name, registry);
  const fs::path templates = fs::path(Registry::home()) / "template", from = templates / kind;
  if (!fs::is_directory(from))
    throw NotSupported("new-plugin: " + from.string() + " is missing (install dvrlab again)");
  NewPlugin made;
  fs::path folder = (out.empty() ? fs::path() : fs::path(out)) / name;
  if (out.empty()) {
    const fs::path tree = source_tree();
    made.in_source_tree = !tree.empty();
    if (made.in_source_tree)
      folder = tree / (kind == "backend" ? fs::path("backends") : fs::path("plugins") / kind) / name;
  }
  std::error_code ec;
  if (fs::exists(fs::symlink_status(folder, ec)))
    throw InputError("new-plugin: " + folder.string() +
                     " exists, and nothing is overwritten; choose another name or --out");
  const Replacements replacements = {{"my_" + kind, name}, {"My" + class_name(kind), class_name(name)}};
  fs::create_directories(folder, ec);
  if (ec) throw InputError("new-plugin: the folder " + folder.string() + " cannot be made: " + ec.message());
  made.folder = folder.string();
  for (const fs::directory_entry& file : fs::directory_iterator(from)) {
    made.files.push_back(replaced(file.path().filename().string(), replacements));
    copy_text(file.path(), folder / made.files.back(), replacements);
  }
  std::sort(made.files.begin(), made.files.end());
  if (!made.in_source_tree) {
    copy_text(templates / "standalone.cmake", folder / "CMakeLists.txt", {{"my_plugin", name}, {"my_kind", kind}});
    made.files.insert(made.files.begin(), "CMakeLists.txt");
  }
  return made;
}

}  // namespace dvrlab
