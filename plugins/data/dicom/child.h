// Work with GDCM in a child process. Debian builds the library with its assertions: at a damaged file it ends the
// process, and the codecs behind it print to stderr. In a child both become one error.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace dvrlab::dicom {

/// Runs `work` in a copy of this process; of what it does only shared memory stays. Rethrows its InputError or
/// NotSupported here. Throws InputError, naming the file of the last reading(), when the child does not come to its
/// end.
void in_child(const std::function<void()>& work);

/// Says which file the library is about to see.
void reading(const std::string& file);

/// Zeroed memory that a child shares. Throws NotSupported, `where` in front, when there is too little.
std::shared_ptr<void> shared_memory(std::uint64_t bytes, const std::string& where);

}  // namespace dvrlab::dicom
