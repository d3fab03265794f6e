#include "plugins/data/vtk/vtk_file.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <map>

#include "framework/interfaces/error.h"
#include "framework/scene/mesh/mesh_array.h"

namespace dvrlab::vtk {
namespace {

/// Words and blocks of numbers, one after the other.
class Scanner {
 public:
  Scanner(std::span<const std::byte> file, const std::string& name)
      : text_(reinterpret_cast<const char*>(file.data()), file.size()), name_(name) {}

  const std::string& name() const { return name_; }
  std::uint64_t at() const { return at_; }
  bool done() {
    skip_space();
    return at_ == text_.size();
  }
  std::string word() {
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return std::string(text_.substr(begin, std::min<std::size_t>(at_ - begin, 256)));
  }
  /// The next word without taking it.
  std::string ahead() {
    const std::uint64_t kept = at_;
    std::string w = word();
    at_ = kept;
    return w;
  }
  /// What is left of the line, without blanks around it.
  std::string line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string l(text_.substr(at_, std::min<std::size_t>(end - at_, 512)));
    at_ = std::min(end + 1, text_.size());
    const auto solid = [](char c) { return !is_space(c); };
    l.erase(l.begin(), std::find_if(l.begin(), l.end(), solid));
    l.erase(std::find_if(l.rbegin(), l.rend(), solid).base(), l.end());
    return l;
  }
  /// What is left of this line, and all lines up to an empty one.
  void skip_paragraph() {
    line();
    while (at_ < text_.size() && !line().empty()) {
    }
  }
  std::uint64_t natural(const std::string& where) {
    const std::string w = word();
    std::uint64_t x = 0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), x);
    if (error != std::errc() || end != w.data() + w.size() || w.empty())
      throw InputError(where + ": \"" + w.substr(0, 40) + "\" is no whole number of at least 0");
    return x;
  }
  /// Passes `count` numbers.
  Numbers numbers(SourceType type, std::uint64_t count, bool binary, const std::string& where) {
    const std::uint64_t left = text_.size() - at_;
    Numbers n{type, count, 0, where};
    if (binary) {
      // The numbers begin behind the end of the line.
      while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      at_ = std::min<std::uint64_t>(at_ + 1, text_.size());
      if (count > (text_.size() - at_) / bytes_of(type)) truncated(where, count, (text_.size() - at_) / bytes_of(type));
      n.at = at_;
      at_ += count * bytes_of(type);
      return n;
    }
    if (count > left / 2 + 1) truncated(where, count, left / 2 + 1);
    n.at = at_;
    for (std::uint64_t k = 0; k < count; ++k) {
      skip_space();
      if (at_ == text_.size()) truncated(where, count, k);
      while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    }
    return n;
  }

 private:
  static bool is_space(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
  void skip_space() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }
  [[noreturn]] static void truncated(const std::string& where, std::uint64_t wanted, std::uint64_t most) {
    throw InputError(where + ": needs " + std::to_string(wanted) + " numbers, the file holds at most " +
                     std::to_string(most) + " more; it is cut off or its header is wrong");
  }
  std::string_view text_;
  const std::string& name_;
  std::uint64_t at_ = 0;
};

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return std::tolower(c); });
  return s;
}
std::string upper(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return std::toupper(c); });
  return s;
}

SourceType type_of(const std::string& word, const std::string& where) {
  using enum SourceType;
  static const std::map<std::string, SourceType> types = {
      {"char", i8},          {"signed_char", i8},     {"unsigned_char", u8},
      {"short", i16},        {"unsigned_short", u16}, {"int", i32},
      {"unsigned_int", u32}, {"long", i64},           {"unsigned_long", u64},
      {"vtkidtype", i64},    {"vtktypeint64", i64},   {"vtktypeuint64", u64},
      {"float", f32},        {"double", f64}};
  const auto found = types.find(lower(word));
  if (found == types.end())
    throw InputError(where + ": \"" + word.substr(0, 40) +
                     "\" is no type that is read; char to long, signed or unsigned, float and double are");
  return found->second;
}

/// Names of arrays have %20 for a blank.
std::string decoded(const std::string& s) {
  std::string out;
  for (std::size_t k = 0; k < s.size(); ++k) {
    int code = 0;
    if (s[k] == '%' && k + 2 < s.size() &&
        std::from_chars(s.data() + k + 1, s.data() + k + 3, code, 16).ptr == s.data() + k + 3) {
      out += static_cast<char>(code);
      k += 2;
    } else {
      out += s[k];
    }
  }
  return out;
}

class Sections {
 public:
  Sections(std::span<const std::byte> file, const std::string& name) : s_(file, name) {}

