// A file that appears complete or not at all: written beside its place, then renamed.
#pragma once

#include <functional>
#include <string>

namespace dvrlab {

/// Calls write(temporary name) and renames the result to `file`. When `write` throws, nothing is left behind.
/// Throws std::runtime_error naming the file.
void write_atomically(const std::string& file, const std::function<void(const std::string&)>& write);

}  // namespace dvrlab
