// The config stage: one file, with what it includes and what the command line overrides.
#pragma once

#include <string>
#include <vector>

#include "framework/config/config_tree.h"

namespace dvrlab {

struct ConfigDocument {
  ConfigTree tree;
  std::string file;         // as it was named
  std::string name;         // the config's `name`, else the file's name without extension
  std::string base_folder;  // absolute: where relative paths start
};

/// Reads a config, or the `config` section of a result file (case.json). `include` names a file or a list of files,
/// relative to the file that includes, which are merged below it. `set`: "key.path=value", where a value that is no
/// JSON is a text; merged over everything. Throws InputError with all that is wrong, one line each.
ConfigDocument load_document(const std::string& file, const std::vector<std::string>& set = {});

/// The same for a text that is at hand. `file` is what places are called; `base_folder` as above.
ConfigDocument parse_document(const std::string& text, const std::string& file, const std::string& base_folder,
                              const std::vector<std::string>& set = {});

}  // namespace dvrlab
