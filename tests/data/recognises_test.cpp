// Each file belongs to exactly one reader, by its first bytes alone or by its name alone.
#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

/// The readers that take a file of this name with these bytes, joined by blanks.
std::string readers_of(const std::string& path, const Bytes& bytes) {
  std::string found;
  const std::span all(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size());
  for (const auto& e : registry().entries()) {
    if (e.kind != "data" || !e.problem.empty()) continue;
    if (registry().get<DataPlugin>("data", e.name).recognises(path, all.first(std::min<std::size_t>(512, all.size()))))
      found += (found.empty() ? "" : " ") + e.name;
  }
  return found;
}

bool have(const std::string& reader) {
  const auto& all = registry().entries();
  return std::any_of(all.begin(), all.end(), [&](const auto& e) { return e.kind == "data" && e.name == reader; });
}

TEST(Recognises, ShippedFilesByNameAndByContent) {
  const std::vector<std::pair<std::string, std::string>> files{{"engine.nrrd", "nrrd"},
                                                               {"hydrogen.nrrd", "nrrd"},
                                                               {"letter_f.mhd", "metaimage"},
                                                               {"marschner_lobb.nii.gz", "nifti"},
                                                               {"sphere_int16.nii.gz", "nifti"}};
  for (const auto& [name, reader] : files) {
    if (!have(reader)) continue;
    const Bytes bytes = read(std::string(DVRLAB_SHIPPED_DATA "/") + name);
    ASSERT_FALSE(bytes.empty()) << name;
    EXPECT_EQ(readers_of(name, bytes), reader) << name;
    EXPECT_EQ(readers_of("download", bytes), reader) << name << " without its name";
    EXPECT_EQ(readers_of(name, Bytes(100, 'x')), reader) << name << ", damaged";
    EXPECT_EQ(readers_of(name, {}), reader) << name << ", empty";
  }
}

TEST(Recognises, NothingElse) {
  for (const Bytes& bytes :
       {Bytes(), Bytes(512, 0), Bytes(512, 'x'), gzip(Bytes(5000, 'x')), gzip({}), zlib(Bytes(99, 0)),
        "ObjectType = Tube\n" + Bytes(), "ObjectType" + Bytes(), "NRRD" + Bytes(), Bytes(3, 'N')})
    EXPECT_EQ(readers_of("volume.bin", bytes), "") << bytes.size();
  EXPECT_EQ(readers_of("volume.raw", Bytes(512, 7)), "");
  EXPECT_EQ(readers_of("volume.gz", Bytes{0x1f, static_cast<char>(0x8b), 8, 0}), "");
}

// The header of a pair and of version 2, either byte order: recognised, whatever load() says of them.
TEST(Recognises, EveryNiftiHeader) {
  if (!have("nifti")) GTEST_SKIP() << "not supported: the nifti plugin is not built (libnifti-dev)";
  for (const bool big : {false, true})
    for (const std::string magic : {"n+1", "ni1", "n+2", "ni2"}) {
      const bool one = magic[2] == '1';
      Bytes head = bytes_of_numbers(std::vector<std::int32_t>{one ? 348 : 540}, big);
      head.resize(540);
      std::copy(magic.begin(), magic.end(), head.begin() + (one ? 344 : 4));
      EXPECT_EQ(readers_of("x", head), "nifti") << magic;
      EXPECT_EQ(readers_of("x", gzip(head)), "nifti") << magic;
      head[one ? 345 : 5] = 'x';
      EXPECT_EQ(readers_of("x", head), "") << magic;
    }
}

}  // namespace
}  // namespace dvrlab::test
