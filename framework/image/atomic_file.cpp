#include "framework/image/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace fs = std::filesystem;
namespace {

/// Nobody knows the temporary name: messages speak of the file.
std::string without(std::string text, const std::string& temporary, const std::string& file) {
  for (std::size_t at; (at = text.find(temporary)) != std::string::npos;) text.replace(at, temporary.size(), file);
  return text;
}

}  // namespace

void require_writable(const std::string& file) {
  const fs::path parent = fs::path(file).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  std::error_code ec;
  if (!fs::is_directory(folder, ec))
    throw InputError(file + ": cannot be written: there is no folder '" + folder +
                     "' (make it, or choose another one)");
  if (fs::is_directory(file, ec)) throw InputError(file + ": cannot be written: it is a folder (name a file)");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(file + ": cannot be written: the folder '" + folder + "': " + std::strerror(errno) +
                     " (choose another one)");
}

void write_atomically(const std::string& file, const std::function<void(const std::string&)>& write) {
  require_writable(file);
  const std::string temporary = file + "." + std::to_string(::getpid()) + ".part";
  std::error_code ignored;
  try {
    write(temporary);
    std::error_code ec;
    fs::rename(temporary, file, ec);
    if (ec) throw std::runtime_error(ec.message());
  } catch (const std::exception& e) {
    fs::remove(temporary, ignored);
    throw std::runtime_error(file + ": cannot be written: " + without(e.what(), temporary, file));
  }
}

void write_text_atomically(const std::string& file, const std::string& text) {
  write_atomically(file, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw std::runtime_error("disk full, or no permission?");
  });
}

}  // namespace dvrlab
