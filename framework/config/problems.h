// Collects everything that is wrong with a config, so that all of it is said at once.
#pragma once

#include <string>
#include <vector>

namespace dvrlab {

class Problems {
 public:
  /// One line: place, path, what was found, what would be right. A line that is there already is not added: the
  /// same mistake shows up in every case of a product.
  void add(std::string line);
  void add(const Problems& others);
  bool empty() const { return lines_.empty(); }
  const std::vector<std::string>& lines() const { return lines_; }
  /// Throws InputError with all lines, one each, when there are any.
  void raise() const;

 private:
  std::vector<std::string> lines_;
};

}  // namespace dvrlab
