#include "framework/interfaces/field.h"

#include <cmath>
#include <filesystem>

#include "framework/config/environment.h"
#include "framework/interfaces/error.h"
#include "framework/scene/voxels.h"

namespace dvrlab {

Vector3 Affine::vector(const Vector3& x) const {
  Vector3 y;
  for (int r = 0; r < 3; ++r) y[r] = m[3 * r] * x[0] + m[3 * r + 1] * x[1] + m[3 * r + 2] * x[2];
  return y;
}

Vector3 Affine::point(const Vector3& x) const {
  const Vector3 y = vector(x);
  return {y[0] + t[0], y[1] + t[1], y[2] + t[2]};
}

Affine Affine::inverse() const {
  const auto cofactor = [this](int r, int c) {
    const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    return m[3 * r1 + c1] * m[3 * r2 + c2] - m[3 * r1 + c2] * m[3 * r2 + c1];
  };
  const double determinant = m[0] * cofactor(0, 0) + m[1] * cofactor(0, 1) + m[2] * cofactor(0, 2);
  // Singular relative to the lengths of its columns, so that the unit of length does not matter.
  double lengths = 1;
  for (int c = 0; c < 3; ++c) lengths *= std::hypot(m[c], m[3 + c], m[6 + c]);
  if (!(std::fabs(determinant) > 1e-12 * lengths) || !std::isfinite(determinant))
    throw InputError("the affine matrix of the data is singular: its axes do not span the space");
  Affine inverse;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) inverse.m[3 * r + c] = cofactor(c, r) / determinant;
  const Vector3 back = inverse.vector(t);
  inverse.t = {-back[0], -back[1], -back[2]};
  return inverse;
}

std::uint64_t GridField::bytes() const { return count() * bytes_of(type); }

double GridField::at(int i, int j, int k) const {
  const std::uint64_t index =
      (static_cast<std::uint64_t>(k) * static_cast<std::uint64_t>(dims[1]) + static_cast<std::uint64_t>(j)) *
          static_cast<std::uint64_t>(dims[0]) +
      static_cast<std::uint64_t>(i);
  switch (type) {
    case VoxelType::u8:
      return static_cast<const std::uint8_t*>(voxels.get())[index];
    case VoxelType::i8:
      return static_cast<const std::int8_t*>(voxels.get())[index];
    case VoxelType::u16:
      return static_cast<const std::uint16_t*>(voxels.get())[index];
    case VoxelType::i16:
      return static_cast<const std::int16_t*>(voxels.get())[index];
    case VoxelType::f32:
      return static_cast<const float*>(voxels.get())[index];
  }
  throw std::logic_error("unknown voxel type");
}

std::string resolve_path(const std::string& file, const LoadContext& context, const std::string& key) {
  const std::string expanded = expand_environment(file, key);
  const std::filesystem::path path = std::filesystem::path(context.base_folder) / expanded;  // absolute paths win
  std::error_code error;
  if (expanded.empty() || !std::filesystem::exists(path, error))
    throw InputError(key + ": there is no file \"" + expanded + "\" (looked for " + path.lexically_normal().string() +
                     "; relative paths start at the config's folder)");
  return path.lexically_normal().string();
}

}  // namespace dvrlab
