// The few programs that were used last: a frame's march and the stages of its light take turns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>

#include "framework/shader/spirv.h"

namespace dvrlab {

/// Programs by their code, the last used first; the oldest goes when there are too many.
template <class Program>
class RecentPrograms {
 public:
  /// The program of this code, made by `make()` when it is not there.
  template <class Make>
  Program& use(const Spirv& spirv, Make make) {
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return e.spirv == spirv; });
    if (known != entries_.end()) {
      entries_.splice(entries_.begin(), entries_, known);
    } else {
      entries_.push_front({spirv, make()});
      if (entries_.size() > most) entries_.pop_back();
    }
    return entries_.front().program;
  }

  void clear() { entries_.clear(); }

 private:
  static constexpr std::size_t most = 8;
  struct Entry {
    Spirv spirv;
    Program program;
  };
  std::list<Entry> entries_;
};

}  // namespace dvrlab
