// From the bytes of a file to the voxels of a grid: what every reader of a grid format shares.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "framework/interfaces/field.h"

namespace dvrlab {

/// The number types that files hold.
enum class SourceType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
std::size_t bytes_of(SourceType type);
/// "int8", "float64".
const char* name_of(SourceType type);

/// "voxel (x, y, z)": the place of the voxel with this index, x fastest.
std::string voxel_text(const std::array<int, 3>& dims, std::uint64_t index);

/// Calls f(T{}) with the C++ type of `type`.
template <class F>
auto with_source_type(SourceType type, F f) {
  switch (type) {
    case SourceType::i8:
      return f(std::int8_t{});
    case SourceType::u8:
      return f(std::uint8_t{});
    case SourceType::i16:
      return f(std::int16_t{});
    case SourceType::u16:
      return f(std::uint16_t{});
    case SourceType::i32:
      return f(std::int32_t{});
    case SourceType::u32:
      return f(std::uint32_t{});
    case SourceType::i64:
      return f(std::int64_t{});
    case SourceType::u64:
      return f(std::uint64_t{});
    case SourceType::f32:
      return f(float{});
    case SourceType::f64:
      return f(double{});
  }
  throw std::logic_error("unknown source type");
}

/// The type in which a grid keeps it: its own, or float32.
VoxelType kept_type(SourceType type);
std::size_t bytes_of(VoxelType type);

/// Voxels as a file holds them, x fastest. `swap`: of the other byte order.
struct SourceVoxels {
  SourceType type = SourceType::u8;
  bool swap = false;
  std::shared_ptr<const void> data;  // any alignment
};

/// Number of bytes of a grid of `element` bytes per voxel. Throws InputError, `where` in front, when a dimension is
/// below 2 or beyond 2^31-1, or when the product does not fit 63 bits.
std::uint64_t grid_bytes(const std::array<long long, 3>& dims, std::size_t element, const std::string& where);

/// Sets type and voxels of a grid whose dims are set. Memory is shared when nothing has to change; otherwise the
/// voxels are copied, with a note (and the largest rounding error) when the type becomes float32.
/// Throws InputError, `where` in front, for a finite value that float32 cannot hold.
void set_voxels(GridField& grid, const SourceVoxels& source, const std::string& where);

/// Bytes that set_voxels allocates for `count` voxels.
std::uint64_t set_voxels_bytes(SourceType type, bool swap, std::uint64_t count);

inline constexpr std::size_t voxel_alignment = 64;  // bytes

/// Uninitialised memory for voxels, aligned to it for every instruction set. Throws NotSupported when there is too
/// little.
std::shared_ptr<void> allocate_voxels(std::uint64_t bytes, const std::string& where);

}  // namespace dvrlab
