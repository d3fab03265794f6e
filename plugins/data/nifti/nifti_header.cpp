#include "plugins/data/nifti/nifti_header.h"

#include <nifti2_io.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "framework/interfaces/error.h"

namespace dvrlab::nifti {
namespace {

using Image = std::unique_ptr<nifti_image, void (*)(nifti_image*)>;

template <class T>
T load(std::span<const std::byte> file, std::size_t offset, bool swap) {
  std::array<std::byte, sizeof(T)> b;
  std::copy_n(file.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), b.begin());
  if (swap) std::reverse(b.begin(), b.end());
  T x;
  std::memcpy(&x, b.data(), sizeof(T));
  return x;
}

SourceType source_type(int datatype, const std::string& name) {
  switch (datatype) {
    case DT_UINT8:
      return SourceType::u8;
    case DT_INT8:
      return SourceType::i8;
    case DT_INT16:
      return SourceType::i16;
    case DT_UINT16:
      return SourceType::u16;
    case DT_INT32:
      return SourceType::i32;
    case DT_UINT32:
      return SourceType::u32;
    case DT_INT64:
      return SourceType::i64;
    case DT_UINT64:
      return SourceType::u64;
    case DT_FLOAT32:
      return SourceType::f32;
    case DT_FLOAT64:
      return SourceType::f64;
    default:
      throw InputError(name + ": data type " + std::to_string(datatype) + " (" + nifti_datatype_string(datatype) +
                       ") is no scalar number; integers of 8 to 64 bits, float32 and float64 are read");
  }
}

constexpr std::size_t size_of_version(int version) {
  return version == 1 ? sizeof(nifti_1_header) : sizeof(nifti_2_header);
}

constexpr std::size_t magic_of_version(int version) {
  return version == 1 ? offsetof(nifti_1_header, magic) : offsetof(nifti_2_header, magic);
}

// The version and the byte order, from sizeof_hdr and the magic word.
struct Layout {
  int version;
  bool swap;
};

Layout read_layout(std::span<const std::byte> file, const std::string& name) {
  const auto is = [&](bool swap, std::size_t size) {
    return file.size() >= size && load<std::int32_t>(file, 0, swap) == static_cast<std::int32_t>(size);
  };
  for (const bool swap : {false, true}) {
    for (const int version : {1, 2}) {
      if (!is(swap, size_of_version(version))) continue;
      const auto magic = file.subspan(magic_of_version(version), 4);
      const auto equals = [&](const char* word) { return std::memcmp(magic.data(), word, 4) == 0; };
      if (equals("ni1") || equals("ni2"))
        throw NotSupported(name + ": is the header of a .hdr/.img pair, which is not read; store it as one .nii file");
      if (!equals(version == 1 ? "n+1" : "n+2"))
        throw InputError(name + ": has the size of a NIfTI header but not its magic word (an ANALYZE file?)");
      return {version, swap};
    }
  }
  throw InputError(name + ": is no NIfTI file; it does not start with a header of 348 or 540 bytes");
}

// dim[0] is the number of dimensions, dim[1..7] are their sizes.
std::array<long long, 3> read_dims(const std::array<long long, 8>& dim, const std::string& name) {
  bool good = dim[0] >= 3 && dim[0] <= 7;
  for (long long a = 4; good && a <= dim[0]; ++a) good = dim[static_cast<std::size_t>(a)] == 1;
  if (!good) {
    std::string text;
    for (long long a = 1; a <= std::clamp<long long>(dim[0], 0, 7); ++a)
      text += (a > 1 ? " x " : "") + std::to_string(dim[static_cast<std::size_t>(a)]);
    throw InputError(name + ": has " + std::to_string(dim[0]) + " dimensions (" + text +
                     "); only one 3-D scalar volume is read: cut out one time point or component first");
  }
  return {dim[1], dim[2], dim[3]};
}

void read_affine(const nifti_image& image, const std::string& name, NiftiHeader& h) {
  const bool sform = image.sform_code > 0, qform = image.qform_code > 0;
  h.notes.push_back(std::string("world frame: RAS, by the file's ") +
                    (sform   ? "sform"
                     : qform ? "qform"
                             : "pixdim alone, since it has neither sform nor qform"));
  h.anatomical = sform || qform;
  Affine& a = h.to_world;
  const auto& m = sform ? image.sto_xyz.m : image.qto_xyz.m;  // without a qform the library puts pixdim here
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) a.m[3 * r + c] = m[r][c];
    a.t[r] = m[r][3];
  }
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(a.m.begin(), a.m.end(), finite) || !std::all_of(a.t.begin(), a.t.end(), finite))
    throw InputError(name + ": the affine matrix holds a number that is not finite");
}

