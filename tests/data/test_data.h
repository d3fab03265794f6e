// What the tests of this folder share: plugins by name with default parameters, files that tests write themselves.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/plugin/registry.h"

namespace dvrlab::test {

using Bytes = std::vector<char>;

const Registry& registry();

/// The plugin's parameters: its defaults with `values` over them.
ParameterSet parameters(const std::string& kind, const std::string& name, const nlohmann::json& values);

std::shared_ptr<const Field> load(const std::string& name, const nlohmann::json& values,
                                  const LoadContext& context = {});
std::shared_ptr<const GridField> load_grid(const std::string& name, const nlohmann::json& values,
                                           const LoadContext& context = {});
/// What load() throws as InputError or NotSupported; "" when it throws nothing.
std::string load_error(const std::string& name, const nlohmann::json& values, const LoadContext& context = {});

bool has_note(const Field& field, const std::string& part);
Vector3 world(const Field& field, const Vector3& index);

/// A folder of this test process for files, removed at its end.
std::string scratch(const std::string& file);
void write(const std::string& path, const Bytes& bytes);
Bytes read(const std::string& path);
Bytes gzip(const Bytes& bytes);
Bytes zlib(const Bytes& bytes);
Bytes bzip2(const Bytes& bytes);
/// Two hexadecimal digits per byte, in lines.
Bytes hex(const Bytes& bytes);

inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
inline Bytes operator+(const std::string& a, const Bytes& b) { return Bytes(a.begin(), a.end()) + b; }

/// The numbers in the given byte order.
template <class T>
Bytes bytes_of_numbers(const std::vector<T>& numbers, bool big_endian) {
  Bytes out(numbers.size() * sizeof(T));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::memcpy(out.data() + i * sizeof(T), &numbers[i], sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big))
      std::reverse(out.begin() + static_cast<std::ptrdiff_t>(i * sizeof(T)),
                   out.begin() + static_cast<std::ptrdiff_t>((i + 1) * sizeof(T)));
  }
  return out;
}

/// The numbers as text, so that they read back as they were.
template <class T>
Bytes ascii(const std::vector<T>& numbers) {
  std::string text;
  for (const T x : numbers) {
    std::array<char, 40> word;
    const auto [end, error] = std::to_chars(word.data(), word.data() + word.size(), x);
    text.append(word.data(), end) += text.size() % 5 == 0 ? '\n' : ' ';
  }
  return Bytes(text.begin(), text.end());
}

/// Path of real data that the repository does not carry; "" when it is not there.
std::string shared_data(const std::string& file);

}  // namespace dvrlab::test

/// Declares `name` with the path of the data, or skips the test with the reason.
#define DVRLAB_NEED_DATA(name, path_expression) \
  const std::string name = path_expression;     \
  if (name.empty()) GTEST_SKIP() << "not supported: no data (" #path_expression ")"
