// Where the program starts: errors become one line each on stderr and an exit code (verbs.h).
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include "framework/app/command_line.h"
#include "framework/interfaces/error.h"

namespace {

void print_errors(const std::string& lines) {
  std::size_t begin = 0;
  while (begin <= lines.size()) {
    const std::size_t end = std::min(lines.find('\n', begin), lines.size());
    std::fprintf(stderr, "error: %s\n", lines.substr(begin, end - begin).c_str());
    begin = end + 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int code = dvrlab::run_command_line(argc, argv);
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    print_errors("stdout: cannot be written (is the disk full?)");
    return 3;
  } catch (const dvrlab::InputError& e) {
    print_errors(e.what());
    return 2;
  } catch (const std::exception& e) {  // NotSupported among them
    print_errors(e.what());
    return 3;
  }
}
