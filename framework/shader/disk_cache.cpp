#include "framework/shader/disk_cache.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>

#include "framework/backend/cache_folder.h"
#include "framework/report/log.h"
#include "framework/scene/sha256.h"

namespace dvrlab {
namespace {

constexpr std::size_t hash_characters = 64;

std::string hash_of(std::span<const std::byte> content) { return sha256({content}); }

void say_once(const std::string& folder, const std::string& reason) {
  static std::once_flag said;
  std::call_once(said, [&] {
    log_line("backend", "the cache " + folder + " cannot be written (" + reason + "); shaders are compiled each time");
  });
}

}  // namespace

DiskCache::DiskCache(const std::string& subfolder) : folder_(cache_folder() + "/" + subfolder) {}

std::optional<std::vector<std::byte>> DiskCache::read(const std::string& name) const {
  std::ifstream in(folder_ + "/" + name, std::ios::binary);
  if (!in) return std::nullopt;
  const std::string file{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (file.size() < hash_characters) return std::nullopt;
  const std::span bytes = std::as_bytes(std::span(file)).subspan(hash_characters);
  if (hash_of(bytes) != file.substr(0, hash_characters)) return std::nullopt;
  return std::vector<std::byte>(bytes.begin(), bytes.end());
}

void DiskCache::write(const std::string& name, std::span<const std::byte> content) const {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) return say_once(folder_, error.message());
  static int serial = 0;
  const std::string file = folder_ + "/" + name;
  const std::string fresh = file + "." + std::to_string(getpid()) + "." + std::to_string(serial++);
  {
    std::ofstream out(fresh, std::ios::binary);
    out << hash_of(content);
    out.write(reinterpret_cast<const char*>(content.data()), std::streamsize(content.size()));
    out.close();
    if (!out) {
      std::filesystem::remove(fresh, error);
      return say_once(folder_, "a file could not be written");
    }
  }
  std::filesystem::rename(fresh, file, error);
  if (error) say_once(folder_, error.message());
}

}  // namespace dvrlab
