// Files that save time and may vanish: compiled shaders and pipelines.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dvrlab {

/// A folder below cache_folder() (framework/backend). Entries carry the hash of
/// their content: a damaged one counts as absent. They appear at once (rename), so readers never see half of one.
/// A folder that cannot be written is said once on stderr, then nothing is kept.
class DiskCache {
 public:
  explicit DiskCache(const std::string& subfolder);
  const std::string& folder() const { return folder_; }
  std::optional<std::vector<std::byte>> read(const std::string& name) const;
  void write(const std::string& name, std::span<const std::byte> content) const;

 private:
  std::string folder_;
};

}  // namespace dvrlab
