#include "plugins/data/nifti/nifti_header.h"

#include <nifti2_io.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include "framework/interfaces/error.h"
#include "framework/report/number_text.h"

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

// nifticlib takes 1 for a pixdim that is 0 or not finite, or negative under a qform, and 0 for a part of the quaternion
// that is not finite: what decides the affine is judged before that.
template <class Header>
void check_affine(std::span<const std::byte> file, bool swap, const std::string& name, NiftiHeader& h) {
  const auto code = [&](std::size_t offset) { return load<decltype(Header::qform_code)>(file, offset, swap); };
  if (code(offsetof(Header, sform_code)) > 0) return;
  const bool qform = code(offsetof(Header, qform_code)) > 0;
  using Real = std::remove_extent_t<decltype(Header::pixdim)>;
  const auto real = [&](std::size_t offset) -> double { return load<Real>(file, offset, swap); };
  for (std::size_t a = qform ? 0 : 1; a <= 3; ++a) {
    const double x = real(offsetof(Header, pixdim) + a * sizeof(Real));
    if (std::isfinite(x) && (a == 0 || (qform ? x > 0 : x != 0))) continue;
    throw InputError(name + ": pixdim[" + std::to_string(a) + "] is " + number_text(x) +
                     (a == 0  ? "; it must be -1 or 1"
                      : qform ? "; with a qform it must be a spacing above 0"
                              : "; it must be a spacing, finite and not 0"));
  }
  if (!qform) return;
  double square = 0;
  for (const std::size_t at : {offsetof(Header, quatern_b), offsetof(Header, quatern_c), offsetof(Header, quatern_d),
                               offsetof(Header, qoffset_x), offsetof(Header, qoffset_y), offsetof(Header, qoffset_z)}) {
    const double x = real(at);
    if (!std::isfinite(x)) throw InputError(name + ": the qform holds a number that is not finite");
    if (at < offsetof(Header, qoffset_x)) square += x * x;
  }
  // Beyond what rounding makes of a half turn there is no rotation; the library would scale (b, c, d) to length 1.
  if (square > 1.001)
    throw InputError(name + ": quatern_b^2 + quatern_c^2 + quatern_d^2 is " + number_text(square) +
                     "; a rotation has at most 1");
  if (square > 1.000001)
    h.notes.push_back("quatern_b, quatern_c and quatern_d have the length " + number_text(std::sqrt(square)) +
                      " and are scaled to 1");
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

// Read from the raw header: nifticlib moves what lies in front of the header's end there, 4 bytes before the voxels.
template <class Header>
std::uint64_t read_voxel_offset(std::span<const std::byte> file, bool swap, const std::string& name, NiftiHeader& h) {
  constexpr std::size_t least = sizeof(Header) + 4;  // the flag for extensions is always there
  constexpr double most = 1e15;                      // whole numbers are exact; no file is longer
  const auto offset = static_cast<double>(load<decltype(Header::vox_offset)>(file, offsetof(Header, vox_offset), swap));
  if (offset == 0) {
    h.notes.push_back("vox_offset is 0 and taken as " + std::to_string(least) + ", directly behind the header");
    return least;
  }
  if (!(offset >= double(least) && offset <= most) || offset != std::floor(offset))
    throw InputError(name + ": vox_offset is " + number_text(offset, 9) + "; it must be a whole number of at least " +
                     std::to_string(least) + ", the header and the 4 bytes behind it");
  return static_cast<std::uint64_t>(offset);
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
  h.voxel_offset = read_voxel_offset<Header>(file, swap, name, h);
  const auto bits = load<std::int16_t>(file, offsetof(Header, bitpix), swap);
  if (static_cast<std::size_t>(bits) != 8 * bytes_of(h.type))
    h.notes.push_back("bitpix is " + std::to_string(bits) + ", but the data type " + name_of(h.type) + " decides");
  check_affine<Header>(file, swap, name, h);
  const Image image = convert(file, to_image, name);
  if (!image) throw InputError(name + ": nifticlib refuses the header");
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
