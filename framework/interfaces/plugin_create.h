// Detail of plugin.h: the one place where an exception of a plugin's constructor is turned into text.
#pragma once

#include <cstdio>
#include <exception>

namespace dvrlab {

template <class T>
Plugin* create_plugin(char* error) noexcept {
  try {
    return new T();
  } catch (const std::exception& e) {
    std::snprintf(error, 256, "%s", e.what());
  } catch (...) {
    std::snprintf(error, 256, "an exception that is no std::exception");
  }
  return nullptr;
}

}  // namespace dvrlab
