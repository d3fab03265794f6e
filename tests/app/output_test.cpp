// What the program writes appears whole or not at all, and output that is lost is said.
#include <filesystem>

#include "tests/app/program.h"

namespace dvrlab::app_test {
namespace {

using Output = Program;

// A limit of the file size stands for a full disk: a write fails half way.
constexpr const char* little = "trap '' XFSZ; ulimit -f 8; ";

TEST_F(Output, AnOldFileSurvivesAFullDisk) {
  write("s.json", "old");
  const Outcome schema = run(std::string(little) + "dvrlab schema -o s.json");
  expect_one_error(schema, 3, {"s.json: cannot be written"});
  EXPECT_EQ(schema.err.find(".part"), std::string::npos) << schema.err;
  EXPECT_EQ(read("s.json"), "old");
  for (const auto& file : std::filesystem::directory_iterator(path(".")))
    EXPECT_EQ(file.path().string().find(".part"), std::string::npos) << file.path();
  EXPECT_EQ(run("dvrlab schema -o s.json").code, 0);
  EXPECT_TRUE(nlohmann::json::accept(read("s.json")));
  const Outcome image = run(std::string(little) + "dvrlab render data/fuel.nrrd -o a.exr");
  EXPECT_EQ(image.code, 3) << image.err;
  expect_words(image.err, {"error: a.exr: cannot be written"});
  EXPECT_EQ(image.err.find(".part"), std::string::npos) << image.err;
}

TEST_F(Output, LostOutputIsNoSuccess) {
  for (const char* verb : {"schema", "info data/fuel.nrrd", "list", "describe image", "man"}) {
    const Outcome lost = run(std::string("dvrlab ") + verb + " >/dev/full");
    EXPECT_EQ(lost.code, 3) << verb;
    expect_words(lost.err, {"error: stdout: cannot be written"});
    EXPECT_EQ(run(std::string("dvrlab ") + verb + " >/dev/null").code, 0) << verb;
  }
}

TEST_F(Output, ThePlaceIsCheckedBeforeTheWork) {
  write("small.json", R"({"data": {"type": "nrrd", "file": "none.nrrd"}})");
  // The folder is wrong, and so is the config: the first is said, so nothing was begun.
  for (const char* line : {"dvrlab render small.json -o nodir/x.png", "dvrlab render small.json -o nodir/x.exr",
                           "dvrlab schema -o nodir/x.json", "dvrlab info none.nrrd --starter nodir/x.json"})
    expect_one_error(run(line), 2, {"nodir/x.", "cannot be written: there is no folder 'nodir'"});
  std::filesystem::create_directory(path("a.png"));
  expect_one_error(run("dvrlab render small.json -o a.png"), 2, {"a.png: cannot be written: it is a folder"});
  // A pixel outside is found without the data, which is cut off here.
  write("cut.nrrd", small_nrrd("").substr(0, 100));
  write("cut.json", R"({"data": {"type": "nrrd", "file": "cut.nrrd"},
    "optical_model": {"type": "absorption_emission", "extinction": [[0, 1], [9, 1]], "color": [[0, 1, 1, 1]]},
    "estimator": {"type": "direct"}, "camera": {"type": "orthographic", "position": [0, 0, 3], "up": [0, 1, 0]},
    "image": {"size": [8, 6]}})");
  expect_one_error(run("dvrlab probe cut.json --pixel 8,0"), 2, {"--pixel: 8,0 is outside the image of 8 x 6"});
  expect_words(run("dvrlab probe cut.json --pixel 7,0").err, {"cut.nrrd"});
}

TEST_F(Output, AStarterNeverOverwritesTheData) {
  write("mine.nrrd", small_nrrd(""));
  for (const char* name : {"mine.nrrd", "./mine.nrrd", "link.nrrd"}) {
    std::filesystem::remove(path("link.nrrd"));
    std::filesystem::create_symlink("mine.nrrd", path("link.nrrd"));
    expect_one_error(run(std::string("dvrlab info mine.nrrd --force --starter ") + name), 2,
                     {"--starter", "is the data itself"});
  }
  EXPECT_EQ(read("mine.nrrd"), small_nrrd(""));
}

}  // namespace
}  // namespace dvrlab::app_test
