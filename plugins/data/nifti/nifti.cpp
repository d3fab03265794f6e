// The NIfTI reader: .nii and .nii.gz, one 3-D scalar volume. nifticlib interprets the header; the voxels are read
// here, because the library replaces NaN by 0 without a word.
#include <algorithm>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/grid_file.h"
#include "framework/scene/gzip.h"
#include "plugins/data/nifti/nifti_header.h"

namespace dvrlab::nifti {
namespace {

constexpr Parameter parameters[] = {
    {"file", ParameterType::text, "", nullptr, "",
     "The .nii or .nii.gz file, relative to the config's folder; ${NAME} reads the environment.", Affects::pixels, "{}",
     R"("../../../data/sphere_int16.nii.gz")"}};

// The first bytes, decompressed where they are not plain; fewer at the end of the file.
std::vector<std::byte> start_of(std::span<const std::byte> bytes, std::size_t wanted, const std::string& name) {
  std::vector<std::byte> start(wanted);
  std::size_t size = std::min(bytes.size(), wanted);
  if (is_gzip(bytes))
    size = gunzip(bytes, 0, start, name);
  else
    std::copy_n(bytes.begin(), size, start.begin());
  start.resize(size);
  return start;
}

class Nifti : public GridFilePlugin {
 public:
  bool recognises(const std::string& path, std::span<const std::byte> start) const override {
    if (path.ends_with(".nii") || path.ends_with(".nii.gz")) return true;
    try {
      return has_magic(start_of(start, header_size, path));
    } catch (const InputError&) {  // a gzip file of something else, cut in its first block
      return false;
    }
  }

 private:
  GridFile open(const ParameterSet& p, const LoadContext& context) const override {
    GridFile file;
    file.name = resolve_path(p.text("file"), context, p.path_of("file"));
    file.header = MappedFile::open(file.name);
    const auto bytes = file.header->bytes();
    NiftiHeader h = read_header(start_of(bytes, header_size, file.name), file.name);
    file.type = h.type;
    file.swap = h.swap;
    file.dims = h.dims;
    file.to_world = h.to_world;
    file.anatomical = h.anatomical;
    file.length_unit = h.length_unit;
    file.slope = h.slope;
    file.intercept = h.intercept;
    file.notes = std::move(h.notes);
    file.encoding = is_gzip(bytes) ? Encoding::gzip : Encoding::raw;
    file.skip = h.voxel_offset;
    file.parts = {{file.header, bytes}};
    return file;
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "nifti", "1.1.0", Nifti, parameters,
              "Reads one 3-D scalar volume from a NIfTI file, .nii or .nii.gz, with its scaling and affine.",
              "Cox et al., NIfTI-1 data format, Human Brain Mapping 2004; https://nifti.nimh.nih.gov")

}  // namespace dvrlab::nifti
