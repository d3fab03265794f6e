#include "tests/data/vti_writer.h"

#ifdef DVRLAB_TEST_COMPRESSORS  // without them the vti plugin is not built, and its tests say so
#include <lz4.h>
#include <lzma.h>
#endif
#include <zlib.h>

namespace dvrlab::test {
namespace {

Bytes packed(const Bytes& in, const std::string& compressor) {
  Bytes out(in.size() * 2 + 1024);
  if (compressor == "vtkZLibDataCompressor") {
    uLongf size = out.size();
    compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(in.data()), in.size());
    out.resize(size);
    return out;
  }
#ifdef DVRLAB_TEST_COMPRESSORS
  if (compressor == "vtkLZ4DataCompressor") {
    out.resize(static_cast<std::size_t>(
        LZ4_compress_default(in.data(), out.data(), static_cast<int>(in.size()), static_cast<int>(out.size()))));
    return out;
  }
  if (compressor == "vtkLZMADataCompressor") {
    std::size_t size = 0;
    if (lzma_easy_buffer_encode(0, LZMA_CHECK_CRC32, nullptr, reinterpret_cast<const std::uint8_t*>(in.data()),
                                in.size(), reinterpret_cast<std::uint8_t*>(out.data()), &size, out.size()) != LZMA_OK)
      throw std::logic_error("liblzma cannot encode");
    out.resize(size);
    return out;
  }
#endif
  throw std::logic_error("no compressor " + compressor);
}

Bytes words(const std::vector<std::uint64_t>& numbers, const VtiCoding& c) {
  if (c.word == 8) return bytes_of_numbers(numbers, c.big_endian);
  return bytes_of_numbers(std::vector<std::uint32_t>(numbers.begin(), numbers.end()), c.big_endian);
}

}  // namespace

Bytes vti_base64(const Bytes& bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  Bytes out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t x = 0;
    for (std::size_t k = 0; k < 3; ++k)
      x = x << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out.push_back(i + k <= bytes.size() ? digits[x >> (18 - 6 * k) & 63u] : '=');
  }
  return out;
}

std::pair<Bytes, Bytes> vti_binary(const Bytes& bytes, const VtiCoding& c) {
  if (c.compressor.empty()) return {words({bytes.size()}, c), bytes};
  std::vector<std::uint64_t> sizes{(bytes.size() + c.block - 1) / c.block, c.block, bytes.size() % c.block};
  Bytes all;
  for (std::size_t i = 0; i < bytes.size(); i += c.block) {
    const Bytes part(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                     bytes.begin() + static_cast<std::ptrdiff_t>(std::min(i + c.block, bytes.size())));
    const Bytes block = packed(part, c.compressor);
    sizes.push_back(block.size());
    all = all + block;
  }
  return {words(sizes, c), all};
}

VtkXmlWriter::VtkXmlWriter(const VtiCoding& coding, const std::string& type) : c_(coding), type_(type) {
  text_ = R"(<?xml version="1.0"?>)"
          "\n<VTKFile type=\"" +
          type + "\" version=\"1.0\" byte_order=\"" + std::string(c_.big_endian ? "BigEndian" : "LittleEndian") +
          "\" header_type=\"" + (c_.word == 8 ? "UInt64" : "UInt32") + "\"" +
          (c_.compressor.empty() ? "" : " compressor=\"" + c_.compressor + "\"") + ">\n";
}

void VtkXmlWriter::array(const VtiArray& a) {
  const auto coded = [&] {
    const auto [head, rest] = vti_binary(a.bytes, c_);
    if (c_.format == "appended" && c_.encoding == "raw") return head + rest;
    // As VTK does: the table of compressed blocks has its own padding, an uncompressed size has not.
    return c_.compressor.empty() ? vti_base64(head + rest) : vti_base64(head) + vti_base64(rest);
  };
  text_ += "<DataArray type=\"" + a.type + "\" Name=\"" + a.name + "\" NumberOfComponents=\"" +
           std::to_string(a.components) + "\" format=\"" + c_.format + "\"";
  if (c_.format == "appended") {
    text_ += " offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
    appended_ = appended_ + coded();
    return;
  }
  const Bytes inside = c_.format == "ascii" ? Bytes(a.text.begin(), a.text.end()) : coded();
  text_ += ">\n" + std::string(inside.begin(), inside.end()) + "\n</DataArray>\n";
}

Bytes VtkXmlWriter::finish() const {
  std::string text = text_;
  if (c_.format == "appended") text += "<AppendedData encoding=\"" + c_.encoding + "\">\n _";
  const std::string end = c_.format == "appended" ? "\n</AppendedData>\n</VTKFile>\n" : "</VTKFile>\n";
  return text + appended_ + Bytes(end.begin(), end.end());
}

Bytes VtiFile::bytes() const {
  VtkXmlWriter out(coding, "ImageData");
  out.text("<ImageData WholeExtent=\"" + whole + "\" " + grid + ">\n");
  for (const VtiPiece& p : pieces) {
    out.text("<Piece Extent=\"" + p.extent + "\">\n<PointData " + p.point_data + ">\n");
    for (const VtiArray& a : p.arrays) out.array(a);
    out.text("</PointData>\n</Piece>\n");
  }
  out.text("</ImageData>\n");
  return out.finish();
}

}  // namespace dvrlab::test
