// What a part that carries a kernel gives to a backend: its kernel text, its uniforms and its buffers.
// The same unit feeds the GLSL composer (uniform blocks, storage buffers) and the CPU kernel modules.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/interfaces/parameter_set.h"

namespace dvrlab {

/// A value that is the same for all pixels. Names are unique over the whole shader: `<plugin>_<name>`.
struct Uniform {
  enum class Type { f32, i32, vec4 };
  std::string name;
  Type type = Type::f32;
  std::array<double, 4> f{};  // kernels in fp32 read them rounded, those in fp64 as they are
  int i = 0;
  /// Compiled into a GPU's shader as a literal, so that unused code disappears there.
  bool constant = false;

  static Uniform real(std::string name, double value);
  static Uniform integer(std::string name, int value);
  static Uniform constant_integer(std::string name, int value);
  static Uniform vector(std::string name, double x, double y, double z, double w = 0.0);
};

enum class Element { u8, i8, u16, i16, f32, vec4, i32, ivec4 };
std::size_t bytes_of(Element e);

/// An array that kernels read through fetch primitives only. The memory is shared, never copied by the owner.
struct Buffer {
  std::string name;
  Element element = Element::f32;
  std::shared_ptr<const void> data;
  std::uint64_t count = 0;  // elements; 0: never read, and not bound
  /// The same numbers in double, for kernels in fp64: needed where numbers are computed (vec4, and f32 volumes of
  /// stages); a sampler's voxels are read in their own type. A kernel in fp64 refuses a table that has none.
  std::shared_ptr<const void> data64 = nullptr;
  std::uint64_t bytes() const { return count * bytes_of(element); }  // of `data`
  std::uint64_t bytes64() const { return data64 ? 2 * bytes() : 0; }
};

/// A surface of triangles of which kernels ask which one a ray enters next (framework/kernel/entry.kernel). Backends
/// answer with a hierarchy of their own, which only chooses the faces that the kernel's text judges.
struct EntrySurface {
  std::string name;
  /// Corners of each face in sampler coordinates.
  std::shared_ptr<const std::vector<std::array<std::array<float, 3>, 3>>> faces;
};

/// One kernel with everything that it reads.
struct KernelUnit {
  std::string plugin;  // "direct"
  std::string folder;  // where <plugin>.kernel and <plugin>.<isa>.so lie
  std::vector<Uniform> uniforms;
  std::vector<Buffer> buffers;
  std::vector<EntrySurface> surfaces;
  /// An estimator's: fetches of four numbers per segment from its own tables, and from the medium's beside those that
  /// it declares, at the most; a segment that it divides counts as one part.
  int fetches = 0;
};

/// True for a sampler whose kernel text defines walk_next: it goes from face to face (framework/kernel/walk.glsl)
/// instead of being asked at positions. Throws std::runtime_error when the text cannot be read.
bool walks(const KernelUnit& sampler);
/// True for one whose text defines sample_cell(p), a cell of the voxels <plugin>_voxels between which its value is
/// interpolated: a backend may lay what else has the same points beside them. Throws likewise.
bool tells_cells(const KernelUnit& sampler);

/// The numeric parameters of a plugin as uniforms `<plugin>_<name>`: numbers as f32, whole numbers, booleans and
/// choices (their index) as i32, vectors as vec4; whole numbers, booleans and choices are constants. Texts, nodes and
/// structures are left to the plugin.
std::vector<Uniform> uniforms_of(const std::string& plugin, const ParameterSet& parameters);

}  // namespace dvrlab