// Seconds and the like share the field; the bits of the length come first.
std::string read_unit(int xyz_units) {
  switch (xyz_units) {
    case NIFTI_UNITS_METER:
      return "m";
    case NIFTI_UNITS_MM:
      return "mm";
    case NIFTI_UNITS_MICRON:
      return "um";
    default:
      return "";
  }
}

template <class Header>
Image convert(std::span<const std::byte> file, nifti_image* (*to_image)(Header, const char*), const std::string& name) {
  Header raw;
  std::memcpy(&raw, file.data(), sizeof raw);
  nifti_set_debug_level(0);  // its messages would go to stderr
  return Image(to_image(raw, name.c_str()), nifti_image_free);
}

// Read from the raw header: nifticlib turns a number that is not finite into 0.
template <class Header>
void read_scaling(std::span<const std::byte> file, bool swap, const std::string& name, NiftiHeader& h) {
  const double slope = load<decltype(Header::scl_slope)>(file, offsetof(Header, scl_slope), swap);
  const double intercept = load<decltype(Header::scl_inter)>(file, offsetof(Header, scl_inter), swap);
  if (slope == 0) return;  // the format's way to say "none"
  if (std::isnan(slope)) {
    h.notes.push_back("scl_slope is NaN and taken as none");  // some writers leave it so where they mean none
    return;
  }
  if (!std::isfinite(slope) || !std::isfinite(intercept))
    throw InputError(name + ": scl_slope or scl_inter is not finite; 0 means none");
  h.slope = slope;
  h.intercept = intercept;
}

template <class Header>
NiftiHeader read(std::span<const std::byte> file, bool swap, nifti_image* (*to_image)(Header, const char*),
                 const std::string& name) {
  using Size = std::remove_extent_t<decltype(Header::dim)>;
  NiftiHeader h;
  h.swap = swap;
  std::array<long long, 8> dim;
  for (std::size_t a = 0; a < 8; ++a) dim[a] = load<Size>(file, offsetof(Header, dim) + a * sizeof(Size), swap);
  h.dims = read_dims(dim, name);
  h.type = source_type(load<std::int16_t>(file, offsetof(Header, datatype), swap), name);
  grid_bytes(h.dims, bytes_of(h.type), name);
  read_scaling<Header>(file, swap, name, h);
  const Image image = convert(file, to_image, name);
  if (!image) throw InputError(name + ": nifticlib refuses the header");
  if (image->iname_offset < static_cast<std::int64_t>(sizeof(Header)))
    throw InputError(name + ": vox_offset is " + std::to_string(image->iname_offset) + ", inside the header");
  h.voxel_offset = static_cast<std::uint64_t>(image->iname_offset);
  h.length_unit = read_unit(image->xyz_units);
  read_affine(*image, name, h);
  return h;
}

}  // namespace

bool has_magic(std::span<const std::byte> start) {
  for (const bool swap : {false, true}) {
    for (const int version : {1, 2}) {
      const std::size_t magic = magic_of_version(version);
      if (start.size() < magic + 4 ||
          load<std::int32_t>(start, 0, swap) != static_cast<std::int32_t>(size_of_version(version)))
        continue;
      const auto equals = [&](const char* word) { return std::memcmp(start.data() + magic, word, 4) == 0; };
      if (version == 1 ? equals("n+1") || equals("ni1") : equals("n+2") || equals("ni2")) return true;
    }
  }
  return false;
}

NiftiHeader read_header(std::span<const std::byte> file, const std::string& name) {
  const Layout layout = read_layout(file, name);
  if (layout.version == 1) return read(file, layout.swap, nifti_convert_n1hdr2nim, name);
  return read(file, layout.swap, nifti_convert_n2hdr2nim, name);
}

}  // namespace dvrlab::nifti
