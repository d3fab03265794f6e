#include "framework/shader/device_choice.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

}  // namespace

int choose_device(const std::string& interface_name, const std::string& wanted, const std::vector<std::string>& names) {
  const int count = int(names.size());
  int index = -1;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  const bool is_index = error == std::errc() && end == wanted.data() + wanted.size();
  if (is_index && index >= 0 && index < count) return index;
  for (int d = 0; d < count && !is_index; ++d)
    if (lower_case(names[std::size_t(d)]).find(lower_case(wanted)) != std::string::npos) return d;
  std::string list;
  for (int d = 0; d < count; ++d) list += "\n  " + std::to_string(d) + ": " + names[std::size_t(d)];
  throw NotSupported("no " + interface_name + " device is called \"" + wanted + "\" (backend.device); there is" +
                     (list.empty() ? " none" : ":" + list));
}

}  // namespace dvrlab
