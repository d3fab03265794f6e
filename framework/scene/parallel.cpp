#include "framework/scene/parallel.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace dvrlab {

void parallel_ranges(std::uint64_t count, std::uint64_t least,
                     const std::function<void(std::uint64_t, std::uint64_t)>& work) {
  const std::uint64_t most = std::max(1u, std::thread::hardware_concurrency());
  const std::uint64_t parts = std::clamp<std::uint64_t>(count / std::max<std::uint64_t>(1, least), 1, most);
  std::exception_ptr failure;
  std::mutex guard;
  const auto part = [&](std::uint64_t k) {
    try {
      work(count / parts * k + std::min(k, count % parts), count / parts * (k + 1) + std::min(k + 1, count % parts));
    } catch (...) {
      const std::lock_guard lock(guard);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::uint64_t k = 1; k < parts; ++k) threads.emplace_back(part, k);
    part(0);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace dvrlab
