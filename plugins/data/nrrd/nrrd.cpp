// The NRRD reader: 3-D scalar volumes, attached or detached, raw or gzip, of either byte order.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/gzip.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/sha256.h"
#include "plugins/data/nrrd/nrrd_header.h"

namespace dvrlab::nrrd {
namespace {

constexpr Parameter parameters[] = {
    {"file", ParameterType::text, "", nullptr, "",
     "The .nrrd file or the .nhdr header, relative to the config's folder; ${NAME} reads the environment.",
     Affects::pixels, "{}", R"("../../../data/hydrogenatom.nrrd")"}};

struct Opened {
  std::string name;  // of the file that the config names
  NrrdHeader header;
  std::shared_ptr<const MappedFile> header_file, data_file;  // the same one when attached
};

Opened open(const ParameterSet& p, const LoadContext& context) {
  Opened o;
  o.name = resolve_path(p.text("file"), context, p.path_of("file"));
  o.header_file = MappedFile::open(o.name);
  o.header = read_header(o.header_file->bytes(), o.name);
  o.data_file = o.header_file;
  if (!o.header.data_file.empty()) {
    const auto path = std::filesystem::path(o.name).parent_path() / o.header.data_file;
    if (!std::filesystem::exists(path))
      throw InputError(o.name + ": its data file " + path.string() + " does not exist");
    o.data_file = MappedFile::open(path.string());
  }
  return o;
}

std::span<const std::byte> without_lines(std::span<const std::byte> bytes, long long lines, const std::string& name) {
  for (; lines > 0; --lines) {
    const auto end = std::find(bytes.begin(), bytes.end(), std::byte{'\n'});
    if (end == bytes.end()) throw InputError(name + ": `line skip` drops more lines than the file has");
    bytes = bytes.subspan(static_cast<std::size_t>(end - bytes.begin()) + 1);
  }
  return bytes;
}

[[noreturn]] void truncated(const std::string& name, std::uint64_t wanted, std::uint64_t found) {
  throw InputError(name + ": the header announces " + std::to_string(wanted) + " bytes of voxels, the data holds " +
                   std::to_string(found) + "; the file is cut off or its header is wrong");
}

// The voxels in the file's type and byte order: in the mapped file itself, or decompressed.
std::shared_ptr<const void> voxel_bytes(const Opened& o, std::vector<std::string>& notes) {
  const NrrdHeader& h = o.header;
  const std::uint64_t wanted = grid_bytes(h.dims, bytes_of(h.type), o.name);
  auto bytes = o.data_file->bytes();
  if (h.data_file.empty()) bytes = bytes.subspan(h.header_size);
  bytes = without_lines(bytes, h.line_skip, o.name);
  if (h.gzip) {
    if (gunzip_limit(bytes.size()) < wanted) truncated(o.name, wanted, gunzip_limit(bytes.size()));
    const auto memory = allocate_voxels(wanted, o.name);
    const std::uint64_t found =
        gunzip(bytes, static_cast<std::uint64_t>(h.byte_skip), {static_cast<std::byte*>(memory.get()), wanted}, o.name);
    if (found < wanted) truncated(o.name, wanted, found);
    return memory;
  }
  const std::uint64_t skip = h.byte_skip >= 0 ? static_cast<std::uint64_t>(h.byte_skip)
                                              : bytes.size() - std::min<std::uint64_t>(bytes.size(), wanted);
  bytes = bytes.subspan(std::min<std::uint64_t>(skip, bytes.size()));
  if (bytes.size() < wanted) truncated(o.name, wanted, bytes.size());
  if (bytes.size() > wanted)
    notes.push_back(std::to_string(bytes.size() - wanted) + " bytes behind the voxels are not used");
  return {o.data_file, bytes.data()};
}

class Nrrd : public DataPlugin {
 public:
  bool recognises(const std::string& path, std::span<const std::byte> start) const override {
    constexpr std::string_view magic = "NRRD000";
    return path.ends_with(".nrrd") || path.ends_with(".nhdr") ||
           (start.size() > magic.size() && std::memcmp(start.data(), magic.data(), magic.size()) == 0);
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const auto grid = std::make_shared<GridField>();
    for (std::size_t a = 0; a < 3; ++a) grid->dims[a] = static_cast<int>(o.header.dims[a]);
    grid->to_world = o.header.to_world;
    grid->source = o.name;
    grid->notes = o.header.notes;
    grid->anatomical = o.header.anatomical;
    grid->sha256 = o.data_file == o.header_file ? sha256({o.header_file->bytes()})
                                                : sha256({o.header_file->bytes(), o.data_file->bytes()});
    set_voxels(*grid, {o.header.type, o.header.swap, voxel_bytes(o, grid->notes)}, o.name);
    finish_grid(*grid, context.nan_policy, context.nan_value);
    return grid;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const std::uint64_t stored = grid_bytes(o.header.dims, bytes_of(o.header.type), o.name);
    return (o.header.gzip ? stored : 0) +
           set_voxels_bytes(o.header.type, o.header.swap, stored / bytes_of(o.header.type));
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "nrrd", "1.0.0", Nrrd, parameters,
              "Reads 3-D scalar volumes from NRRD files: .nrrd and .nhdr, raw and gzip, both byte orders.",
              "Teem: Nrrd: definition of the format, https://teem.sourceforge.net/nrrd/format.html")

}  // namespace dvrlab::nrrd
