// The kernel language as C++. A kernel text is included inside a struct derived from kernel_base, so that its
// uniforms and tables are members and its functions see them as GLSL's functions see globals.
#pragma once

#include "framework/interfaces/kernel_module.h"
#include "framework/kernel/cpu/fetch.h"

namespace dvr {

struct vec3r {
  real x, y, z;
};
DVR_INLINE vec3r v3(real x, real y, real z) { return {x, y, z}; }
DVR_INLINE vec3r operator+(vec3r a, vec3r b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
DVR_INLINE vec3r operator-(vec3r a, vec3r b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
DVR_INLINE vec3r operator*(vec3r a, vec3r b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
DVR_INLINE vec3r operator*(vec3r a, real b) { return {a.x * b, a.y * b, a.z * b}; }
DVR_INLINE vec3r operator*(real a, vec3r b) { return b * a; }
DVR_INLINE vec3r operator-(vec3r a) { return {-a.x, -a.y, -a.z}; }
DVR_INLINE vec3r select(mask m, vec3r a, vec3r b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
DVR_INLINE vec4r select(mask m, vec4r a, vec4r b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z), select(m, a.w, b.w)};
}
DVR_INLINE vec3r xyz(vec4r a) { return {a.x, a.y, a.z}; }

/// What the backend and the modules share, in this module's type of number.
#ifdef DVR_ISA_fp64
typedef dvr_packet64 ray_packet;
typedef dvr_chunk64 ray_chunk;
typedef dvr_calls64 module_calls;
typedef dvr_entries64 ray_entries;
#define DVR_INIT(function) nullptr, function
#else
typedef dvr_packet ray_packet;
typedef dvr_chunk ray_chunk;
typedef dvr_calls module_calls;
typedef dvr_entries ray_entries;
#define DVR_INIT(function) function, nullptr
#endif

/// Three rows of a packet.
DVR_INLINE vec3r load3(const scalar (*p)[DVR_MAX_WIDTH]) { return {load(p[0]), load(p[1]), load(p[2])}; }
DVR_INLINE void store3(scalar (*p)[DVR_MAX_WIDTH], vec3r a) {
  store(p[0], a.x);
  store(p[1], a.y);
  store(p[2], a.z);
}

struct uvec4 {
  scalar x, y, z, w;
};
DVR_INLINE vec3r V3(uvec4 u) { return {R(u.x), R(u.y), R(u.z)}; }

/// Finds uniforms and buffers by name while the struct is constructed, once per frame. A missing name is noted,
/// and init() reports it: nothing is read from a kernel that is not complete.
struct kernel_base {
  const dvr_bindings* bindings;
  char* missing;
  kernel_base(const dvr_bindings* b, char* m) : bindings(b), missing(m) {}
  void note(const char* name) {
    if (missing[0] == 0) {
      strncpy(missing, name, 127);
      missing[127] = 0;
    }
  }
  const dvr_uniform* uniform(const char* name, int type) {
    for (int k = 0; k < bindings->uniform_count; ++k) {
      const dvr_uniform* u = bindings->uniforms + k;
      if (strcmp(u->name, name) == 0 && u->type == type) return u;
    }
    note(name);
    return nullptr;
  }
  scalar uniform_f(const char* name) {
    const dvr_uniform* u = uniform(name, DVR_F32);
    return u ? scalar(u->f[0]) : scalar(0);
  }
  int uniform_i(const char* name) {
    const dvr_uniform* u = uniform(name, DVR_I32);
    return u ? u->i : 0;
  }
  uvec4 uniform_v(const char* name) {
    const dvr_uniform* u = uniform(name, DVR_VEC4);
    return u ? uvec4{scalar(u->f[0]), scalar(u->f[1]), scalar(u->f[2]), scalar(u->f[3])} : uvec4{};
  }
  template <class T>
  const T* buffer(const char* name, int element) {
    const T* p = offered<T>(name, element);
    if (!p) note(name);
    return p;
  }
  /// A buffer that a backend may offer or not.
  template <class T>
  const T* offered(const char* name, int element) const {
    for (int k = 0; k < bindings->buffer_count; ++k) {
      const dvr_buffer* b = bindings->buffers + k;
      if (strcmp(b->name, name) == 0 && b->element == element) return static_cast<const T*>(b->data);
    }
    return nullptr;
  }
  dvr_entry_surface surface(const char* name) {
    for (int k = 0; k < bindings->surface_count; ++k)
      if (strcmp(bindings->surfaces[k].name, name) == 0) return bindings->surfaces[k];
    note(name);
    return {};
  }
  /// Numbers that were computed, in this module's precision. A table without fp64 values is missing to a module in
  /// fp64.
  const scalar* numbers(const char* name, int element) {
#ifdef DVR_ISA_fp64
    for (int k = 0; k < bindings->buffer_count; ++k) {
      const dvr_buffer* b = bindings->buffers + k;
      if (strcmp(b->name, name) == 0 && b->element == element && b->data64)
        return static_cast<const double*>(b->data64);
    }
    note(name);
    return nullptr;
#else
    return buffer<float>(name, element);
#endif
  }
};

/// A copy of the frame's state on the stack of the call: the compiler keeps what is used in registers, since no
/// store to a chunk can alias it.
template <class State>
DVR_INLINE State local(const void* frame) {
  return *static_cast<const State*>(frame);
}

}  // namespace dvr

// ---- words ----------------------------------------------------------------------------------------------------
#define KFN DVR_INLINE
#define OUT(type) type&
#define INOUT(type) type&
#define UNIFORM_F(name) dvr::scalar name = this->uniform_f(#name);
#define UNIFORM_I(name) int name = this->uniform_i(#name);
#define UNIFORM_V(name) dvr::uvec4 name = this->uniform_v(#name);
#define TABLE4(name) dvr::table4 name = {this->numbers(#name, DVR_ELEMENT_VEC4)};
#define TABLEI(name) dvr::tablei name = {this->buffer<int32_t>(#name, DVR_ELEMENT_I32)};
#define TABLEI4(name) dvr::tablei4 name = {this->buffer<int32_t>(#name, DVR_ELEMENT_IVEC4)};
#define BYTES(name) dvr::bytes8 name = {this->buffer<uint8_t>(#name, DVR_ELEMENT_U8)};
#define VOLUME(name) dvr::voxels<dvr::scalar> name = {this->numbers(#name, DVR_ELEMENT_F32)};
#define LEVELS(name) dvr::voxels<uint16_t> name = {this->buffer<uint16_t>(#name, DVR_ELEMENT_U16)};
// ENTRY(name) is a word of walking samplers (framework/kernel/cpu/entry.h).
// VOXELS(name) is defined by the sampler and stage modules: the voxel type is the module's variant.
