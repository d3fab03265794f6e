// The NIfTI reader: .nii and .nii.gz, one 3-D scalar volume. nifticlib interprets the header; the voxels are read
// here, because the library replaces NaN by 0 without a word.
#include <algorithm>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/gzip.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/sha256.h"
#include "plugins/data/nifti/nifti_header.h"

namespace dvrlab::nifti {
namespace {

constexpr Parameter parameters[] = {
    {"file", ParameterType::text, "", nullptr, "",
     "The .nii or .nii.gz file, relative to the config's folder; ${NAME} reads the environment.", Affects::pixels, "{}",
     R"("../../../data/sphere_int16.nii.gz")"}};

struct Opened {
  std::string name;
  std::shared_ptr<const MappedFile> file;
  bool gzip;
  NiftiHeader header;
};

Opened open(const ParameterSet& p, const LoadContext& context) {
  Opened o;
  o.name = resolve_path(p.text("file"), context, p.path_of("file"));
  o.file = MappedFile::open(o.name);
  const auto bytes = o.file->bytes();
  o.gzip = is_gzip(bytes);
  std::array<std::byte, header_size> start;
  std::size_t size = std::min(bytes.size(), start.size());
  if (o.gzip)
    size = gunzip(bytes, 0, start, o.name);
  else
    std::copy_n(bytes.begin(), size, start.begin());
  o.header = read_header(std::span(start).first(size), o.name);
  return o;
}

[[noreturn]] void truncated(const std::string& name, std::uint64_t wanted, std::uint64_t found) {
  throw InputError(name + ": the header announces " + std::to_string(wanted) + " bytes of voxels, the data holds " +
                   std::to_string(found) + "; the file is cut off or its header is wrong");
}

// The voxels in the file's type and byte order: in the mapped file itself, or decompressed.
std::shared_ptr<const void> voxel_bytes(const Opened& o) {
  const std::uint64_t wanted = grid_bytes(o.header.dims, bytes_of(o.header.type), o.name);
  const std::uint64_t offset = o.header.voxel_offset;
  const auto bytes = o.file->bytes();
  const std::uint64_t limit = o.gzip ? gunzip_limit(bytes.size()) : bytes.size();
  const std::uint64_t most = limit - std::min(limit, offset);
  if (most < wanted) truncated(o.name, wanted, most);
  if (!o.gzip) return {o.file, bytes.data() + offset};
  const auto memory = allocate_voxels(wanted, o.name);
  const std::uint64_t found = gunzip(bytes, offset, {static_cast<std::byte*>(memory.get()), wanted}, o.name);
  if (found < wanted) truncated(o.name, wanted, found);
  return memory;
}

class Nifti : public DataPlugin {
 public:
  bool recognises(const std::string& path, std::span<const std::byte>) const override {
    return path.ends_with(".nii") || path.ends_with(".nii.gz");
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const auto grid = std::make_shared<GridField>();
    for (std::size_t a = 0; a < 3; ++a) grid->dims[a] = static_cast<int>(o.header.dims[a]);
    grid->to_world = o.header.to_world;
    grid->slope = o.header.slope;
    grid->intercept = o.header.intercept;
    grid->source = o.name;
    grid->notes = o.header.notes;
    grid->anatomical = true;
    grid->length_unit = "mm";
    grid->sha256 = sha256({o.file->bytes()});
    set_voxels(*grid, {o.header.type, o.header.swap, voxel_bytes(o)}, o.name);
    finish_grid(*grid, context.nan_policy, context.nan_value);
    return grid;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const override {
    const Opened o = open(p, context);
    const std::uint64_t stored = grid_bytes(o.header.dims, bytes_of(o.header.type), o.name);
    return (o.gzip ? stored : 0) + set_voxels_bytes(o.header.type, o.header.swap, stored / bytes_of(o.header.type));
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "nifti", "1.0.0", Nifti, parameters,
              "Reads one 3-D scalar volume from a NIfTI file, .nii or .nii.gz, with its scaling and affine.",
              "Cox et al., NIfTI-1 data format, Human Brain Mapping 2004; https://nifti.nimh.nih.gov")

}  // namespace dvrlab::nifti
