#include "plugins/data/raw/size_check.h"

#include <cmath>
#include <vector>

namespace dvrlab::raw {
namespace {

std::string product(const std::array<long long, 3>& n) {
  return std::to_string(n[0]) + "x" + std::to_string(n[1]) + "x" + std::to_string(n[2]);
}

std::string listed(const std::array<long long, 3>& n) {
  return "[" + std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]) + "]";
}

// The side of a cube of `voxels`, 0 when there is none.
long long cube_side(std::uint64_t voxels) {
  const auto n = static_cast<std::uint64_t>(std::llround(std::cbrt(static_cast<double>(voxels))));
  return n >= 2 && n < (1 << 21) && n * n * n == voxels ? static_cast<long long>(n) : 0;
}

std::vector<std::string> fitting(const Declared& d, std::uint64_t there) {
  static constexpr const char* type_of_bytes[] = {
      "", "int8 or uint8", "int16 or uint16", "", "int32, uint32 or float32", "", "", "", "int64, uint64 or float64"};
  const std::uint64_t element = bytes_of(d.type), needed = grid_bytes(d.dims, element, "size");
  const std::uint64_t count = needed / element, slice = needed / static_cast<std::uint64_t>(d.dims[2]);
  std::vector<std::string> fits;
  for (const std::uint64_t bytes : {1u, 2u, 4u, 8u})
    if (bytes != element && count <= there / bytes && count * bytes == there)
      fits.push_back(std::string("voxel_type ") + type_of_bytes[bytes]);
  if (there % slice == 0 && there / slice >= 2)
    fits.push_back("size " + listed({d.dims[0], d.dims[1], static_cast<long long>(there / slice)}));
  const long long side = there % element == 0 ? cube_side(there / element) : 0;
  if (side != 0 && !(side == d.dims[0] && side == d.dims[1])) fits.push_back("size " + listed({side, side, side}));
  if (!d.skip && there > needed)
    fits.push_back("skip_bytes " + std::to_string(there - needed) + " if the voxels are the file's end");
  return fits;
}

}  // namespace

std::string wrong_size(const Declared& d, std::uint64_t file_bytes) {
  const std::uint64_t needed = grid_bytes(d.dims, bytes_of(d.type), "size"), skip = d.skip.value_or(0);
  const std::uint64_t there = file_bytes - std::min(skip, file_bytes);
  if (d.skip ? there >= needed : there == needed) return "";
  std::string text = product(d.dims) + " " + name_of(d.type) + " needs " + std::to_string(needed) +
                     " bytes, the file has " + std::to_string(file_bytes);
  if (skip > 0) text += ", " + std::to_string(there) + " of them behind the " + std::to_string(skip) + " skipped ones";
  std::string fits;
  for (const std::string& f : fitting(d, there)) fits += (fits.empty() ? "" : ", or ") + f;
  return text + "; " +
         (fits.empty() ? "no voxel_type fits this size: check data.size and skip_bytes" : fits + " would fit");
}

}  // namespace dvrlab::raw
