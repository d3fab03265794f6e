// Files that were good until something happened to them: every reader, every encoding, cut off at every byte, with a
// flipped bit at every byte, and made to swell. One error of one line, never a crash, never other voxels in silence.
#include <chrono>
#include <cmath>

#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

struct Good {
  std::string what, reader, name;
  std::string header;
  Bytes data;    // behind the header
  bool checked;  // the encoding carries a checksum
  nlohmann::json more = nlohmann::json::object();
};

Bytes voxels() {
  Bytes v(6 * 5 * 4);
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = static_cast<char>(127 * std::sin(0.1 * static_cast<double>(i * i)));
  return v;
}

std::vector<int> voxel_numbers() {
  std::vector<int> n;
  for (const char c : voxels()) n.push_back(static_cast<unsigned char>(c));
  n.back() = 7;  // one digit: text that loses it has one number less
  return n;
}

// A version 1 header of 6x5x4 bytes.
Bytes nifti_header() {
  Bytes h(352, 0);
  const auto put = [&](std::size_t at, const Bytes& b) {
    std::copy(b.begin(), b.end(), h.begin() + std::ptrdiff_t(at));
  };
  put(0, bytes_of_numbers(std::vector<std::int32_t>{348}, false));
  put(40, bytes_of_numbers(std::vector<std::int16_t>{3, 6, 5, 4, 1, 1, 1, 1}, false));
  put(70, bytes_of_numbers(std::vector<std::int16_t>{2, 8}, false));
  put(76, bytes_of_numbers(std::vector<float>{1, 1, 1, 1}, false));
  put(108, bytes_of_numbers(std::vector<float>{352}, false));
  put(344, {'n', '+', '1'});
  return h;
}

std::string text_of(const Bytes& b) { return std::string(b.begin(), b.end()); }

std::vector<Good> good_files() {
  const Bytes v = voxels();
  const std::string nrrd = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 6 5 4\nencoding: ",
                    meta = "ObjectType = Image\nNDims = 3\nDimSize = 6 5 4\nElementType = MET_UCHAR\n",
                    local = "ElementDataFile = LOCAL\n";
  std::vector<Good> all{
      {"nrrd raw", "nrrd", "d.nrrd", nrrd + "raw\n\n", v, false},
      {"nrrd gzip", "nrrd", "d.nrrd", nrrd + "gzip\n\n", gzip(v), true},
      {"nrrd two gzip members", "nrrd", "d.nrrd", nrrd + "gzip\n\n",
       gzip(Bytes(v.begin(), v.begin() + 50)) + gzip(Bytes(v.begin() + 50, v.end())), true},
      {"nrrd bzip2", "nrrd", "d.nrrd", nrrd + "bzip2\n\n", bzip2(v), true},
      {"nrrd ascii", "nrrd", "d.nrrd", nrrd + "ascii\n\n", ascii(voxel_numbers()), false},
      {"nrrd hex", "nrrd", "d.nrrd", nrrd + "hex\n\n", hex(v), false},
      {"metaimage raw", "metaimage", "d.mha", meta + local, v, false},
      {"metaimage zlib", "metaimage", "d.mha", meta + "CompressedData = True\n" + local, zlib(v), true},
      {"metaimage ascii", "metaimage", "d.mha", meta + "BinaryData = False\n" + local, ascii(voxel_numbers()), false},
      {"raw", "raw", "d.raw", "", v, false, {{"size", {6, 5, 4}}, {"voxel_type", "uint8"}}}};
  const auto& entries = registry().entries();
  if (std::any_of(entries.begin(), entries.end(),
                  [](const auto& e) { return e.kind == "data" && e.name == "nifti"; })) {
    all.push_back({"nifti", "nifti", "d.nii", text_of(nifti_header()), v, false});
    all.push_back({"nifti gzip", "nifti", "d.nii.gz", "", gzip(nifti_header() + v), true});
  }
  return all;
}

class Damaged : public testing::Test {
 protected:
  static nlohmann::json values(const Good& g) {
    nlohmann::json all{{"file", scratch(g.name)}};
    all.update(g.more);
    return all;
  }
  /// What reading `bytes` gives: the error, or "" and the voxels in `loaded`.
  static std::string outcome(const Good& g, const Bytes& bytes, std::vector<double>* loaded = nullptr) {
    write(scratch(g.name), bytes);
    const std::string error = load_error(g.reader, values(g));
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    if (!error.empty()) {
      EXPECT_NE(error.find(g.name), std::string::npos) << error;
    } else if (loaded) {
      const auto grid = load_grid(g.reader, values(g));
      for (std::uint64_t i = 0; i < grid->count(); ++i)
        loaded->push_back(grid->at(int(i) % grid->dims[0], int(i) / grid->dims[0] % grid->dims[1],
                                   int(i) / grid->dims[0] / grid->dims[1]));
    }
    return error;
  }
};

