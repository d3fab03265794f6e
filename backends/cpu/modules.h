// Kernel modules: loading and per-frame state.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "backends/cpu/scalar_abi.h"
#include "framework/interfaces/kernel_unit.h"

namespace dvrlab::cpu {

/// Opens each module library once; libraries are never unloaded.
class ModuleCache {
 public:
  /// <folder>/<name>.<isa>.so. Throws std::runtime_error when it is missing, not loadable or of another kernel ABI:
  /// the plugin is broken, not the config.
  const dvr_kernel_module* get(const std::string& folder, const std::string& name, const std::string& isa);

 private:
  std::vector<std::pair<std::string, const dvr_kernel_module*>> modules_;
};

/// The isa of the modules of precision fp64: one lane in double, for every processor.
inline constexpr const char* fp64_isa = "fp64";

/// The uniforms and buffers of a job as the modules' C structures. Refers to the job's memory.
class Bindings {
 public:
  void add(const KernelUnit& unit);
  /// A surface of a unit, with the index that answers for it.
  void add(const dvr_entry_surface& surface) { surfaces_.push_back(surface); }
  dvr_bindings view() const;

 private:
  std::vector<dvr_uniform> uniforms_;
  std::vector<dvr_buffer> buffers_;
  std::vector<dvr_entry_surface> surfaces_;
};

/// A module's state for one frame, in float or double.
template <class Real>
class ModuleFrame {
 public:
  /// Throws InputError naming the uniform or buffer that the kernel reads and the job lacks, or a table that lacks the
  /// fp64 values that a kernel in fp64 reads.
  ModuleFrame(const dvr_kernel_module* module, const dvr_bindings& bindings, int features);
  const void* state() const { return state_.get(); }
  const typename ScalarAbi<Real>::calls& calls() const { return calls_; }

 private:
  struct Free {
    void operator()(void* p) const;
  };
  std::unique_ptr<void, Free> state_;
  typename ScalarAbi<Real>::calls calls_{};
};

}  // namespace dvrlab::cpu
