// A file that appears complete or not at all: written beside its place, then renamed.
#pragma once

#include <functional>
#include <string>

namespace dvrlab {

/// For verbs, before the work whose result goes to `file`. Throws InputError naming the file when its folder is not
/// there or cannot be written, and when `file` is a folder.
void require_writable(const std::string& file);

/// Calls write(temporary name) and renames the result to `file`. When `write` throws, nothing is left behind, and a
/// file that was there stays as it was. Throws InputError as require_writable, else std::runtime_error naming the file.
void write_atomically(const std::string& file, const std::function<void(const std::string&)>& write);

/// The same for a text; what does not reach the disk is an error.
void write_text_atomically(const std::string& file, const std::string& text);

}  // namespace dvrlab
