#include "framework/scene/data_files.h"

#include <filesystem>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

// "slice%03d.raw" as what stands around the number, and how the number is written.
struct Pattern {
  std::string before, after;
  std::size_t width = 0;
  char fill = ' ';
};

Pattern parse(const std::string& text, const std::string& where) {
  Pattern p;
  bool number = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string& side = number ? p.after : p.before;
    if (text[i] != '%' || text.compare(i, 2, "%%") == 0) {
      side += text[i];
      i += text[i] == '%' ? 1 : 0;
      continue;
    }
    std::size_t k = i + 1;
    if (k < text.size() && text[k] == '0') p.fill = '0';
    for (; k < text.size() && text[k] >= '0' && text[k] <= '9' && p.width < 100; ++k)
      p.width = 10 * p.width + static_cast<std::size_t>(text[k] - '0');
    const bool whole = k < text.size() && (text[k] == 'd' || text[k] == 'i' || text[k] == 'u');
    if (number || !whole) throw InputError(where + ": \"" + text + "\" must hold one number \"%d\" or \"%03d\"");
    number = true;
    i = k;
  }
  if (!number) throw InputError(where + ": \"" + text + "\" holds no number \"%d\"");
  return p;
}

}  // namespace

std::vector<std::string> numbered_names(const std::string& pattern, long long first, long long last, long long step,
                                        long long most, const std::string& where) {
  const Pattern p = parse(pattern, where);
  if (step == 0) throw InputError(where + ": the step of the numbers is 0");
  std::vector<std::string> names;
  for (long long n = first; step > 0 ? n <= last : n >= last;) {
    if (static_cast<long long>(names.size()) == most)
      throw InputError(where + ": the numbers name more than the grid's " + std::to_string(most) + " slices");
    const std::string digits = std::to_string(n);
    names.push_back(p.before + std::string(p.width - std::min(p.width, digits.size()), p.fill) + digits + p.after);
    if (__builtin_add_overflow(n, step, &n)) break;
  }
  return names;
}

std::vector<FilePart> open_data_files(const DataFiles& files, const std::array<long long, 3>& dims,
                                      const std::string& header_file) {
  const auto count = static_cast<long long>(files.names.size());
  long long pieces = 1;  // grid_bytes() has seen to it that the products fit
  for (auto a = static_cast<std::size_t>(files.axes); a < 3; ++a) pieces *= dims[a];
  if (files.axes == 3 ? count < 1 || dims[2] % count != 0 : count != pieces)
    throw InputError(
        header_file + ": names " + std::to_string(count) + " data files; its " + std::to_string(dims[0]) + " x " +
        std::to_string(dims[1]) + " x " + std::to_string(dims[2]) + " voxels need " +
        (files.axes == 3 ? "one, or a number that divides its slices evenly" : std::to_string(pieces) + " of them"));
  std::vector<FilePart> parts;
  for (const std::string& name : files.names) {
    const auto path = std::filesystem::path(header_file).parent_path() / name;
    std::error_code error;
    if (!std::filesystem::exists(path, error))
      throw InputError(header_file + ": its data file " + path.string() + " does not exist");
    const auto file = MappedFile::open(path.string());
    parts.push_back({file, file->bytes()});
  }
  return parts;
}

}  // namespace dvrlab
