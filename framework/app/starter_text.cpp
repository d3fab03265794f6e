#include "framework/app/starter_text.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/report/number_text.h"

namespace dvrlab {
namespace {

std::string path_in(const std::string& folder, const std::string& file) {
  const std::string absolute = std::filesystem::weakly_canonical(file).string();
  const std::string relative = std::filesystem::proximate(absolute, folder).string();
  return relative.starts_with("../../../") ? absolute : relative;
}

}  // namespace

std::string filled(std::string_view form, const StarterWords& words) {
  std::string text;
  for (std::size_t at = 0;;) {
    const std::size_t open = form.find('$', at);
    text += form.substr(at, open - at);
    if (open == std::string_view::npos) return text;
    const std::size_t close = form.find('$', open + 1);
    text += words.find(form.substr(open + 1, close - open - 1))->second;
    at = close + 1;
  }
}

std::string data_section_in(const std::string& folder, const LoadedData& data) {
  const auto entry = [](const std::string& key, const nlohmann::json& value) {
    return nlohmann::json(key).dump() + ": " + value.dump();
  };
  std::string text = "{ " + entry("type", data.type) + ", " + entry("file", path_in(folder, data.field->source));
  for (const auto& [key, value] : data.section.items())
    if (key != "type" && key != "file") text += ", " + entry(key, value);
  return text + " }";
}

std::string file_name_of(const LoadedData& data) {
  return std::filesystem::path(data.field->source).filename().string();
}

std::string vector_text(const Vector3& v) {
  std::string text;
  for (double x : v) text += (text.empty() ? "[" : ", ") + number_text(std::fabs(x) < 5e-4 ? 0 : x, 3);
  return text + "]";
}

std::string node_text(double value, const std::string& rest) { return "[" + number_text(value) + ", " + rest + "]"; }

std::string axes_text(const Field& field) {
  return field.anatomical ? "x points to the patient's right, y to the front, z up."
                          : "x, y and z are the file's axes; nothing says which one is up, so it is z.";
}

}  // namespace dvrlab
