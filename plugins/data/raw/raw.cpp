// The raw reader: voxels and nothing else in a file, x fastest; the config declares what they are.
#include <bit>
#include <nlohmann/json.hpp>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/grid_file.h"
#include "framework/scene/gzip.h"
#include "plugins/data/raw/size_check.h"

namespace dvrlab::raw {
namespace {

using enum ParameterType;
constexpr Affects pixels = Affects::pixels;

// In the order of SourceType.
constexpr const char* voxel_types = "int8|uint8|int16|uint16|int32|uint32|int64|uint64|float32|float64";

constexpr Parameter parameters[] = {
    {"file", text, "", nullptr, "", "The file, relative to the config's folder; ${NAME} reads the environment.",
     pixels},
    {"size", integer3, "voxels", nullptr, "[2,2147483647]", "Number of voxels along x, y, z; x varies fastest.", pixels,
     "", "[16, 24, 32]"},
    {"voxel_type", choice, "", nullptr, voxel_types, "The number type of a voxel.", pixels, "", "\"int8\""},
    {"byte_order", choice, "", "\"little\"", "little|big", "Of voxels of more than one byte.", pixels,
     R"({"data": {"voxel_type": "uint16", "size": [24, 16, 16]}})", "\"big\""},
    {"spacing", vector3, "world units", "[1, 1, 1]", "(0,inf)", "Distance between grid points along x, y, z.", pixels,
     "", "[1, 1, 2]"},
    {"origin", vector3, "world units", "[0, 0, 0]", "", "World position of the first voxel.", pixels,
     R"({"camera": {"frame": "world", "position": [60, 70, 50], "target": [12, 8, 16]}})", "[3, 0, 5]"},
    {"skip_bytes", json, "bytes", "null", "null or a whole number from 0 on",
     "Bytes in front of the voxels, such as another program's header; what follows the voxels is then not used. null: "
     "the file holds the voxels and nothing else, and its size must fit.",
     pixels, R"({"data": {"size": [24, 16, 16], "skip_bytes": 0}})", "3072", "",
     R"({"type": ["integer", "null"], "minimum": 0})"},
    {"slope", number, "value", "1", "", "Physical value = slope * stored + intercept; not 0.", pixels, "", "0.5"},
    {"intercept", number, "value", "0", "", "Physical value = slope * stored + intercept.", pixels, "", "20"}};

std::array<long long, 3> dims_of(const ParameterSet& p) {
  const auto n = p.integer3("size");
  return {n[0], n[1], n[2]};
}

std::optional<std::uint64_t> skip_of(const ParameterSet& p) {
  const nlohmann::json& skip = p.json("skip_bytes");
  if (skip.is_null()) return std::nullopt;
  if (!skip.is_number_integer() || skip < 0)
    throw InputError(p.path_of("skip_bytes") + ": " + skip.dump() + " must be null or a whole number from 0 on");
  return skip.get<std::uint64_t>();
}

class Raw : public GridFilePlugin {
 public:
  void check(const ParameterSet& p) const override {
    grid_bytes(dims_of(p), bytes_of(static_cast<SourceType>(p.choice_index("voxel_type"))), p.path_of("size"));
    skip_of(p);
    if (p.number("slope") == 0)
      throw InputError(p.path_of("slope") + ": is 0, so every value would be the same; must be another number");
  }

 private:
  GridFile open(const ParameterSet& p, const LoadContext& context) const override {
    GridFile file;
    file.name = resolve_path(p.text("file"), context, p.path_of("file"));
    file.type = static_cast<SourceType>(p.choice_index("voxel_type"));
    file.swap = (p.text("byte_order") == "little") != (std::endian::native == std::endian::little);
    file.dims = dims_of(p);
    const Vector3 spacing = p.vector3("spacing");
    for (std::size_t a = 0; a < 3; ++a) file.to_world.m[4 * a] = spacing[a];
    file.to_world.t = p.vector3("origin");
    file.slope = p.number("slope");
    file.intercept = p.number("intercept");
    file.header = MappedFile::open(file.name);
    const auto bytes = file.header->bytes();
    file.skip = skip_of(p).value_or(0);
    file.parts = {{file.header, bytes}};
    if (const std::string wrong = wrong_size({file.dims, file.type, skip_of(p)}, bytes.size()); !wrong.empty())
      throw InputError(
          file.name + ": " +
          (is_gzip(bytes) ? "is compressed by gzip: decompress it, or give it a NRRD header; as it is, " : "") + wrong);
    return file;
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "raw", "1.0.0", Raw, parameters,
              "Reads voxels from a file without a header; the config declares their size, type and place.", "")

}  // namespace dvrlab::raw
