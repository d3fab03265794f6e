// Work with a library in a child process. At a damaged file a library may end the process, print to stderr, call exit()
// or take all memory. In a child all of it becomes one error (docs/adr/0004).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dvrlab {

/// What a child sends back.
using Bytes = std::vector<std::uint8_t>;

/// Runs `work`, which calls `library`, in a copy of this process and returns what it returns; of what it does otherwise
/// only shared memory stays. `memory`: bytes that it may take on top of this process's own; a damaged file can ask the
/// library for more. Rethrows its InputError or NotSupported here. Throws InputError, naming the file of the last
/// reading(), when the child does not come to its end.
Bytes in_child(const std::string& library, std::uint64_t memory, const std::function<Bytes()>& work);

/// Says which file the library is about to see.
void reading(const std::string& file);

/// Zeroed memory that a child shares. Throws NotSupported, `where` in front, when there is too little.
std::shared_ptr<void> shared_memory(std::uint64_t bytes, const std::string& where);

}  // namespace dvrlab
