// Where backends keep what they compiled.
#pragma once

#include <string>

namespace dvrlab {

/// ${DVRLAB_CACHE}, else ${XDG_CACHE_HOME}/dvrlab, else ~/.cache/dvrlab. It may not exist yet.
std::string cache_folder();

}  // namespace dvrlab
