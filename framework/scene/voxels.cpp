#include "framework/scene/voxels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <iterator>
#include <mutex>
#include <sstream>

#include "framework/interfaces/error.h"
#include "framework/report/number_text.h"
#include "framework/scene/parallel.h"

namespace dvrlab {
namespace {

constexpr std::uint64_t least_voxels = 1 << 18;  // below this a thread costs more than it saves

template <class T>
T load(const std::byte* p, bool swap) {
  std::array<std::byte, sizeof(T)> b;
  std::memcpy(b.data(), p, sizeof(T));
  if (swap) std::reverse(b.begin(), b.end());
  return std::bit_cast<T>(b);
}

// Writes every voxel as Dst and returns the largest |source - kept|. The difference is exact: double holds all numbers
// but the 64-bit integers, and long double those.
template <class Src, class Dst>
double convert(const std::byte* in, bool swap, Dst* out, const std::array<int, 3>& dims, const std::string& where) {
  const std::uint64_t count = std::uint64_t(dims[0]) * std::uint64_t(dims[1]) * std::uint64_t(dims[2]);
  using Exact = std::conditional_t<std::is_integral_v<Src> && sizeof(Src) == 8, long double, double>;
  Exact worst = 0;
  std::mutex guard;
  parallel_ranges(count, least_voxels, [&](std::uint64_t begin, std::uint64_t end) {
    Exact mine = 0;
    for (std::uint64_t i = begin; i < end; ++i) {
      const Src x = load<Src>(in + i * sizeof(Src), swap);
      out[i] = static_cast<Dst>(x);
      if constexpr (!std::is_same_v<Src, Dst>) {
        const Exact exact = static_cast<Exact>(x);
        if (!std::isfinite(exact)) continue;
        if (!std::isfinite(static_cast<float>(out[i])))
          throw InputError(where + ": " + voxel_text(dims, i) + " is " + number_text(static_cast<double>(x)) +
                           ", beyond what float32 holds; rescale the data");
        mine = std::max(mine, std::fabs(exact - static_cast<Exact>(out[i])));
      }
    }
    const std::lock_guard lock(guard);
    worst = std::max(worst, mine);
  });
  return static_cast<double>(worst);
}

template <class Src, class Dst>
double copy(GridField& grid, const SourceVoxels& source, const std::string& where) {
  const auto memory = allocate_voxels(grid.count() * sizeof(Dst), where);
  const double worst = convert<Src, Dst>(static_cast<const std::byte*>(source.data.get()), source.swap,
                                         static_cast<Dst*>(memory.get()), grid.dims, where);
  grid.voxels = memory;
  return worst;
}

double copy_any(GridField& grid, const SourceVoxels& source, const std::string& where) {
  return with_source_type(source.type, [&]<class Src>(Src) {
    using Dst = std::conditional_t<sizeof(Src) <= 2, Src, float>;
    return copy<Src, Dst>(grid, source, where);
  });
}

bool is_kept(SourceType type) {
  return type == SourceType::i8 || type == SourceType::u8 || type == SourceType::i16 || type == SourceType::u16 ||
         type == SourceType::f32;
}

}  // namespace

std::string voxel_text(const std::array<int, 3>& dims, std::uint64_t index) {
  const std::uint64_t nx = std::uint64_t(dims[0]), ny = std::uint64_t(dims[1]);
  return "voxel (" + std::to_string(index % nx) + ", " + std::to_string(index / nx % ny) + ", " +
         std::to_string(index / nx / ny) + ")";
}

std::size_t bytes_of(SourceType type) {
  static constexpr std::size_t bytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return bytes[static_cast<int>(type)];
}

const char* name_of(SourceType type) {
  static constexpr const char* name[] = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                         "uint32", "int64", "uint64", "float32", "float64"};
  return name[static_cast<int>(type)];
}

VoxelType kept_type(SourceType type) {
  switch (type) {
    case SourceType::i8:
      return VoxelType::i8;
    case SourceType::u8:
      return VoxelType::u8;
    case SourceType::i16:
      return VoxelType::i16;
    case SourceType::u16:
      return VoxelType::u16;
    default:
      return VoxelType::f32;
  }
}

std::size_t bytes_of(VoxelType type) {
  static constexpr std::size_t bytes[] = {1, 1, 2, 2, 4};
  return bytes[static_cast<int>(type)];
}

std::uint64_t grid_bytes(const std::array<long long, 3>& dims, std::size_t element, const std::string& where) {
  std::uint64_t bytes = element;
  for (const long long n : dims) {
    if (n < 2)
      throw InputError(where + ": a dimension is " + std::to_string(n) +
                       "; a volume needs at least 2 grid points along each axis");
    if (n > 0x7fffffffll || __builtin_mul_overflow(bytes, static_cast<std::uint64_t>(n), &bytes) || bytes >> 63)
      throw InputError(where + ": the dimensions " + std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " +
                       std::to_string(dims[2]) + " overflow; no memory holds such a volume");
  }
  return bytes;
}

void set_voxels(GridField& grid, const SourceVoxels& source, const std::string& where) {
  grid.type = kept_type(source.type);
  const bool kept = is_kept(source.type);
  const bool aligned = reinterpret_cast<std::uintptr_t>(source.data.get()) % bytes_of(source.type) == 0;
  if (kept && aligned && (!source.swap || bytes_of(source.type) == 1)) {
    grid.voxels = source.data;
    return;
  }
  const double worst = copy_any(grid, source, where);
  if (kept) return;
  std::ostringstream note;
  note << name_of(source.type) << " voxels are kept as float32, largest rounding error " << worst;
  grid.notes.push_back(note.str());
}

std::uint64_t set_voxels_bytes(SourceType type, bool swap, std::uint64_t count) {
  return is_kept(type) && !swap ? 0 : count * bytes_of(kept_type(type));
}

std::shared_ptr<void> allocate_voxels(std::uint64_t bytes, const std::string& where) {
  const std::uint64_t rounded = (bytes + voxel_alignment - 1) / voxel_alignment * voxel_alignment;
  void* memory = std::aligned_alloc(voxel_alignment, rounded);
  if (!memory) throw NotSupported(where + ": no memory for " + std::to_string(bytes) + " bytes of voxels");
  return std::shared_ptr<void>(memory, std::free);
}

}  // namespace dvrlab
