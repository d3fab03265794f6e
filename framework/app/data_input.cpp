#include "framework/app/data_input.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "framework/config/override.h"
#include "framework/config/resolve.h"
#include "framework/interfaces/error.h"
#include "framework/scene/memory_bill.h"
#include "framework/scene/recognise.h"
#include "framework/scene/system_memory.h"

namespace dvrlab {
namespace {

/// Configs begin with a section or a comment, whatever they are called.
bool looks_like_config(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  char c = 0;
  while (in.get(c) && std::isspace(static_cast<unsigned char>(c)) != 0) {
  }
  return in && (c == '{' || c == '/');
}

/// True where the reader is named by hand.
bool names_reader(const std::vector<std::string>& set) {
  return std::any_of(set.begin(), set.end(), [](const std::string& s) { return s.starts_with("data.type="); });
}

}  // namespace

bool names_data(const std::string& path, const std::vector<std::string>& set, const Registry& registry) {
  if (path.ends_with(".json")) return false;
  if (!readers_of(path, registry).empty()) return true;
  std::error_code ec;
  if (!std::filesystem::is_directory(path, ec) && looks_like_config(path)) return false;
  if (!names_reader(set)) reader_of(path, registry);  // says what can be read
  return true;
}

void refuse_data(const std::string& path, const std::vector<std::string>& set, const Registry& registry) {
  if (names_data(path, set, registry))
    throw InputError(path + ": is data; this verb takes a config (dvrlab info " + path +
                     " --starter my.json writes one; dvrlab render takes data too)");
}

ConfigDocument data_document(const std::string& path, const std::vector<std::string>& set, const Registry& registry) {
  ConfigDocument document = parse_document("{}", path, "");
  // These have no place: nobody wrote them.
  if (!names_reader(set)) document.tree.root["data"]["type"] = reader_of(path, registry);
  document.tree.root["data"]["file"] = path;
  for (const std::string& assignment : set) override_key(document.tree, assignment);
  return document;
}

LoadedData load_data(const ConfigDocument& document, const Registry& registry) {
  if (document.tree.find("data") == nullptr)
    throw InputError(document.file +
                     ": has no data section (where an axis decides it, name one with --set 'data={...}')");
  Problems problems;
  const Section section = resolve_data(document.tree, registry, problems);
  problems.raise();
  const ParameterSet& p = section.parameters;
  const LoadContext context{document.base_folder, p.text("nan_policy"), p.number("nan_value")};
  const auto& reader = registry.get<DataPlugin>("data", section.type);
  try {
    MemoryBill memory(0.75 * static_cast<double>(system_memory().available), "75 % of what is available is");
    memory.state("data", static_cast<double>(reader.bytes_needed(p, context)));
    return {section.type, reader.load(p, context), *document.tree.find("data")};
  } catch (const InputError& e) {
    throw InputError(document.tree.located(e.what()));
  }
}

std::string unit_text(const Field& f) { return f.length_unit.empty() ? "world units" : f.length_unit; }

}  // namespace dvrlab
