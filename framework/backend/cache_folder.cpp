#include "framework/backend/cache_folder.h"

#include <cstdlib>

namespace dvrlab {
namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

}  // namespace

std::string cache_folder() {
  if (const std::string own = environment("DVRLAB_CACHE"); !own.empty()) return own;
  if (const std::string xdg = environment("XDG_CACHE_HOME"); !xdg.empty()) return xdg + "/dvrlab";
  return environment("HOME") + "/.cache/dvrlab";
}

}  // namespace dvrlab
