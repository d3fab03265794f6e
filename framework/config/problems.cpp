#include "framework/config/problems.h"

#include <algorithm>

#include "framework/config/words.h"
#include "framework/interfaces/error.h"

namespace dvrlab {

void Problems::add(std::string line) {
  // A key or a text of the config may hold anything; a message is one line all the same.
  for (std::size_t at; (at = line.find('\n')) != std::string::npos;) line.replace(at, 1, "\\n");
  if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(std::move(line));
}

void Problems::add(const Problems& others) {
  for (const std::string& line : others.lines_) add(line);
}

void Problems::raise() const {
  if (!lines_.empty()) throw InputError(join_words(lines_, "\n"));
}

}  // namespace dvrlab
