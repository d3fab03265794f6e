// Embree finds the faces of a surface that a ray may enter; the kernel's own text judges them
// (framework/kernel/entry.kernel).
#pragma once

#include <memory>

#include "framework/interfaces/kernel_module.h"
#include "framework/interfaces/kernel_unit.h"

namespace dvrlab::cpu {

/// A bounding volume hierarchy over the faces' boxes, which are a little larger than the faces: what rounding does to
/// the place of a ray never hides a face from the kernel. Thread-safe once built.
class EntryIndex {
 public:
  explicit EntryIndex(const EntrySurface& surface);
  ~EntryIndex();
  EntryIndex(const EntryIndex&) = delete;
  EntryIndex& operator=(const EntryIndex&) = delete;

  /// As dvr_entry_surface::find.
  static void find(const void* index, dvr_entries* rays);
  static void find64(const void* index, dvr_entries64* rays);

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

/// The index of a surface, built at the first use and kept as long as the surface's faces are. Thread-safe.
std::shared_ptr<const EntryIndex> entry_index_of(const EntrySurface& surface);

}  // namespace dvrlab::cpu
