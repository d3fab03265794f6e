#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "framework/config/axes.h"
#include "framework/config/check_value.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

std::string plain_label(const ConfigJson& v) {
  if (v.is_object()) return v.contains("type") && v["type"].is_string() ? v["type"].get<std::string>() : "section";
  if (v.is_string()) return v.get<std::string>();
  if (v.is_number_float() && v.get<double>() == std::floor(v.get<double>()) && std::abs(v.get<double>()) < 1e15) {
    return std::to_string(static_cast<long long>(v.get<double>()));
  }
  if (!v.is_array()) return v.dump();
  if (v.empty()) return "none";
  std::vector<std::string> labels;
  for (const ConfigJson& x : v) labels.push_back(plain_label(x));
  return join_words(labels, "+");
}

/// Names the other keys too, for sections of one type.
std::string long_label(const ConfigJson& v) {
  if (!v.is_object()) return plain_label(v);
  std::string text = plain_label(v);
  for (const auto& [key, value] : v.items()) {
    if (key != "type" && !value.is_structured()) text += "+" + key + "=" + plain_label(value);
  }
  return text;
}

/// Equal values share a label: a zip may repeat them.
void label_values(std::vector<AxisValue>& values) {
  std::map<std::string, std::vector<std::size_t>> plain, full;  // label -> the different values that would have it
  const auto note = [&](std::vector<std::size_t>& known, std::size_t i) {
    const auto same = [&](std::size_t k) { return values[k].value == values[i].value; };
    if (std::none_of(known.begin(), known.end(), same)) known.push_back(i);
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    note(plain[file_safe(plain_label(values[i].value))], i);
    note(full[file_safe(long_label(values[i].value))], i);
  }
  for (AxisValue& v : values) {
    v.label = file_safe(plain_label(v.value));
    if (plain[v.label].size() == 1) continue;
    v.label = file_safe(long_label(v.value));
    const std::vector<std::size_t>& alike = full[v.label];
    const auto equal = [&](std::size_t k) { return values[k].value == v.value; };
    if (alike.size() > 1) v.label += "+" + std::to_string(*std::find_if(alike.begin(), alike.end(), equal));
  }
}

bool range_numbers(const ConfigJson& range, std::size_t count) {
  if (!range.is_array() || range.size() != count) return false;
  for (const ConfigJson& x : range) {
    if (!x.is_number()) return false;
  }
  return true;
}

/// As it would be written: whole numbers without a point, so that keys that take nothing else can be varied.
ConfigJson number_of(double x) {
  return x == std::floor(x) && std::abs(x) < 9e15 ? ConfigJson(static_cast<std::int64_t>(x)) : ConfigJson(x);
}

/// The numbers of {"lin" | "log2" | "log10": [...]}; empty when it is none of these.
std::vector<double> range_values(const ConfigJson& v) {
  std::vector<double> values;
  if (!v.is_object() || v.size() != 1) return values;
  const std::string how = v.begin().key();
  const ConfigJson& range = v.begin().value();
  if (how == "lin" && range_numbers(range, 3)) {
    const double a = range[0].get<double>(), b = range[1].get<double>(), n = range[2].get<double>();
    if (n < 2 || n > most_axis_values || n != std::floor(n)) return values;
    for (int i = 0; i < static_cast<int>(n); ++i) values.push_back(a + (b - a) * i / (n - 1));
  } else if ((how == "log2" || how == "log10") && range_numbers(range, 2)) {
    const double base = how == "log2" ? 2 : 10, a = range[0].get<double>(), b = range[1].get<double>();
    if (!(a > 0) || !(b > 0)) return values;
    const double factor = b < a ? 1 / base : base;
    // The last value belongs to the range when it is met up to rounding.
    const int count = static_cast<int>(std::floor(std::abs(std::log(b / a)) / std::log(base) + 1e-9)) + 1;
    for (int i = 0; i < std::min(count, most_axis_values); ++i) values.push_back(a * std::pow(factor, i));
  }
  return values;
}

}  // namespace

std::vector<AxisValue> axis_values(const ConfigTree& tree, const std::string& path, const ConfigJson& written,
                                   Problems& problems) {
  std::vector<AxisValue> values;
  if (written.is_array()) {
    for (std::size_t i = 0; i < written.size(); ++i) values.push_back({written[i], "", child_path(path, i)});
  } else {
    for (const double x : range_values(written)) values.push_back({number_of(x), "", child_path(path, values.size())});
  }
  if (values.empty()) {
    problems.add(
        tree.where(path) + ": found " + short_text(written) +
        R"(; must be a list of values that is not empty, {"lin": [first, last, count]}, {"log2": [first, last]} or {"log10": [first, last]})");
  }
  label_values(values);
  return values;
}

std::string file_safe(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                      std::string("._=,+-").find(c) != std::string::npos;
    safe += good ? c : '_';
  }
  if (safe.empty() || safe.front() == '.' || safe.front() == '-') safe.insert(0, 1, '_');
  return safe;
}

}  // namespace dvrlab
