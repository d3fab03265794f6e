#include "plugins/data/points/sample_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

#include "framework/interfaces/error.h"

namespace dvrlab::points {
namespace {

bool separates(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0 || c == ',' || c == ';'; }

/// The numbers of one line.
std::vector<double> numbers_of(std::string_view line, const std::string& where) {
  std::vector<double> out;
  for (std::size_t at = 0; at < line.size();) {
    if (separates(line[at])) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && !separates(line[end])) ++end;
    const std::string_view word = line.substr(at, end - at);
    double x = 0;
    const char* begin = word.data() + (word.front() == '+' ? 1 : 0);
    const auto [last, error] = std::from_chars(begin, word.data() + word.size(), x);
    if (error != std::errc() || last != word.data() + word.size())
      throw InputError(where + ": \"" + std::string(word.substr(0, 40)) + "\" is no number");
    out.push_back(x);
    at = end;
  }
  return out;
}

}  // namespace

Samples read_samples(std::span<const std::byte> file, long long column, const std::string& name) {
  std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  Samples s;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto first = std::find_if_not(line.begin(), line.end(), separates);
    if (first == line.end() || *first == '#' || *first == '"' || std::isalpha(static_cast<unsigned char>(*first)) != 0)
      continue;
    const std::string where = name + ": line " + std::to_string(number);
    const std::vector<double> x = numbers_of(line, where);
    const auto wanted = static_cast<std::size_t>(std::max(column + 1, 4ll));
    if (x.size() < wanted)
      throw InputError(where + ": holds " + std::to_string(x.size()) + " numbers; x, y, z and the value in column " +
                       std::to_string(column) + " need " + std::to_string(wanted));
    s.place.push_back({x[0], x[1], x[2]});
    s.value.push_back(x[static_cast<std::size_t>(column)]);
  }
  return s;
}

}  // namespace dvrlab::points