  VtkFile read() {
    read_head();
    while (!s_.done()) read_section(upper(s_.word()));
    if (f_.places.where.empty()) throw InputError(s_.name() + ": holds no POINTS");
    if (f_.connectivity.where.empty()) throw InputError(s_.name() + ": holds no CELLS");
    if (f_.types.where.empty()) throw InputError(s_.name() + ": holds no CELL_TYPES");
    if (f_.types.count != f_.cells)
      throw InputError(s_.name() + ": CELLS are " + std::to_string(f_.cells) + ", CELL_TYPES " +
                       std::to_string(f_.types.count));
    return std::move(f_);
  }

 private:
  std::string where(const std::string& section) const { return s_.name() + ": " + section; }

  void read_head() {
    const std::string magic = s_.line();
    const std::string begin = "# vtk DataFile Version ";
    if (magic.compare(0, begin.size(), begin) != 0)
      throw InputError(s_.name() + ": does not begin with \"" + begin + "\"");
    s_.line();  // a title
    const std::string coding = upper(s_.word());
    if (coding != "ASCII" && coding != "BINARY")
      throw InputError(s_.name() + ": line 3 is \"" + coding.substr(0, 40) + "\"; must be ASCII or BINARY");
    f_.binary = coding == "BINARY";
    const std::string word = upper(s_.word()), kind = upper(s_.word());
    if (word != "DATASET" || kind != "UNSTRUCTURED_GRID")
      throw InputError(s_.name() + ": line 4 is \"" + word.substr(0, 40) + " " + kind.substr(0, 40) +
                       "\"; only DATASET UNSTRUCTURED_GRID is read");
  }

  Numbers numbers(SourceType type, std::uint64_t entries, std::uint64_t components, const std::string& section) {
    std::uint64_t count = 0;
    if (__builtin_mul_overflow(entries, components, &count) || count >> 56)
      throw InputError(where(section) + ": its size overflows; no file holds such an array");
    return s_.numbers(type, count, f_.binary, where(section));
  }

  void read_section(const std::string& key) {
    if (key == "POINTS") {
      f_.points = s_.natural(where(key));
      const SourceType type = type_of(s_.word(), where(key));
      f_.places = numbers(type, f_.points, 3, key);
    } else if (key == "CELLS") {
      read_cells();
    } else if (key == "CELL_TYPES") {
      const std::uint64_t n = s_.natural(where(key));
      f_.types = numbers(SourceType::i32, n, 1, key);
    } else if (key == "POINT_DATA" || key == "CELL_DATA") {
      of_cells_ = key == "CELL_DATA";
      entries_ = s_.natural(where(key));
      const std::uint64_t expected = of_cells_ ? f_.cells : f_.points;
      if (entries_ != expected)
        throw InputError(where(key) + ": is for " + std::to_string(entries_) + ", but there are " +
                         std::to_string(expected) + (of_cells_ ? " cells" : " points"));
    } else if (key == "METADATA") {
      s_.skip_paragraph();
    } else if (key == "FIELD") {
      read_field();
    } else {
      read_attribute(key);
    }
  }

  void read_cells() {
    const std::uint64_t n = s_.natural(where("CELLS")), size = s_.natural(where("CELLS"));
    if (upper(s_.ahead()) != "OFFSETS") {
      f_.cells = n;
      f_.connectivity = numbers(SourceType::i32, size, 1, "CELLS");
      return;
    }
    s_.word();
    f_.counted = false;
    const SourceType offset_type = type_of(s_.word(), where("OFFSETS"));
    f_.offsets = numbers(offset_type, n, 1, "OFFSETS");
    f_.cells = n > 0 ? n - 1 : 0;
    const std::string word = upper(s_.word());
    if (word != "CONNECTIVITY") throw InputError(where("CELLS") + ": CONNECTIVITY does not follow OFFSETS");
    const SourceType type = type_of(s_.word(), where(word));
    f_.connectivity = numbers(type, size, 1, word);
  }

  void read_field() {
    s_.word();  // its name
    const std::uint64_t arrays = s_.natural(where("FIELD"));
    for (std::uint64_t k = 0; k < arrays; ++k) {
      if (upper(s_.ahead()) == "METADATA") {
        s_.word();
        read_section("METADATA");
      }
      const std::string name = decoded(s_.word());
      const std::string section = "FIELD array \"" + name + "\"";
      const std::uint64_t components = s_.natural(where(section)), entries = s_.natural(where(section));
      const std::string type = s_.word();
      if (lower(type) == "string") throw InputError(where(section) + ": arrays of text are not read");
      const Numbers n = numbers(type_of(type, where(section)), entries, components, section);
      if (in_data() && entries == entries_ && components < (1u << 31))
        f_.arrays.push_back({name, static_cast<long long>(components), of_cells_, false, n});
    }
  }

