// A first config for data that somebody brings: what `dvrlab info --starter` writes and `dvrlab render FILE` renders.
#pragma once

#include <string>

#include "framework/app/data_input.h"

namespace dvrlab {

/// The config's text, with comments for a newcomer. Paths in it are relative to `folder` where that is possible.
/// Throws InputError for data without voxels.
std::string starter_config(const LoadedData& data, const std::string& folder);

/// What the config does, in a few words for the log.
std::string starter_words(const LoadedData& data);

}  // namespace dvrlab
