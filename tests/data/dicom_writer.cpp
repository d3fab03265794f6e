#include "tests/data/dicom_writer.h"

#include <utility>

namespace dvrlab::test {
namespace {

Bytes number(std::uint32_t x, int bytes, bool big) {
  Bytes out;
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>(x >> 8 * (big ? bytes - 1 - i : i)));
  return out;
}

bool has_long_length(const std::string& vr) {
  return vr == "OB" || vr == "OW" || vr == "SQ" || vr == "UN" || vr == "OF" || vr == "UT";
}

Bytes tag_bytes(std::uint32_t tag, bool big) { return number(tag >> 16, 2, big) + number(tag & 0xffffu, 2, big); }

Bytes header(std::uint32_t tag, const std::string& vr, std::uint32_t length, DicomSet::Coding coding) {
  const bool big = coding == DicomSet::Coding::explicit_big;
  Bytes out = tag_bytes(tag, big);
  if (coding == DicomSet::Coding::implicit_little) return out + number(length, 4, false);
  out = out + Bytes(vr.begin(), vr.end());
  if (has_long_length(vr)) return out + Bytes(2, 0) + number(length, 4, big);
  return out + number(length, 2, big);
}

}  // namespace

void DicomSet::text(std::uint32_t tag, const std::string& vr, const std::string& value) {
  Bytes v(value.begin(), value.end());
  if (v.size() % 2 == 1) v.push_back(vr == "UI" ? '\0' : ' ');
  element_[tag] = {vr, v, {}, false};
}

void DicomSet::whole(std::uint32_t tag, int value) {
  element_[tag] = {"US", number(static_cast<std::uint32_t>(value), 2, false), {}, false};
}

void DicomSet::bytes(std::uint32_t tag, const std::string& vr, const Bytes& value) {
  Bytes v = value;
  if (v.size() % 2 == 1) v.push_back(0);
  element_[tag] = {vr, v, {}, vr == "fragments"};
}

void DicomSet::items(std::uint32_t tag, const std::vector<DicomSet>& items) {
  element_[tag] = {"SQ", {}, items, false};
}

Bytes DicomSet::coded(Coding coding) const {
  const bool big = coding == Coding::explicit_big;
  Bytes out;
  for (const auto& [tag, e] : element_) {
    Bytes value = e.value;
    for (const DicomSet& item : e.items) {
      const Bytes inner = item.coded(coding);
      value = value + tag_bytes(0xfffee000u, big) + number(static_cast<std::uint32_t>(inner.size()), 4, big) + inner;
    }
    if (big && (e.vr == "US" || e.vr == "OW"))
      for (std::size_t i = 0; i + 1 < value.size(); i += 2) std::swap(value[i], value[i + 1]);
    const auto length = e.fragments ? 0xffffffffu : static_cast<std::uint32_t>(value.size());
    out = out + header(tag, e.fragments ? "OB" : e.vr, length, coding) + value;
  }
  return out;
}

Bytes DicomSet::file(Coding coding, const std::string& syntax) const {
  DicomSet meta;
  meta.bytes(0x00020001, "OB", Bytes{0, 1});
  meta.text(0x00020002, "UI", "1.2.840.10008.5.1.4.1.1.4");
  meta.text(0x00020003, "UI", "2.25.9");
  const std::string own = coding == Coding::explicit_little   ? "1.2.840.10008.1.2.1"
                          : coding == Coding::implicit_little ? "1.2.840.10008.1.2"
                                                              : "1.2.840.10008.1.2.2";
  meta.text(0x00020010, "UI", syntax.empty() ? own : syntax);
  const Bytes rest = meta.coded(Coding::explicit_little);
  return Bytes(128, 0) + Bytes{'D', 'I', 'C', 'M'} + header(0x00020000, "UL", 4, Coding::explicit_little) +
         number(static_cast<std::uint32_t>(rest.size()), 4, false) + rest + coded(coding);
}

DicomSet dicom_slice(int columns, int rows, const std::string& position, const Bytes& pixels) {
  static int count = 0;
  DicomSet s;
  s.text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.4");
  s.text(0x00080018, "UI", "2.25.9." + std::to_string(++count));
  s.text(0x00080060, "CS", "MR");
  s.text(0x0008103e, "LO", "made by a test");
  s.text(0x0020000d, "UI", "2.25.8");
  s.text(0x0020000e, "UI", "2.25.1");
  s.text(0x00200032, "DS", position);
  s.text(0x00200037, "DS", "1\\0\\0\\0\\1\\0");
  s.whole(0x00280002, 1);
  s.text(0x00280004, "CS", "MONOCHROME2");
  s.whole(0x00280010, rows);
  s.whole(0x00280011, columns);
  s.text(0x00280030, "DS", "1\\1");
  s.whole(0x00280100, 16);
  s.whole(0x00280101, 16);
  s.whole(0x00280102, 15);
  s.whole(0x00280103, 0);
  s.text(0x00281052, "DS", "0");
  s.text(0x00281053, "DS", "1");
  s.bytes(0x7fe00010, "OW", pixels);
  return s;
}

Bytes dicom_fragments(const Bytes& compressed) {
  Bytes padded = compressed;
  if (padded.size() % 2 == 1) padded.push_back(0);
  return tag_bytes(0xfffee000u, false) + Bytes(4, 0) + tag_bytes(0xfffee000u, false) +
         number(static_cast<std::uint32_t>(padded.size()), 4, false) + padded + tag_bytes(0xfffee0ddu, false) +
         Bytes(4, 0);
}

Bytes dicom_rle(const Bytes& pixels, std::size_t bytes_per_pixel) {
  Bytes header = number(static_cast<std::uint32_t>(bytes_per_pixel), 4, false), segments;
  for (std::size_t s = 0; s < bytes_per_pixel; ++s) {
    header = header + number(static_cast<std::uint32_t>(64 + segments.size()), 4, false);
    Bytes plane;
    for (std::size_t i = bytes_per_pixel - 1 - s; i < pixels.size(); i += bytes_per_pixel) plane.push_back(pixels[i]);
    for (std::size_t i = 0; i < plane.size(); i += 128) {
      const std::size_t n = std::min<std::size_t>(128, plane.size() - i);
      segments.push_back(static_cast<char>(n - 1));
      segments.insert(segments.end(), plane.begin() + static_cast<std::ptrdiff_t>(i),
                      plane.begin() + static_cast<std::ptrdiff_t>(i + n));
    }
    if (segments.size() % 2 == 1) segments.push_back(0);
  }
  header.resize(64, 0);
  return header + segments;
}

}  // namespace dvrlab::test
