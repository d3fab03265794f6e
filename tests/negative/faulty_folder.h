// Kernel texts with a planted fault.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "tests/support/render.h"

namespace dvrlab::test {

/// A copy of a kernel folder in which `from` in `file` became `to`.
class FaultyFolder {
 public:
  FaultyFolder(const std::string& folder, const std::string& file, const std::string& from, const std::string& to)
      : path_(std::filesystem::temp_directory_path() / ("dvrlab_fault_" + std::to_string(::getpid()) + "_" + file)) {
    std::filesystem::remove_all(path_);
    std::filesystem::copy(folder, path_, std::filesystem::copy_options::recursive);
    std::ifstream in(path_ / file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the text to be spoilt is not in " + file + ": " + from);
    text.replace(at, from.size(), to);
    in.close();
    std::ofstream(path_ / file) << text;
  }
  ~FaultyFolder() { std::filesystem::remove_all(path_); }
  FaultyFolder(const FaultyFolder&) = delete;
  FaultyFolder& operator=(const FaultyFolder&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace dvrlab::test
