#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/app/verbs.h"
#include "framework/config/words.h"
#include "framework/plugin/new_plugin.h"

namespace dvrlab {
namespace {

namespace fs = std::filesystem;

/// The shortest way to say where a file is.
std::string shown(const fs::path& file) {
  const std::string relative = fs::proximate(file).string(), full = fs::absolute(file).string();
  return relative.size() < full.size() ? relative : full;
}

/// What its author does next, as commands.
std::vector<std::string> next_commands(const NewPlugin& made, const std::string& kind, const std::string& name) {
  const fs::path lib = fs::path(Registry::home()).parent_path();
  const std::string program = shown(lib.parent_path() / "bin/dvrlab"), folder = shown(made.folder);
  const std::string example = folder + "/" + name + ".example.json";
  const std::string test = " -R '" + kind + "[.]" + name + "'";
  if (made.in_source_tree) {
    return {"./dev format && ./dev build", program + " render " + example + " -o " + name + ".png",
            "./dev test" + test};
  }
  return {"cmake -S " + folder + " -B " + folder + "/build -Ddvrlab_DIR=" + (lib / "cmake/dvrlab").string(),
          "cmake --build " + folder + "/build",
          program + " --plugin-path " + folder + "/build/plugins render " + example + " -o " + name + ".png",
          "ctest --test-dir " + folder + "/build" + test};
}

}  // namespace

int new_plugin_verb(const Options& o) {
  const Registry registry(o.plugin_path);
  const NewPlugin made = new_plugin(o.name, o.a, o.out_folder, registry);
  const std::vector<std::string> next = next_commands(made, o.name, o.a);
  if (o.json) {
    const nlohmann::json all = {{"folder", made.folder}, {"files", made.files}, {"next", next}};
    std::printf("%s\n", all.dump(1).c_str());
  }
  std::fprintf(stderr, "plugins: made %s: %s\nnext:\n", shown(made.folder).c_str(), join_words(made.files).c_str());
  for (const std::string& command : next) std::fprintf(stderr, "  %s\n", command.c_str());
  return 0;
}

}  // namespace dvrlab
