// NRRD: which axes make the volume, units, voxels in several files and text, and what is refused of each.
#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

Bytes counting(std::size_t n) {
  Bytes v(n);
  for (std::size_t i = 0; i < n; ++i) v[i] = static_cast<char>(i);
  return v;
}

std::string file_of(const std::string& rest, const Bytes& data = counting(24), const std::string& encoding = "raw") {
  const std::string file = scratch("layout.nrrd");
  write(file, "NRRD0005\ntype: uint8\n" + rest + "encoding: " + encoding + "\n\n" + Bytes(data));
  return file;
}

std::string error_of(const std::string& rest, const Bytes& data = counting(24), const std::string& encoding = "raw") {
  return load_error("nrrd", {{"file", file_of(rest, data, encoding)}});
}

void expect_errors(const std::vector<std::pair<std::string, std::string>>& bad) {
  for (const auto& [rest, part] : bad) {
    const std::string error = error_of(rest);
    EXPECT_NE(error.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << error << '"';
    EXPECT_NE(error.find("layout.nrrd"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

// The extra axis may stand anywhere: the affine must be that of the three others.
TEST(NrrdLayout, AnAxisOfSizeOneIsDropped) {
  const std::vector<std::string> files{
      "dimension: 4\nsizes: 1 4 3 2\nkinds: list domain domain domain\nspace: RAS\n"
      "space directions: none (0,2,0) (-3,0,0) (0,0,1.5)\nspace origin: (1,2,3)\n",
      "dimension: 4\nsizes: 4 3 2 1\nkinds: domain domain domain time\nspace: RAS\n"
      "space directions: (0,2,0) (-3,0,0) (0,0,1.5) none\nspace origin: (1,2,3)\n",
      "dimension: 5\nsizes: 4 1 3 2 1\nspace: RAS\n"
      "space directions: (0,2,0) none (-3,0,0) (0,0,1.5) none\nspace origin: (1,2,3)\n"};
  for (const std::string& rest : files) {
    const auto grid = load_grid("nrrd", {{"file", file_of(rest)}});
    EXPECT_EQ(grid->dims, (std::array<int, 3>{4, 3, 2}));
    EXPECT_EQ(grid->at(1, 2, 1), 21);
    EXPECT_EQ(world(*grid, {3, 2, 1}), (Vector3{-5, 8, 4.5}));
    EXPECT_TRUE(has_note(*grid, "of size 1"));
  }
  const auto spaced = load("nrrd", {{"file", file_of("dimension: 4\nsizes: 4 3 1 2\nspacings: 0.5 2 nan 3\n")}});
  EXPECT_EQ(world(*spaced, {1, 1, 1}), (Vector3{0.5, 2, 3}));
}

TEST(NrrdLayout, ColoursVectorsAndTimeAreRefusedWithWhatToDo) {
  expect_errors({{"dimension: 4\nsizes: 3 4 3 2\nkinds: RGB-color domain domain domain\n", "cut out one volume"},
                 {"dimension: 4\nsizes: 4 3 2 5\nkinds: domain domain domain time\n", "cut out one volume"},
                 {"dimension: 4\nsizes: 3 4 2 1\nkinds: vector domain domain domain\n", "kind \"vector\""},
                 {"dimension: 4\nsizes: 4 3 1 1\n", "2 axes are longer than 1"},
                 {"dimension: 3\nsizes: 3 4 2\nkinds: 3-color domain domain\n", "kind \"3-color\""},
                 {"dimension: 2\nsizes: 4 6\n", "is 2"},
                 {"dimension: 17\nsizes: 4 6\n", "is 17"},
                 {"dimension: 3\nsizes: 4 3 2\nkinds: domain domain\n", "has 2 words, not 3"},
                 {"dimension: 4\nsizes: 4 3 2 1\nspace directions: (1,0,0) (0,1,0) none (0,0,1)\n", "axis 3 is"},
                 {"dimension: 3\nsizes: 4 3 2\nspace origin: none\n", "is \"none\""},
                 {"dimension: 3\nsizes: 4 3 2\nspace directions: (1,0,0) (0,1,0) (0,0,inf)\n", "not finite"}});
}

TEST(NrrdLayout, AnatomyAndUnits) {
  const std::string grid = "dimension: 3\nsizes: 4 3 2\n", directions = "space directions: (1,0,0) (0,1,0) (0,0,1)\n";
  const auto read = [&](const std::string& rest) { return load("nrrd", {{"file", file_of(grid + rest)}}); };
  EXPECT_TRUE(read("space: LPS\n" + directions)->anatomical);
  EXPECT_TRUE(read("space: right-anterior-superior\n" + directions)->anatomical);
  EXPECT_FALSE(read("space: scanner-xyz\n" + directions)->anatomical);
  EXPECT_FALSE(read("")->anatomical);
  EXPECT_EQ(read("space: LPS\n" + directions + "space units: \"mm\" \"mm\" \"mm\"\n")->length_unit, "mm");
  EXPECT_EQ(read("spacings: 1 1 1\nunits: \"um\" \"um\" \"um\"\n")->length_unit, "um");
  EXPECT_EQ(read("spacings: 1 1 1\n")->length_unit, "");
  const auto mixed = read("spacings: 1 1 1\nunits: \"mm\" \"mm\" \"s\"\n");
  EXPECT_EQ(mixed->length_unit, "");
  EXPECT_TRUE(has_note(*mixed, "differ"));
  expect_errors({{grid + "spacings: 1 1 1\nunits: \"mm\" \"mm\"\n", "has 2 texts, not 3"},
                 {grid + "spacings: 1 1 1\nunits: \"mm\" \"mm\" \"mm\n", "no closing quote"}});
}

struct Slices {
  std::string rest;
  std::size_t files;
  std::string encoding;
};

TEST(NrrdLayout, VoxelsInSeveralFiles) {
  const std::string grid = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 4\n";
  const std::vector<Slices> all{{"data file: s%02d.bin 1 4 1\n", 4, "raw"},
                                {"data file: LIST\ns01.bin\ns02.bin\ns03.bin\ns04.bin\n", 4, "raw"},
                                {"data file: LIST 3\ns01.bin\ns02.bin\n", 2, "gzip"},
                                {"data file: s%02d.bin 1 2 1 3\n", 2, "raw"},
                                {"data file: s%02d.bin 1 12 1 1\n", 12, "bzip2"},
                                {"data file: LIST\ns04.bin\ns03.bin\ns02.bin\ns01.bin\n", 4, "hex"}};
  for (const Slices& s : all) {
    SCOPED_TRACE(s.rest);
    const bool backwards = s.rest.find("LIST\ns04") != std::string::npos;
    const Bytes voxels = counting(48);
    const std::size_t share = 48 / s.files;
    for (std::size_t i = 0; i < s.files; ++i) {
      const auto first = voxels.begin() + static_cast<std::ptrdiff_t>(i * share);
      const Bytes part(first, first + static_cast<std::ptrdiff_t>(share));
      const std::size_t number = backwards ? s.files - i : i + 1;
      write(scratch((number < 10 ? "s0" : "s") + std::to_string(number) + ".bin"),
            "ab" + (s.encoding == "gzip"    ? gzip(part)
                    : s.encoding == "bzip2" ? bzip2(part)
                    : s.encoding == "hex"   ? hex(part)
                                            : part));
    }
    // Text and raw bytes are skipped as bytes; of compressed files the two would be decompressed ones.
    const bool plain = s.encoding == "raw" || s.encoding == "hex";
    write(scratch("s.nhdr"), grid + "encoding: " + s.encoding + (plain ? "\nbyte skip: 2\n" : "\n") + s.rest + Bytes());
    const std::string error = load_error("nrrd", {{"file", scratch("s.nhdr")}});
    if (!plain) {  // the two bytes are no stream
      EXPECT_NE(error.find("damaged"), std::string::npos) << error;
      for (std::size_t i = 1; i <= s.files; ++i) {
        const std::string name = scratch((i < 10 ? "s0" : "s") + std::to_string(i) + ".bin");
        const Bytes with = read(name);
        write(name, Bytes(with.begin() + 2, with.end()));
      }
    }
    const auto grid_read = load_grid("nrrd", {{"file", scratch("s.nhdr")}});
    for (int n = 0; n < 48; ++n) EXPECT_EQ(grid_read->at(n % 4, n / 4 % 3, n / 12), n);
  }
}

TEST(NrrdLayout, BadListsOfFiles) {
  const std::string grid = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\ndata file: ";
  write(scratch("here1.bin"), counting(12));
  write(scratch("here2.bin"), counting(11));
  const std::vector<std::pair<std::string, std::string>> bad{
      {"here%d.bin 1 2 1\n", "data file 2 holds 11"},
      {"here%d.bin 1 1 1\n", "names 1 data files"},
      {"here%d.bin 2 3 1\n", "here3.bin does not exist"},
      {"here%d.bin 1 9000000000000000000 1\n", "more than the grid's 2"},
      {"here%d.bin 1 2 0\n", "step of the numbers is 0"},
      {"here%d.bin 1 x 1\n", "\"x\" is no whole number"},
      {"here%d.bin 1 2\n", "must be a pattern"},
      {"here%d.bin 1 2 1 4\n", "must be 1, 2 or 3"},
      {"here%s.bin 1 2 1\n", "must hold one number"},
      {"here%d%n.bin 1 2 1\n", "must hold one number"},
      {"here%%.bin 1 2 1\n", "holds no number"},
      {"LIST\nhere1.bin\n", "names 1 data files"},
      {"LIST\n", "names 0 data files"},
      {"LIST 3\n", "names 0 data files"},
      {"LIST two\nhere1.bin\n", "\"two\" is no whole number"},
      {"LIST 3 4\nhere1.bin\n", "one file name per line"}};
  for (const auto& [rest, part] : bad) {
    write(scratch("list.nhdr"), grid + rest + Bytes());
    const std::string error = load_error("nrrd", {{"file", scratch("list.nhdr")}});
    EXPECT_NE(error.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << error << '"';
    EXPECT_NE(error.find("list.nhdr"), std::string::npos) << error;
  }
}

TEST(NrrdLayout, TextThatIsNoVoxel) {
  const std::string grid = "dimension: 3\nsizes: 4 3 2\n";
  const auto text = [](const std::string& first) { return first + ascii(std::vector<int>(23, 7)); };
  EXPECT_EQ(error_of(grid, text("255, "), "ascii"), "");
  EXPECT_NE(error_of(grid, text("256 "), "ascii").find("voxel 0 is \"256\""), std::string::npos);
  EXPECT_NE(error_of(grid, text("-1 "), "ascii").find("no number that uint8 holds"), std::string::npos);
  EXPECT_NE(error_of(grid, text("1.5 "), "ascii").find("\"1.5\""), std::string::npos);
  EXPECT_NE(error_of(grid, text("") + Bytes(9, ' '), "ascii").find("the data holds 23"), std::string::npos);
  EXPECT_NE(error_of(grid, Bytes(40, ' '), "ascii").find("at most 20"), std::string::npos);
  EXPECT_TRUE(has_note(*load("nrrd", {{"file", file_of(grid, text("1 2 "), "ascii")}}), "further data"));
  EXPECT_NE(error_of(grid, Bytes(48, 'x'), "hex").find("byte 0 of the hexadecimal"), std::string::npos);
  EXPECT_NE(error_of(grid, Bytes(47, '7'), "hex").find("the data holds at most 23"), std::string::npos);
}

}  // namespace
}  // namespace dvrlab::test
