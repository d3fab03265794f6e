#include "framework/scene/recognise.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>

#include "framework/config/words.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"

namespace dvrlab {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t start_bytes = 512;

std::vector<std::byte> start_of(const std::string& path) {
  std::error_code ec;
  if (!fs::exists(path, ec)) throw InputError("there is no file or folder '" + path + "'");
  if (fs::is_directory(path, ec)) return {};
  if (!fs::is_regular_file(path, ec)) throw InputError(path + ": is no regular file");  // a pipe may wait for ever
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path + ": cannot be read (are you allowed to?)");
  std::array<char, start_bytes> start;
  in.read(start.data(), start.size());
  const auto bytes = std::as_bytes(std::span(start).first(static_cast<std::size_t>(in.gcount())));
  return {bytes.begin(), bytes.end()};
}

/// The plugin for files that nothing can recognise: its config says what is in them.
constexpr const char* headerless = "raw";

/// The formats that are recognised, for messages; what to do about a file without a header, where that is possible.
std::string formats(const Registry& registry) {
  std::vector<std::string> names;
  bool has_headerless = false;
  for (const PluginEntryInfo& e : registry.entries()) {
    if (e.kind != "data" || e.descriptor == nullptr) continue;
    const PluginDescriptor& d = *e.descriptor;
    const bool reads_files = std::any_of(d.parameters, d.parameters + d.parameter_count,
                                         [](const Parameter& p) { return std::string(p.name) == "file"; });
    if (e.name == headerless) {
      has_headerless = true;
    } else if (reads_files) {
      names.push_back(e.name);
    }
  }
  std::sort(names.begin(), names.end());
  return join_words(names) + " (judged by name and first bytes; --set data.type=TYPE names one)" +
         (has_headerless ? std::string("; a file without a header needs a config with data.type ") + headerless +
                               " (dvrlab describe data." + headerless + ")"
                         : "");
}

}  // namespace

std::vector<std::string> readers_of(const std::string& path, const Registry& registry) {
  const std::vector<std::byte> start = start_of(path);
  std::vector<std::string> names;
  for (const PluginEntryInfo& e : registry.entries()) {
    if (e.kind != "data" || e.descriptor == nullptr) continue;
    try {
      if (registry.get<DataPlugin>("data", e.name).recognises(path, start)) names.push_back(e.name);
    } catch (const NotSupported&) {  // a plugin that cannot be made reads nothing; `dvrlab doctor` says why
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string reader_of(const std::string& path, const Registry& registry) {
  const std::vector<std::string> names = readers_of(path, registry);
  if (names.size() == 1) return names[0];
  if (names.empty()) throw InputError(path + ": no reader recognises it; data is read from " + formats(registry));
  throw InputError(path + ": more than one reader recognises it: " + join_words(names) +
                   "; name one with --set data.type=TYPE, or in a config");
}

}  // namespace dvrlab
