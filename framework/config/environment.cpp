#include "framework/config/environment.h"

#include <cstdlib>

#include "framework/interfaces/error.h"

namespace dvrlab {

std::string expand_environment(const std::string& text, const std::string& where) {
  std::string expanded;
  std::size_t at = 0;
  for (std::size_t open; (open = text.find("${", at)) != std::string::npos;) {
    const std::size_t close = text.find('}', open);
    const std::string name = close == std::string::npos ? "" : text.substr(open + 2, close - open - 2);
    if (name.empty()) throw InputError(where + ": found \"" + text + "\"; an environment variable is written ${NAME}");
    const char* value = std::getenv(name.c_str());
    if (value == nullptr)
      throw InputError(where + ": the environment variable " + name + " in \"" + text + "\" is not set");
    expanded += text.substr(at, open - at) + value;
    at = close + 1;
  }
  return expanded + text.substr(at);
}

}  // namespace dvrlab
