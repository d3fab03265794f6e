// What every plugin library exports: one C function that returns one plain descriptor.
#pragma once

#include "framework/interfaces/abi_tag.h"  // generated: number + hash of framework/interfaces + compiler ABI
#include "framework/interfaces/parameter.h"

namespace dvrlab {

class ParameterSet;

/// Base of every plugin object. Objects hold no configuration: their methods receive the resolved parameters.
class Plugin {
 public:
  virtual ~Plugin() = default;
  /// What the declarations cannot say: bounds in order, keys that exclude each other. Called for every case when a
  /// config is validated, before anything is read or allocated. Throws InputError that begins with the key's place
  /// (`parameters.path_of("bounds") + ": ..."`).
  virtual void check(const ParameterSet& /*parameters*/) const {}
};

/// Plain data, first member first: a library of another ABI is recognised before anything else is read.
struct PluginDescriptor {
  const char* abi_tag;
  const char* kind;      // data, sampler, optical_model, estimator, illumination, metric, backend
  const char* name;      // = folder = JSON type
  const char* version;   // of the plugin
  const char* summary;   // one sentence
  const char* citation;  // paper and DOI; "" for infrastructure
  const Parameter* parameters;
  int parameter_count;
  /// Makes the plugin object. Never throws: returns nullptr and writes one sentence to `error` (256 bytes).
  Plugin* (*create)(char* error);
};

using PluginEntry = const PluginDescriptor* (*)();
inline constexpr const char* plugin_entry_name = "dvrlab_plugin";

/// Implementation of DVRLAB_PLUGIN: catches what the constructor throws.
template <class T>
Plugin* create_plugin(char* error) noexcept;

}  // namespace dvrlab

#include "framework/interfaces/plugin_create.h"

/// DVRLAB_PLUGIN(kind, name, version, Class, parameters, summary, citation): the versioned C entry point.
/// `parameters` is an array of Parameter with at least one element; see DVRLAB_PLUGIN_PLAIN for none.
#define DVRLAB_PLUGIN_ENTRY(kind_, name_, version_, Class_, parameters_, count_, summary_, citation_)               \
  extern "C" __attribute__((visibility("default"))) const ::dvrlab::PluginDescriptor* dvrlab_plugin() {             \
    static const ::dvrlab::PluginDescriptor descriptor{DVRLAB_ABI_TAG, kind_,    name_,                             \
                                                       version_,       summary_, citation_,                         \
                                                       parameters_,    count_,   &::dvrlab::create_plugin<Class_>}; \
    return &descriptor;                                                                                             \
  }
#define DVRLAB_PLUGIN(kind_, name_, version_, Class_, parameters_, summary_, citation_) \
  DVRLAB_PLUGIN_ENTRY(kind_, name_, version_, Class_, parameters_,                      \
                      static_cast<int>(sizeof(parameters_) / sizeof((parameters_)[0])), summary_, citation_)
#define DVRLAB_PLUGIN_PLAIN(kind_, name_, version_, Class_, summary_, citation_) \
  DVRLAB_PLUGIN_ENTRY(kind_, name_, version_, Class_, nullptr, 0, summary_, citation_)
