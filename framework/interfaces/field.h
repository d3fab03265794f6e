// Data: a scalar field in world space, as the data plugins deliver it and the samplers read it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "framework/interfaces/kernel_unit.h"
#include "framework/interfaces/plugin.h"

namespace dvrlab {

/// world = m[3*r..3*r+2] * x + t, fp64, world units.
struct Affine {
  std::array<double, 9> m{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vector3 t{0, 0, 0};
  Vector3 point(const Vector3& x) const;
  Vector3 vector(const Vector3& x) const;
  /// Throws InputError when singular.
  Affine inverse() const;
};

/// A field lives in the box [lo, hi] of its own sampler coordinates (grid: voxel index, so 0 .. dims-1;
/// formula: the coordinates that the formula speaks of). Physical value = slope * stored + intercept.
struct Field {
  virtual ~Field() = default;
  std::string sampler;  // name of the sampler plugin that reads it
  Affine to_world;      // sampler coordinates -> world
  Vector3 lo{0, 0, 0}, hi{1, 1, 1};
  double voxel = 1.0;       // smallest spacing in world units: the length unit "voxel"
  bool anatomical = false;  // world axes are a patient's: x to the right, y to the front, z up (RAS)
  std::string length_unit;  // of the world, where the file says it: "mm"; "" when unknown
  double slope = 1.0, intercept = 0.0;
  double stored_min = 0.0, stored_max = 1.0;  // of the stored values
  std::string source;                         // file, or what it is, for the result file
  std::string sha256;                         // of the file's bytes; of the voxels when generated; "" for a formula
  std::vector<std::string> notes;             // conversions and other things said aloud at load
};

enum class VoxelType { u8, i8, u16, i16, f32 };

struct BlockedField;  // framework/interfaces/blocks.h
struct ArrangeInput;

/// A regular grid, x fastest. Voxel values sit at grid points; the domain is the box of the grid points.
struct GridField : Field {
  std::array<int, 3> dims{0, 0, 0};  // each at least 2
  VoxelType type = VoxelType::u8;
  std::shared_ptr<const void> voxels;
  std::uint64_t count() const { return std::uint64_t(dims[0]) * std::uint64_t(dims[1]) * std::uint64_t(dims[2]); }
  std::uint64_t bytes() const;
  double at(int i, int j, int k) const;                 // stored value
  mutable std::shared_ptr<const void> macrocells;       // the scene stage's value ranges, made at the first use
  mutable std::shared_ptr<const BlockedField> blocked;  // the last arrangement in blocks, and what it was made for
  mutable std::string blocked_key;
};

/// A field that is evaluated by its formula at every sample; value and gradient are exact up to rounding.
struct FormulaField : Field {
  std::vector<Uniform> uniforms;  // for the formula sampler
  std::vector<Buffer> buffers;
};

/// Completes a grid whose dims, type, voxels, to_world, slope, intercept and source are set: sampler, lo, hi, voxel,
/// stored_min and stored_max. Applies the nan policy ("error", or "replace": every NaN and Inf becomes the physical
/// value `nan_value`, with a note).
/// Throws InputError naming the first voxel that is not finite, a dimension below 2, or a singular affine.
void finish_grid(GridField& grid, const std::string& nan_policy, double nan_value);

/// Where a data plugin finds files, and whom it tells.
struct LoadContext {
  std::string base_folder;  // of the config; relative paths start here
  std::string nan_policy = "error";
  double nan_value = 0.0;
};

/// A data plugin: parameters in, field out.
class DataPlugin : public Plugin {
 public:
  /// True if this plugin is the one to read `path`, a file or a folder, with `{"type": <name>, "file": path}` and
  /// nothing else. `start`: up to 512 first bytes of the file, empty for a folder. Judges by name and magic word,
  /// never throws: a damaged file is recognised here and refused by load(). Formats without a magic word or an
  /// extension of their own (raw) are never recognised.
  virtual bool recognises(const std::string& /*path*/, std::span<const std::byte> /*start*/) const { return false; }
  /// Throws InputError for a bad file, NotSupported for data that this build cannot read.
  virtual std::shared_ptr<const Field> load(const ParameterSet& parameters, const LoadContext& context) const = 0;
  /// Bytes that load() will allocate at the most; read from the header only.
  virtual std::uint64_t bytes_needed(const ParameterSet& parameters, const LoadContext& context) const = 0;
};

/// What sampling "cells" finds along a ray (framework/kernel/cells.kernel). lattice: between whole sampler coordinates
/// the value is a cubic of the arc length, continuous across them. formula: continuous, with nothing known of its
/// shape. none: neither (a value that jumps, or a walk of its own): "cells" is refused.
enum class AlongRay { none, lattice, formula };

/// A sampler: binds a field to its kernel.
class SamplerPlugin : public Plugin {
 public:
  virtual AlongRay along_ray() const { return AlongRay::none; }
  /// Bytes that arrange() and bind() will allocate at the most; what they share with the field does not count.
  virtual std::uint64_t bytes_needed(const Field& /*field*/, const ParameterSet& /*parameters*/) const { return 0; }
  /// Samples of the blocks that arrange() makes, at the most; 0: it makes none.
  virtual std::uint64_t most_samples(const Field& /*field*/, const ParameterSet& /*parameters*/) const { return 0; }
  /// Blocks that take the field's place, where the sampler reads such.
  virtual std::shared_ptr<const BlockedField> arrange(const Field& /*field*/, const ParameterSet& /*parameters*/,
                                                      const ArrangeInput& /*input*/) const {
    return nullptr;
  }
  /// Uniforms and buffers of the kernel for this field, or for what arrange() made of it.
  virtual KernelUnit bind(const Field& field) const = 0;
  /// The same for a grid of `dims` points over the field's box, where the sampler makes one.
  virtual KernelUnit bind_to(const Field& field, const std::array<int, 3>& /*dims*/) const { return bind(field); }
};

/// The path that a config names: relative to `base_folder`, "${NAME}" from the environment.
/// Throws InputError (naming `key`) when the file does not exist.
std::string resolve_path(const std::string& file, const LoadContext& context, const std::string& key);

}  // namespace dvrlab
