#include "framework/scene/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "framework/interfaces/error.h"

namespace dvrlab {

std::shared_ptr<const MappedFile> MappedFile::open(const std::string& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe is refused, not waited for
  if (descriptor < 0) throw InputError(file + ": cannot be opened: " + std::strerror(errno));
  struct stat status {};
  const bool known = ::fstat(descriptor, &status) == 0;
  const auto size = static_cast<std::size_t>(status.st_size);
  void* data = MAP_FAILED;
  std::string reason;
  if (!known || !S_ISREG(status.st_mode)) {
    reason = "is no regular file";
  } else if (size == 0) {
    reason = "is empty";
  } else {
    data = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (data == MAP_FAILED) reason = std::string("cannot be mapped: ") + std::strerror(errno);
  }
  ::close(descriptor);
  if (data == MAP_FAILED) throw InputError(file + ": " + reason);
  return std::shared_ptr<const MappedFile>(new MappedFile(data, size));
}

MappedFile::~MappedFile() { ::munmap(data_, size_); }

}  // namespace dvrlab
