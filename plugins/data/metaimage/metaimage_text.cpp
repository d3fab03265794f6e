#include "plugins/data/metaimage/metaimage_text.h"

#include <algorithm>
#include <string_view>

#include "framework/interfaces/error.h"

namespace dvrlab::metaimage {
namespace {

constexpr std::size_t longest_header = 1 << 20;

const std::vector<std::string> known_keys{"AcquisitionDate",
                                          "AnatomicalOrientation",
                                          "BinaryData",
                                          "BinaryDataByteOrderMSB",
                                          "CenterOfRotation",
                                          "Color",
                                          "Comment",
                                          "CompressedData",
                                          "CompressedDataSize",
                                          "CompressionLevel",
                                          "DimSize",
                                          "DistanceUnits",
                                          "ElementByteOrderMSB",
                                          "ElementDataFile",
                                          "ElementMax",
                                          "ElementMin",
                                          "ElementNBits",
                                          "ElementNumberOfChannels",
                                          "ElementSize",
                                          "ElementSpacing",
                                          "ElementToIntensityFunctionOffset",
                                          "ElementToIntensityFunctionSlope",
                                          "ElementType",
                                          "HeaderSize",
                                          "ID",
                                          "Modality",
                                          "Name",
                                          "NDims",
                                          "ObjectSubType",
                                          "ObjectType",
                                          "Offset",
                                          "Orientation",
                                          "Origin",
                                          "ParentID",
                                          "Position",
                                          "Rotation",
                                          "SequenceID",
                                          "TransformMatrix",
                                          "TransformType"};

bool is_known(const std::string& key) {
  return std::any_of(known_keys.begin(), known_keys.end(),
                     [&](const std::string& k) { return field_key(k) == field_key(key); });
}

}  // namespace

MetaText::MetaText(std::span<const std::byte> file, const std::string& name) : HeaderFields(name) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), std::min(file.size(), longest_header));
  bool listing = false;
  for (int number = 1; end_ < text.size() && (listing || !find("ElementDataFile")); ++number) {
    const std::size_t stop = std::min(text.find('\n', end_), text.size());
    std::string line(text.substr(end_, stop - end_));
    if (line.ends_with('\r')) line.pop_back();
    end_ = std::min(stop + 1, text.size());
    if (trimmed(line).empty()) continue;
    if (listing) {
      listed_.push_back(trimmed(line));
      continue;
    }
    add_line(line, number);
    const std::vector<std::string> data = words("ElementDataFile");
    listing = !data.empty() && data[0] == "LIST";
  }
  if (!find("ElementDataFile"))
    throw InputError(name + ": the header lacks the field \"ElementDataFile\", which ends it; the file is cut off");
}

void MetaText::add_line(const std::string& line, int number) {
  const std::size_t equals = line.find('=');
  const std::string key = trimmed(line.substr(0, equals));
  if (number == 1 && (equals == std::string::npos || !is_known(key)))
    throw InputError(name() + ": is no MetaImage file; it does not start with \"ObjectType = Image\"");
  if (equals == std::string::npos || key.empty()) {
    const bool readable = std::all_of(line.begin(), line.end(), [](unsigned char c) { return c >= 32 || c == '\t'; });
    throw InputError(name() + ": line " + std::to_string(number) +
                     (readable ? " is no field \"Key = value\": " + quoted(line)
                               : " is binary; \"ElementDataFile = LOCAL\" must separate the header from the voxels"));
  }
  if (!is_known(key)) unknown_.push_back(key);
  add(key, line.substr(equals + 1), number);
}

std::string MetaText::one_of(const std::vector<std::string>& fields) const {
  std::string found;
  for (const std::string& field : fields) {
    if (!find(field)) continue;
    if (found.empty())
      found = field;
    else if (find(field) != find(found))
      fail(field, "differs from " + quoted(found) + ", which means the same; remove one of them");
  }
  return found;
}

bool MetaText::flag(const std::string& field, bool otherwise) const {
  const auto text = find(field);
  if (!text) return otherwise;
  const std::string word = lower_case(*text);
  if (word == "true" || word == "t" || word == "1") return true;
  if (word == "false" || word == "f" || word == "0") return false;
  fail(field, "is " + quoted(*text) + "; must be True or False");
}

}  // namespace dvrlab::metaimage
