#include "backends/cpu/modules.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>

#include "framework/interfaces/error.h"

namespace dvrlab::cpu {

const dvr_kernel_module* ModuleCache::get(const std::string& folder, const std::string& name, const std::string& isa) {
  const std::string file = folder + "/" + name + "." + isa + ".so";
  for (const auto& [known, module] : modules_)
    if (known == file) return module;
  std::error_code ec;
  if (!std::filesystem::exists(file, ec))
    throw std::runtime_error("backend cpu: the kernel module " + file + " is missing: '" + name +
                             "' was not built for isa " + isa + " (build the plugin again, or choose another isa)");
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr)
    throw std::runtime_error("backend cpu: a kernel module is not loadable: " + std::string(dlerror()) +
                             " (build the plugin again)");
  using Entry = const dvr_kernel_module* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(library, "dvrlab_kernel_module"));
  if (entry == nullptr)
    throw std::runtime_error("backend cpu: " + file + " exports no dvrlab_kernel_module (build the plugin again)");
  const dvr_kernel_module* module = entry();
  if (module->abi != DVR_KERNEL_ABI)
    throw std::runtime_error("backend cpu: " + file + " has kernel ABI " + std::to_string(module->abi) +
                             ", this dvrlab has " + std::to_string(DVR_KERNEL_ABI) + " (build the plugin again)");
  modules_.emplace_back(file, module);
  return module;
}

namespace {
int element_code(Element e) {
  switch (e) {
    case Element::u8:
      return DVR_ELEMENT_U8;
    case Element::i8:
      return DVR_ELEMENT_I8;
    case Element::u16:
      return DVR_ELEMENT_U16;
    case Element::i16:
      return DVR_ELEMENT_I16;
    case Element::f32:
      return DVR_ELEMENT_F32;
    case Element::vec4:
      return DVR_ELEMENT_VEC4;
    case Element::i32:
      return DVR_ELEMENT_I32;
    case Element::ivec4:
      return DVR_ELEMENT_IVEC4;
  }
  return DVR_ELEMENT_F32;
}
}  // namespace

void Bindings::add(const KernelUnit& unit) {
  for (const Uniform& u : unit.uniforms) {
    dvr_uniform c{};
    c.name = u.name.c_str();
    c.type = u.type == Uniform::Type::f32 ? DVR_F32 : u.type == Uniform::Type::i32 ? DVR_I32 : DVR_VEC4;
    std::copy(u.f.begin(), u.f.end(), c.f);
    c.i = u.i;
    uniforms_.push_back(c);
  }
  for (const Buffer& b : unit.buffers)
    buffers_.push_back({b.name.c_str(), element_code(b.element), b.data.get(), b.count, b.data64.get()});
}

dvr_bindings Bindings::view() const {
  return {uniforms_.data(),
          static_cast<int>(uniforms_.size()),
          buffers_.data(),
          static_cast<int>(buffers_.size()),
          surfaces_.data(),
          static_cast<int>(surfaces_.size()),
          {}};
}

namespace {
/// True where `name` is only missing because it has no fp64 values.
bool lacks_fp64(const dvr_bindings& bindings, const std::string& name) {
  return std::any_of(bindings.buffers, bindings.buffers + bindings.buffer_count, [&](const dvr_buffer& b) {
    const bool numbers = b.element == DVR_ELEMENT_F32 || b.element == DVR_ELEMENT_VEC4;
    return numbers && name == b.name && b.data64 == nullptr;
  });
}
}  // namespace

template <class Real>
void ModuleFrame<Real>::Free::operator()(void* p) const {
  std::free(p);
}

template <class Real>
ModuleFrame<Real>::ModuleFrame(const dvr_kernel_module* module, const dvr_bindings& bindings, int features) {
  const auto init = module->*ScalarAbi<Real>::init;
  const std::string kernel = std::string("backend cpu: the kernel of ") + module->kind + " " + module->name;
  if (init == nullptr)
    throw std::runtime_error(kernel + " was built in another precision than its file's name says (build it again)");
  const std::size_t align = module->frame_align < 64 ? 64 : module->frame_align;
  const std::size_t bytes = (module->frame_bytes + align - 1) / align * align;
  state_.reset(std::aligned_alloc(align, bytes));
  if (!state_) throw std::bad_alloc();
  char missing[128] = "";
  if (init(state_.get(), &bindings, features, &calls_, missing) == 0) return;
  if (std::is_same_v<Real, double> && lacks_fp64(bindings, missing))
    throw InputError("precision: " + kernel.substr(kernel.find("the kernel")) + " reads \"" + missing +
                     "\", which has fp32 values only; use \"strict\", or another " + module->kind);
  throw InputError(kernel + " reads \"" + missing + "\", which the job does not provide (or with another type)");
}

template class ModuleFrame<float>;
template class ModuleFrame<double>;

}  // namespace dvrlab::cpu
