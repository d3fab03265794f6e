// The `my_data` reader: a volume written as text, "TEXTVOL nx ny nz" and then nx * ny * nz numbers, x fastest.
#include <fstream>
#include <iterator>
#include <sstream>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/sha256.h"

namespace dvrlab::my_data {
namespace {

using enum ParameterType;

const Parameter parameters[] = {
    {"file", text, "", nullptr, "", "The file.", Affects::pixels},
    {"spacing", vector3, "world", "[1,1,1]", "(0,inf)", "Distance between grid points.", Affects::pixels, "",
     "[1,1,2]"},
};

constexpr char magic[] = "TEXTVOL";

std::string path_of(const ParameterSet& p, const LoadContext& context) {
  return resolve_path(p.text("file"), context, p.path_of("file"));
}

std::array<int, 3> read_header(std::istream& in, const std::string& file) {
  std::string word;
  std::array<int, 3> dims{};
  in >> word >> dims[0] >> dims[1] >> dims[2];
  if (!in || word != magic) throw InputError(file + ":1: must begin with " + magic + " nx ny nz");
  for (const int n : dims)
    if (n < 2 || n > 4096)
      throw InputError(file + ":1: found " + std::to_string(n) + " grid points; 2 to 4096 are read");
  return dims;
}

class MyData : public DataPlugin {
 public:
  bool recognises(const std::string&, std::span<const std::byte> start) const override {
    const std::string word(reinterpret_cast<const char*>(start.data()), std::min<std::size_t>(start.size(), 7));
    return word == magic;
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const std::string file = path_of(p, context);
    std::ifstream bytes(file, std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(bytes), std::istreambuf_iterator<char>()};
    std::istringstream in(all);
    const auto grid = std::make_shared<GridField>();
    grid->dims = read_header(in, file);
    grid->type = VoxelType::f32;
    // Every number takes two bytes at the least: a header that promises more is not believed.
    if (grid->count() > all.size() / 2 + 1) throw too_short(file, grid->count(), "fewer");
    const auto voxels = std::make_shared<std::vector<float>>(grid->count());
    for (std::size_t i = 0; i < voxels->size(); ++i)
      if (!(in >> (*voxels)[i])) throw too_short(file, grid->count(), std::to_string(i));
    std::string rest;
    if (in >> rest) throw InputError(file + ": found '" + rest.substr(0, 20) + "' behind the last number");
    grid->voxels = {voxels, voxels->data()};
    const Vector3 spacing = p.vector3("spacing");
    for (std::size_t a = 0; a < 3; ++a) grid->to_world.m[4 * a] = spacing[a];
    grid->source = file;
    grid->sha256 = sha256({std::as_bytes(std::span(all))});
    finish_grid(*grid, context.nan_policy, context.nan_value);
    return grid;
  }

  // The file's text and the voxels.
  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const override {
    const std::string file = path_of(p, context);
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    const std::uint64_t size = std::uint64_t(in.tellg());
    in.seekg(0);
    const std::array<int, 3> n = read_header(in, file);
    return 2 * size + 4 * std::uint64_t(n[0]) * std::uint64_t(n[1]) * std::uint64_t(n[2]);
  }

 private:
  static InputError too_short(const std::string& file, std::uint64_t wanted, const std::string& found) {
    return InputError(file + ": found " + found + " numbers; the header promises " + std::to_string(wanted));
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "my_data", "0.1", MyData, parameters, "a volume written as text: TEXTVOL nx ny nz and numbers",
              "")

}  // namespace dvrlab::my_data
