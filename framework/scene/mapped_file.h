// A file's bytes as memory, read only. The pages are the kernel's: nothing is allocated.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace dvrlab {

class MappedFile {
 public:
  /// Throws InputError when the file cannot be opened, is a folder or is empty.
  static std::shared_ptr<const MappedFile> open(const std::string& file);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::span<const std::byte> bytes() const { return {static_cast<const std::byte*>(data_), size_}; }

 private:
  MappedFile(void* data, std::size_t size) : data_(data), size_(size) {}
  void* data_;
  std::size_t size_;
};

}  // namespace dvrlab
