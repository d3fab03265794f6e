#include "framework/scene/header_fields.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

template <class T>
std::vector<T> parse_all(const HeaderFields& header, const std::string& field, std::size_t count, const char* what) {
  std::vector<T> out;
  for (const std::string& word : header.words(field)) {
    const auto x = parse_number<T>(word);
    if (!x) header.fail(field, quoted(word) + " is no " + what);
    out.push_back(*x);
  }
  if (out.size() != count)
    header.fail(field, "has " + std::to_string(out.size()) + " numbers, not " + std::to_string(count));
  return out;
}

}  // namespace

std::string trimmed(const std::string& s) {
  const auto first = s.find_first_not_of(" \t");
  return first == std::string::npos ? "" : s.substr(first, s.find_last_not_of(" \t") - first + 1);
}

std::string lower_case(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

std::string quoted(const std::string& s) { return '"' + s.substr(0, 60) + '"'; }

std::string field_key(const std::string& field) {
  std::string key = lower_case(field);
  std::erase_if(key, [](char c) { return c == ' ' || c == '\t'; });
  return key;
}

void HeaderFields::add(const std::string& field, const std::string& text, int line) {
  if (!fields_.emplace(field_key(field), Line{trimmed(text), line}).second)
    throw InputError(name_ + ": line " + std::to_string(line) + ": the field " + quoted(field) + " stands twice");
}

std::optional<std::string> HeaderFields::find(const std::string& field) const {
  const auto found = fields_.find(field_key(field));
  if (found == fields_.end()) return std::nullopt;
  return found->second.text;
}

std::string HeaderFields::require(const std::string& field) const {
  const auto text = find(field);
  if (!text || text->empty()) throw InputError(name_ + ": the header lacks the field " + quoted(field));
  return *text;
}

std::vector<std::string> HeaderFields::words(const std::string& field) const {
  std::istringstream in(find(field).value_or(""));
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

std::vector<long long> HeaderFields::integers(const std::string& field, std::size_t count) const {
  require(field);
  return parse_all<long long>(*this, field, count, "whole number");
}

long long HeaderFields::integer(const std::string& field, long long otherwise) const {
  return find(field) ? integers(field, 1)[0] : otherwise;
}

std::vector<double> HeaderFields::numbers(const std::string& field, std::size_t count) const {
  if (!find(field)) return {};
  const auto out = parse_all<double>(*this, field, count, "number");
  if (std::any_of(out.begin(), out.end(), [](double x) { return std::isinf(x); }))
    fail(field, "holds a number that is not finite");
  return out;
}

void HeaderFields::fail(const std::string& field, const std::string& what) const {
  const auto found = fields_.find(field_key(field));
  const std::string line = found == fields_.end() ? "" : "line " + std::to_string(found->second.number) + ", ";
  throw InputError(name_ + ": " + line + "field \"" + field + "\": " + what);
}

}  // namespace dvrlab
