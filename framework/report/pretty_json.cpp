#include "framework/report/pretty_json.h"

namespace dvrlab {
namespace {

using nlohmann::ordered_json;

std::string plain(const ordered_json& v) { return v.dump(-1, ' ', false, ordered_json::error_handler_t::replace); }

/// True for plain values and lists of them.
bool on_one_line(const ordered_json& v) {
  if (v.empty() || !v.is_structured()) return true;
  if (!v.is_array()) return false;
  for (const ordered_json& x : v) {
    if (x.is_structured()) return false;
  }
  return true;
}

}  // namespace

std::string pretty_json(const ordered_json& v, int indent) {
  if (on_one_line(v)) return plain(v);
  const std::string inner(static_cast<std::size_t>(indent) + 2, ' ');
  std::string text;
  for (const auto& [key, value] : v.items()) {
    text += text.empty() ? "\n" : ",\n";
    text += inner;
    if (v.is_object()) text.append(plain(key)).append(": ");
    text += pretty_json(value, indent + 2);
  }
  text.append("\n").append(static_cast<std::size_t>(indent), ' ');
  return v.is_object() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace dvrlab
