// What a case needs of memory, part by part, stated before anything is allocated.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace dvrlab {

class MemoryBill {
 public:
  /// `limit`: bytes that the case may use; `limit_text`: what that is, for the message ("limits.memory allows").
  MemoryBill(double limit, std::string limit_text) : limit_(limit), limit_text_(std::move(limit_text)) {}

  /// States the bytes of one part; a part that was stated before is replaced. Throws NotSupported with every part and
  /// the sum when the sum is beyond the limit.
  void state(const std::string& part, double bytes);
  double sum() const;
  /// Part and bytes, in the order in which they were stated first.
  const std::vector<std::pair<std::string, double>>& parts() const { return parts_; }

 private:
  double limit_;
  std::string limit_text_;
  std::vector<std::pair<std::string, double>> parts_;
};

}  // namespace dvrlab
