// Work on voxels at load, spread over the processors.
#pragma once

#include <cstdint>
#include <functional>

namespace dvrlab {

/// Calls work(begin, end) on disjoint ranges that cover [0, count), one per hardware thread; a range is not smaller
/// than `least`. Blocks until all are done and rethrows the first exception.
void parallel_ranges(std::uint64_t count, std::uint64_t least,
                     const std::function<void(std::uint64_t, std::uint64_t)>& work);

}  // namespace dvrlab
