// What a command line names: a config, or data without one.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "framework/config/document.h"
#include "framework/interfaces/field.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

/// True for a data file or folder, false for a config. Throws InputError when it is neither, or not there. A file that
/// nobody recognises is data where one of `set` names its reader, data.type.
bool names_data(const std::string& path, const std::vector<std::string>& set, const Registry& registry);

/// For verbs that need a config. Throws InputError for data, saying how a config is made from it.
void refuse_data(const std::string& path, const std::vector<std::string>& set, const Registry& registry);

/// A document with nothing but the data section that reads `path`, by the reader that `set` names or recognised.
ConfigDocument data_document(const std::string& path, const std::vector<std::string>& set, const Registry& registry);

struct LoadedData {
  std::string type;  // of the data section
  std::shared_ptr<const Field> field;
  nlohmann::ordered_json section;  // as it was given
};

/// Loads what the document's data section says; the rest of the document is not read. Throws InputError, or
/// NotSupported when the memory is too small.
LoadedData load_data(const ConfigDocument& document, const Registry& registry);

/// The unit of the field's lengths: "mm", or "world units" where it is not known.
std::string unit_text(const Field& field);

}  // namespace dvrlab
