#include "framework/image/atomic_file.h"

#include <unistd.h>

#include <filesystem>
#include <stdexcept>

namespace dvrlab {

void write_atomically(const std::string& file, const std::function<void(const std::string&)>& write) {
  const std::string temporary = file + "." + std::to_string(::getpid()) + ".part";
  std::error_code ignored;
  try {
    write(temporary);
    std::filesystem::rename(temporary, file);
  } catch (const std::exception& e) {
    std::filesystem::remove(temporary, ignored);
    throw std::runtime_error(file + ": cannot be written: " + e.what());
  }
}

}  // namespace dvrlab