  bool in_data() const { return entries_ > 0; }

  void read_attribute(const std::string& key) {
    static const std::map<std::string, long long> fixed = {{"VECTORS", 3},  {"NORMALS", 3},    {"TENSORS", 9},
                                                           {"TENSORS6", 6}, {"GLOBAL_IDS", 1}, {"PEDIGREE_IDS", 1}};
    const std::string name = decoded(s_.word()), section = key + " \"" + name + "\"";
    if (key == "LOOKUP_TABLE") {
      numbers(f_.binary ? SourceType::u8 : SourceType::f32, s_.natural(where(section)), 4, section);
      return;
    }
    if (key == "COLOR_SCALARS") {
      numbers(f_.binary ? SourceType::u8 : SourceType::f32, entries_, s_.natural(where(section)), section);
      return;
    }
    DataArray a{name, 1, of_cells_, false, {}};
    SourceType type = SourceType::f32;
    if (key == "SCALARS") {
      type = type_of(s_.word(), where(section));
      const std::string rest = s_.line();
      if (!rest.empty()) {
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), a.components);
        if (error != std::errc() || end != rest.data() + rest.size() || a.components < 1)
          throw InputError(where(section) + ": \"" + rest.substr(0, 40) + "\" is no number of components");
      }
      // VTK takes the first scalars as the active ones.
      a.active = std::none_of(f_.arrays.begin(), f_.arrays.end(),
                              [&](const DataArray& b) { return b.active && b.cells == of_cells_; });
      if (upper(s_.ahead()) == "LOOKUP_TABLE") {
        s_.word();
        s_.word();
      }
    } else if (key == "TEXTURE_COORDINATES") {
      a.components = static_cast<long long>(std::min<std::uint64_t>(s_.natural(where(section)), 64));
      type = type_of(s_.word(), where(section));
    } else if (fixed.contains(key)) {
      a.components = fixed.at(key);
      type = type_of(s_.word(), where(section));
    } else {
      throw InputError(s_.name() + ": \"" + key.substr(0, 40) +
                       "\" begins no section of an unstructured grid (near byte " + std::to_string(s_.at()) + ")");
    }
    if (!in_data()) throw InputError(where(section) + ": stands before POINT_DATA and CELL_DATA");
    a.numbers = numbers(type, entries_, static_cast<std::uint64_t>(a.components), section);
    f_.arrays.push_back(std::move(a));
  }

  Scanner s_;
  VtkFile f_;
  bool of_cells_ = false;
  std::uint64_t entries_ = 0;  // of the arrays that follow
};

/// Calls add with the words of ASCII numbers.
template <class T>
std::vector<T> parsed(std::span<const std::byte> file, const Numbers& n) {
  std::vector<T> out;
  out.reserve(n.count);
  const char* at = reinterpret_cast<const char*>(file.data()) + n.at;
  const char* const end = reinterpret_cast<const char*>(file.data()) + file.size();
  const auto space = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  for (std::uint64_t k = 0; k < n.count; ++k) {
    at = std::find_if_not(at, end, space);
    const char* const stop = std::find_if(at, end, space);
    T x{};
    const auto [last, error] = std::from_chars(at != stop && *at == '+' ? at + 1 : at, stop, x);
    if (error != std::errc() || last != stop)
      throw InputError(n.where + ": number " + std::to_string(k) + ", \"" +
                       std::string(at, std::min<std::ptrdiff_t>(stop - at, 40)) + "\", is no number of its type");
    out.push_back(x);
    at = stop;
  }
  return out;
}

SourceVoxels stored(std::span<const std::byte> file, const Numbers& n) {
  // Binary numbers are big-endian. The memory is the mapped file's, which the caller holds.
  return {n.type, std::endian::native == std::endian::little, {std::shared_ptr<const void>(), file.data() + n.at}};
}

}  // namespace

VtkFile read_sections(std::span<const std::byte> file, const std::string& name) { return Sections(file, name).read(); }

std::vector<double> doubles_of(const VtkFile& f, std::span<const std::byte> file, const Numbers& n) {
  return f.binary ? to_doubles(stored(file, n), n.count) : parsed<double>(file, n);
}

std::vector<std::int64_t> integers_of(const VtkFile& f, std::span<const std::byte> file, const Numbers& n) {
  return f.binary ? to_integers(stored(file, n), n.count, n.where) : parsed<std::int64_t>(file, n);
}

}  // namespace dvrlab::vtk
