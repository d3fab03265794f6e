#include "plugins/data/dicom/elements.h"

#include <gdcmSequenceOfItems.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "framework/interfaces/error.h"

namespace dvrlab::dicom {
namespace {

gdcm::Tag tag_of(const Key& key) { return {key.group, key.element}; }

std::string_view trimmed(std::string_view s) {
  const std::string_view padding(" \t\r\n\0", 5);
  const auto first = s.find_first_not_of(padding);
  return first == std::string_view::npos ? std::string_view{}
                                         : s.substr(first, s.find_last_not_of(padding) - first + 1);
}

}  // namespace

void Elements::fail(const Key& key, const std::string& what) const {
  char tag[16];
  std::snprintf(tag, sizeof tag, "(%04x,%04x)", key.group, key.element);
  throw InputError(name_ + ": " + key.name + " " + tag + " " + what);
}

bool Elements::has(const Key& key) const {
  return set_.FindDataElement(tag_of(key)) && !set_.GetDataElement(tag_of(key)).IsEmpty();
}

std::string Elements::text(const Key& key) const {
  if (!has(key)) return "";
  const gdcm::ByteValue* bytes = set_.GetDataElement(tag_of(key)).GetByteValue();
  if (!bytes || !bytes->GetPointer()) return "";
  std::string text(trimmed({bytes->GetPointer(), static_cast<std::size_t>(bytes->GetLength())}));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return text;
}

int Elements::whole(const Key& key) const {
  const gdcm::ByteValue* bytes = has(key) ? set_.GetDataElement(tag_of(key)).GetByteValue() : nullptr;
  if (!bytes) fail(key, "is missing");
  if (bytes->GetLength() != 2) fail(key, "has " + std::to_string(bytes->GetLength()) + " bytes instead of 2");
  std::uint16_t x;  // the library has put it in this machine's byte order
  std::memcpy(&x, bytes->GetPointer(), 2);
  return x;
}

int Elements::whole(const Key& key, int otherwise) const { return has(key) ? whole(key) : otherwise; }

void Elements::fail_decimals(const Key& key, const std::string& text, std::size_t count) const {
  fail(key, "is \"" + text.substr(0, 80) + "\"; must be " +
                (count == 1 ? "a finite number" : std::to_string(count) + " finite numbers"));
}

std::vector<double> Elements::decimals(const Key& key, std::size_t count) const {
  std::vector<double> out;
  const std::string all = text(key);
  if (all.empty()) return out;
  for (std::size_t at = 0; at <= all.size();) {
    const std::size_t end = std::min(all.find('\\', at), all.size());
    std::string_view word = trimmed(std::string_view(all).substr(at, end - at));
    if (word.starts_with('+')) word.remove_prefix(1);
    double x = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), x);
    if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(x)) fail_decimals(key, all, count);
    out.push_back(x);
    at = end + 1;
  }
  if (out.size() != count) fail_decimals(key, all, count);
  return out;
}

std::optional<Elements> Elements::item(const Key& key, std::size_t index) const {
  if (!set_.FindDataElement(tag_of(key))) return std::nullopt;
  const auto items = set_.GetDataElement(tag_of(key)).GetValueAsSQ();
  if (!items || items->GetNumberOfItems() <= index) return std::nullopt;
  return Elements(items->GetItem(index + 1).GetNestedDataSet(), name_);  // the library counts from 1
}

}  // namespace dvrlab::dicom