TEST_F(Damaged, TheFilesAreGood) {  // or the tests below would prove nothing
  for (const Good& g : good_files()) EXPECT_EQ(outcome(g, g.header + Bytes(g.data)), "") << g.what;
}

TEST_F(Damaged, CutOffAnywhere) {
  for (const Good& g : good_files()) {
    Bytes all = g.header + Bytes(g.data);
    while (!all.empty() && (all.back() == '\n' || all.back() == ' ')) all.pop_back();  // blanks behind text
    for (std::size_t size = 0; size < all.size(); ++size)
      EXPECT_NE(outcome(g, Bytes(all.begin(), all.begin() + std::ptrdiff_t(size))), "")
          << g.what << ", cut to " << size << " of " << all.size();
  }
}

TEST_F(Damaged, AFlippedBitIsNoticedByAChecksum) {
  for (const Good& g : good_files()) {
    std::vector<double> wanted;
    outcome(g, g.header + Bytes(g.data), &wanted);
    int errors = 0, harmless = 0;
    for (std::size_t at = 0; at < g.data.size(); ++at) {
      Bytes data = g.data;
      data[at] = static_cast<char>(data[at] ^ (1 << at % 8));
      std::vector<double> found;
      const bool failed = !outcome(g, g.header + Bytes(data), &found).empty();
      failed ? ++errors : ++harmless;
      if (g.checked && !failed) {
        EXPECT_EQ(found, wanted) << g.what << ", byte " << at;  // a name or a date of gzip's
      }
    }
    std::printf("%s: %d flipped bits are errors, %d are harmless or unseen\n", g.what.c_str(), errors, harmless);
    if (g.checked) {
      EXPECT_GT(errors, 10 * harmless) << g.what;
    }
    if (g.what == "nrrd raw") {
      EXPECT_EQ(errors, 0);  // the control: without a checksum nothing can be noticed
    }
  }
}

double seconds(const std::chrono::steady_clock::time_point& since) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
}

// 64 MiB of zeros behind a header that announces 120 voxels, and a header that announces what the file cannot hold.
TEST_F(Damaged, ACompressedFileThatSwells) {
  const Bytes zeros(1 << 26, 0);
  const std::string sizes = "sizes: 6 5 4\n", huge = "sizes: 6000 5000 4000\n",
                    nrrd = "NRRD0004\ntype: uint8\ndimension: 3\n",
                    meta = "ObjectType = Image\nNDims = 3\nElementType = MET_UCHAR\nCompressedData = True\n",
                    local = "ElementDataFile = LOCAL\n";
  const Bytes by_gzip = gzip(zeros), by_bzip2 = bzip2(zeros), by_zlib = zlib(zeros);
  const std::vector<std::pair<Good, std::string>> bombs{
      {{"", "nrrd", "b.nrrd", nrrd + sizes + "encoding: gzip\n\n", by_gzip, true}, "goes on beyond the 120 bytes"},
      {{"", "nrrd", "b.nrrd", nrrd + sizes + "encoding: bzip2\n\n", by_bzip2, true}, "goes on beyond the 120 bytes"},
      {{"", "metaimage", "b.mha", meta + "DimSize = 6 5 4\n" + local, by_zlib, true}, "goes on beyond the 120 bytes"},
      {{"", "nrrd", "b.nrrd", nrrd + huge + "encoding: gzip\n\n", by_gzip, true}, "announces 120000000000 bytes"},
      {{"", "nrrd", "b.nrrd", nrrd + huge + "encoding: bzip2\n\n", by_bzip2, true}, "announces 120000000000 bytes"},
      {{"", "nrrd", "b.nrrd", nrrd + huge + "encoding: ascii\n\n", by_gzip, true}, "announces 120000000000 bytes"},
      {{"", "nrrd", "b.nrrd", nrrd + huge + "encoding: hex\n\n", by_gzip, true}, "announces 120000000000 bytes"},
      {{"", "metaimage", "b.mha", meta + "DimSize = 6000 5000 4000\n" + local, by_zlib, true}, "holds at most"},
      {{"", "nrrd", "b.nrrd", nrrd + sizes + "byte skip: 900000000000000\nencoding: gzip\n\n", by_gzip, true},
       "holds at most 0"},
  };
  const auto start = std::chrono::steady_clock::now();
  for (const auto& [g, part] : bombs) {
    const std::string error = outcome(g, g.header + Bytes(g.data));
    EXPECT_NE(error.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << error << '"';
  }
  std::printf("%zu files that swell: %.3f s\n", bombs.size(), seconds(start));
}

}  // namespace
}  // namespace dvrlab::test
