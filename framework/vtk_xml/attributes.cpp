#include "framework/vtk_xml/attributes.h"

#include <charconv>
#include <cmath>
#include <sstream>

#include "framework/interfaces/error.h"

namespace dvrlab::vtk_xml {
namespace {

template <class T>
bool parse(const std::string& word, T& x) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
  return error == std::errc() && end == word.data() + word.size();
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

std::string shown(const std::string& text) { return '"' + text.substr(0, 80) + '"'; }

}  // namespace

void Attributes::fail(const std::string& what) const {
  throw InputError(name_ + ": line " + std::to_string(element_.line) + ": <" + element_.name + "> " + what);
}

std::string Attributes::text(const std::string& attribute, const std::string& otherwise) const {
  return has(attribute) ? element_.attributes.at(attribute) : otherwise;
}

std::string Attributes::require(const std::string& attribute) const {
  if (!has(attribute)) fail("lacks the attribute " + attribute);
  return element_.attributes.at(attribute);
}

std::vector<long long> Attributes::integers(const std::string& attribute, std::size_t count) const {
  const std::string all = require(attribute);
  std::vector<long long> out;
  for (const std::string& word : words(all)) {
    int x = 0;
    if (!parse(word, x)) fail(attribute + ": " + shown(word) + " is no whole number of 32 bits");
    out.push_back(x);
  }
  if (out.size() != count) fail(attribute + " is " + shown(all) + "; must be " + std::to_string(count) + " numbers");
  return out;
}

std::vector<double> Attributes::numbers(const std::string& attribute, std::size_t count) const {
  std::vector<double> out;
  if (!has(attribute)) return out;
  const std::string all = element_.attributes.at(attribute);
  for (const std::string& word : words(all)) {
    double x = 0;
    if (!parse(word, x) || !std::isfinite(x)) fail(attribute + ": " + shown(word) + " is no finite number");
    out.push_back(x);
  }
  if (out.size() != count) fail(attribute + " is " + shown(all) + "; must be " + std::to_string(count) + " numbers");
  return out;
}

unsigned long long Attributes::natural(const std::string& attribute, unsigned long long otherwise) const {
  if (!has(attribute)) return otherwise;
  unsigned long long x = 0;
  if (!parse(element_.attributes.at(attribute), x))
    fail(attribute + ": " + shown(element_.attributes.at(attribute)) + " is no whole number of at least 0");
  return x;
}

}  // namespace dvrlab::vtk_xml
