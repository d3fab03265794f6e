// A data plugin (DVRLAB_FUZZ_PLUGIN) reads the input as its file. An input may begin with a line of JSON, the
// section's other keys, as formats without a header need them: {"size": [4, 4, 4]}\n...
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "framework/config/resolve.h"
#include "framework/interfaces/field.h"
#include "framework/plugin/registry.h"
#include "framework/scene/mesh/elements.h"
#include "tests/fuzz/fuzz_target.h"

namespace {
using namespace dvrlab;

constexpr std::uint64_t most_bytes = 64 << 20;  // what the framework's limits.memory would allow

/// The keys of the first line when it is a JSON object; it is cut off then.
ConfigJson keys_of(const std::uint8_t*& data, std::size_t& size) {
  const auto* end = std::find(data, data + size, std::uint8_t{'\n'});
  if (size == 0 || *data != '{' || end == data + size) return ConfigJson::object();
  ConfigJson keys = ConfigJson::parse(data, end, nullptr, false);
  if (!keys.is_object()) return ConfigJson::object();
  size -= static_cast<std::size_t>(end + 1 - data);
  data = end + 1;
  return keys;
}

void read(const DataPlugin& plugin, const PluginDescriptor& descriptor, const std::uint8_t* data, std::size_t size) {
  ConfigTree tree;
  tree.root = keys_of(data, size);
  tree.root["file"] = fuzz::input_file(data, size, DVRLAB_FUZZ_COMPANIONS);
  Problems problems;
  nlohmann::json resolved = nlohmann::json::object();
  const ParameterSet parameters =
      resolve_keys(tree, "", {{descriptor.parameters, descriptor.parameters + descriptor.parameter_count}, {}, {}},
                   problems, resolved);
  problems.raise();
  plugin.check(parameters);
  const LoadContext context;
  plugin.recognises(tree.root["file"], std::as_bytes(std::span(data, std::min<std::size_t>(size, 512))));
  const std::uint64_t stated = plugin.bytes_needed(parameters, context);
  if (stated > most_bytes) return;
  const auto field = plugin.load(parameters, context);
  const auto* grid = dynamic_cast<const GridField*>(field.get());
  // Every announced voxel must be readable.
  volatile double sum = 0;
  if (grid != nullptr)
    for (const int k : {0, grid->dims[2] - 1})
      for (int j = 0; j < grid->dims[1]; ++j) sum = sum + grid->at(0, j, k) + grid->at(grid->dims[0] - 1, j, k);
  // And every cell of a mesh must have nodes.
  if (const auto* mesh = dynamic_cast<const MeshField*>(field.get()))
    for (std::size_t c = 0; c < mesh->cells(); ++c) sum = sum + evaluate(element_of(*mesh, c), {0.25, 0.25, 0.25})[3];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Registry registry;
  static const PluginEntryInfo& entry = registry.find("data", DVRLAB_FUZZ_PLUGIN);
  static const auto& plugin = registry.get<DataPlugin>("data", DVRLAB_FUZZ_PLUGIN);
  fuzz::expect_result_or_error([&] { read(plugin, *entry.descriptor, data, size); });
  return 0;
}
