#include "tests/fuzz/fuzz_target.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>

#include "framework/interfaces/error.h"

namespace dvrlab::fuzz {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void wrong(const char* what, const char* message) {
  std::fprintf(stderr, "fuzz: %s: %s\n", what, message);
  std::abort();
}

void expect_sentence(const char* message) {
  if (std::strlen(message) < 10) wrong("an error without a sentence", message);
}

/// In memory where the system has such a folder. A folder of its own: readers of series look at the neighbours.
struct Folder {
  fs::path path = (fs::is_directory("/dev/shm") ? fs::path("/dev/shm") : fs::temp_directory_path()) /
                  ("dvrlab_fuzz_" + std::to_string(::getpid()));
  std::string file = (path / "input").string();
  Folder() { fs::create_directories(path); }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

}  // namespace

void expect_result_or_error(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& e) {
    expect_sentence(e.what());
  } catch (const NotSupported& e) {
    expect_sentence(e.what());
  } catch (const std::exception& e) {
    wrong("an exception that is no error for users", e.what());
  } catch (...) {
    wrong("an exception that is no error for users", "of unknown type");
  }
}

const std::string& input_file(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  std::ofstream out(folder.file, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  out.close();
  if (!out) wrong("cannot write the input", folder.file.c_str());
  return folder.file;
}

}  // namespace dvrlab::fuzz
