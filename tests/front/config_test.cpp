// What a config may say, and what dvrlab says when it is wrong.
#include <filesystem>
#include <fstream>

#include "framework/config/check_value.h"
#include "framework/config/resolve.h"
#include "tests/front/front_test.h"

namespace dvrlab::front {
namespace {

TEST(Config, DefaultsAreFilledIn) {
  const ResolvedCase c = plan(small_config()).cases.at(0).resolved;
  EXPECT_EQ(c.backend.type, "cpu");
  EXPECT_EQ(c.sampling.type, "uniform");
  EXPECT_EQ(c.sampling.parameters.number("step"), 1.0);
  EXPECT_EQ(c.sampling.parameters.number("termination"), 1e-4);
  ASSERT_EQ(c.lights.size(), 1u);
  EXPECT_EQ(c.lights[0].type, "head");
  EXPECT_EQ(c.camera.parameters.vector3("target"), (Vector3{0, 0, 0}));
  EXPECT_EQ(c.optical_model.parameters.text("tf"), "table");
  EXPECT_EQ(c.optical_model.parameters.choice_index("interpolation"), 0);
  EXPECT_EQ(c.optical_model.parameters.nodes("extinction").node.at(1).x, (Vector3{2, 2, 2}));
  EXPECT_TRUE(c.limits.is_null("memory"));
  EXPECT_EQ(c.top.text("precision"), "strict");
  EXPECT_EQ(c.optical_model.parameters.path_of("tf"), "optical_model.tf");
  EXPECT_THROW(c.top.number("nonsense"), std::logic_error);
}

TEST(Config, ResolvedConfigIsAConfigOfTheSameCase) {
  const Experiment first = plan(small_config(R"(, "metrics": ["rmse"], "clip": [{"normal": [1, 0, 0]}])"));
  const nlohmann::json once = first.cases.at(0).resolved.config;
  const nlohmann::json twice = plan(once.dump()).cases.at(0).resolved.config;
  EXPECT_EQ(once, twice);
  const nlohmann::json result_file = {{"config", once}, {"report", nlohmann::json::object()}};
  EXPECT_EQ(plan(result_file.dump()).cases.at(0).resolved.config, once) << "the config section of a result file";
}

TEST(Config, UnknownKeyNamesPlacePathNearestAndLegal) {
  expect_error(small_config(R"(, "sampling": {"stpe": 1})"),
               {"test.json:9:", "sampling.stpe", "did you mean 'step'?", "legal: jitter, skipping"});
  expect_error(small_config(R"(, "samplng": 1)"), {"samplng", "did you mean 'sampling'?"});
}

TEST(Config, WrongValuesSayWhatWouldBeRight) {
  expect_error(small_config(R"(, "sampling": {"step": "fine"})"),
               {"sampling.step", "found \"fine\"", "a number in (0,inf)"});
  expect_error(small_config(R"(, "sampling": {"step": 0})"), {"sampling.step", "found 0", "(0,inf)"});
  expect_error(small_config(R"(, "sampling": {"unit": "voxels"})"),
               {"sampling.unit", "did you mean 'voxel'?", "one of voxel, world"});
  expect_error(small_config(R"(, "repeat": 2.5)"), {"repeat", "found 2.5", "whole number"});
  expect_error(small_config(R"(, "lights": [{"type": "point"}])"),
               {"lights[0]", "'position' is missing", "three numbers"});
  expect_error(small_config(R"(, "lights": [{"type": "spot"}])"), {"lights[0].type", "unknown type 'spot'", "head"});
  expect_error(small_config(R"(, "lights": {"type": "head"})"), {"lights", "must be a list"});
  expect_error(small_config(R"(, "limits": {"memory": "much"})"), {"limits.memory", "null (75 %"});
  expect_error(small_config(R"(, "metrics": ["psnrr"])"), {"metrics[0]", "did you mean 'psnr'?"});
  expect_error(small_config(R"(, "metrics": ["psnr", "psnr"])"), {"metrics", "listed twice"});
}

TEST(Config, NodesAreChecked) {
  const std::string set = "optical_model.extinction=";
  expect_error(small_config(), {"--set", "optical_model.extinction", "ascend"}, {set + "[[1, 0], [0, 1]]"});
  expect_error(small_config(), {"as long as the first"}, {set + "[[0, 0], [1, 1, 1, 1]]"});
  expect_error(small_config(), {"3 numbers each"}, {set + "[[0, 0, 1]]"});
  expect_error(small_config(), {"null or nodes"}, {set + "[]"});
}

TEST(Config, MissingSections) {
  const std::vector<std::string> lines = errors_of("{}");
  ASSERT_EQ(lines.size(), 4u);  // data, optical_model, estimator, camera: all at once
  expect_words(lines[0], {"data", "section is missing", "procedural"});
  expect_words(lines[3], {"camera", "perspective"});
}

TEST(Config, AllErrorsAtOnceAndOnceEach) {
  const std::vector<std::string> lines = errors_of(small_config(
      R"(, "sampling": {"step": -1, "jiter": 0}, "seed": -5, "axes": {"variant": {"backend.threads": [1, 2]}})"));
  ASSERT_EQ(lines.size(), 3u) << testing::PrintToString(lines);
}

TEST(Config, DuplicateKeysAreRefusedWithBothPlaces) {
  expect_error("{\n  \"seed\": 1,\n  \"seed\": 2\n}", {"test.json:3:3: seed", "duplicate key", "test.json:2:3"});
}

TEST(Config, SyntaxErrorsHaveLineAndColumn) {
  expect_error("{\n  \"seed\": 1,\n}", {"test.json:3:1: not valid JSON"});
  expect_error("[1]", {"a config is a section"});
  expect_error(std::string(100, '[') + std::string(100, ']'), {"deeper than 64"});
  expect_error("{\"seed\": 1e400}", {"test.json:1:", "not valid JSON: number overflow", "1e400"});
}

TEST(Config, CommentsAreAllowed) {
  EXPECT_TRUE(errors_of("// first\n" + small_config("/* , */, \"seed\": 3 // last\n")).empty());
  expect_error(small_config(", \"seed\":\n\n  // a comment\n  1,\n   \"sed\": 2"), {"test.json:13:4: sed"});
}

TEST(Config, SetOverridesAndSpeaksUp) {
  EXPECT_EQ(plan(small_config(), {"sampling.step=0.25"}).cases.at(0).resolved.sampling.parameters.number("step"), 0.25);
  EXPECT_EQ(plan(small_config(), {"name=other"}).name, "other");
  expect_error(small_config(), {"--set nonsense", "key.path=value"}, {"nonsense"});
  expect_error(small_config(), {"--set: sampling.stepp", "did you mean 'step'?"}, {"sampling.stepp=1"});
  const std::string axes = R"(, "axes": {"permutation": {"sampling.step": [1, 2]}})";
  expect_error(small_config(axes), {"axes.permutation.sampling.step decides"}, {"sampling.step=1"});
  EXPECT_EQ(plan(small_config(axes), {"axes.permutation.sampling.step=[1,2,3]"}).cases.size(), 3u);
}

TEST(Config, KeysThatWouldVanishAreRefused) {
  expect_error(small_config(R"(, "": 5)"), {"test.json:9:3: found the key \"\"", "a key has a name"});
  expect_error(small_config(R"(, "sampling": {"": 5})"), {"test.json:9:16: sampling.: found the key \"\""});
  for (const char* key : {"step.", ".step", "step[0]", "["}) {
    const std::string text = std::string(R"(, "sampling": {")") + key + R"(": 5})";
    expect_error(small_config(text), {"test.json:9:16: sampling.", std::string("found the key \"") + key + "\"",
                                      "write sections within sections"});
    expect_error(small_config(), {"--set", std::string("found the key \"") + key},
                 {std::string(R"(axes.permutation.sampling=[{"type":"uniform",")") + key + R"(":5}])"});
  }
  expect_error(small_config(R"(, "sampling.step": 1)"), {"test.json:9:3: sampling.step", "key paths are possible in"});
  expect_error(small_config(R"(, "reference": {"fine": {"sampling": {"step.": 1}}})"), {"found the key \"step.\""});
  expect_error(small_config(R"(, "reference": {"fine": {"sampling..step": 1}})"),
               {"test.json:9:26: reference.fine.sampling..step", "a step is empty"});
  expect_error(small_config(R"(, "axes": {"permutation": {"sampling.step": [1], "sampling.step.": [2]}})"),
               {"test.json:9:50: axes.permutation.sampling.step.", "a step is empty"});
  for (const char* path : {"sampling..step", ".sampling.step", "sampling.step.", "lights[0]color", "lights[x]", "[0]"})
    expect_error(small_config(), {"--set", "is no key path"}, {std::string(path) + "=1"});
  const std::string folder = testing::TempDir();
  std::ofstream(folder + "/base.json") << small_config();
  try {
    parse_document(R"({"include": "base.json", "": 5})", "test.json", folder);
    ADD_FAILURE() << "nothing was refused";
  } catch (const InputError& e) {
    expect_words(e.what(), {"test.json:1:26", "found the key \"\""});
  }
  // Key paths in their places, deeper ones among them.
  EXPECT_TRUE(errors_of(small_config(R"(, "axes": {"permutation": {"optical_model.color[0][1]": [0, 1],
    "zip": [{"image.size[0]": [3, 4], "seed": [1, 2]}]}}, "reference": {"a.b": {"image.size[1]": 3}})"))
                  .empty());
  EXPECT_EQ(split_path("optical_model.surface.opacity[2][1]"),
            (std::vector<std::string>{"optical_model", "surface", "opacity", "[2]", "[1]"}));
}

TEST(Config, SetIsReadAsStrictlyAsAFile) {
  expect_error(small_config(), {"--set sampling:1:28: step: duplicate key", "--set sampling:1:19"},
               {R"(sampling={"type":"uniform","step":1,"step":2})"});
  expect_error(small_config(), {"--set include=none.json", "read from files only"}, {"include=none.json"});
  expect_error(small_config(), {"--set: foo: unknown key 'foo'"}, {"foo.bar=1"});
  const std::string deep = std::string(100, '[') + std::string(100, ']');
  expect_error(small_config(), {"deeper than 64"}, {"camera=" + deep});
}

// A section that only an axis or a reference names stands where their key path is written.
TEST(Config, MisspeltSectionsInKeyPathsHaveAPlace) {
  expect_error(small_config(R"(, "axes": {"permutation": {"samplng.step": [1, 2]}})"),
               {"test.json:9:28: samplng: unknown key 'samplng'", "did you mean 'sampling'?"});
  expect_error(small_config(R"(, "reference": {"fine": {"samplng.step": 1}})"),
               {"test.json:9:26: samplng: unknown key", "did you mean 'sampling'?"});
}

TEST(Config, EverythingIsSaidAtOnce) {
  const auto expect_lines = [](const std::string& more, std::vector<std::string> words) {
    const std::vector<std::string> lines = errors_of(small_config(more));
    EXPECT_EQ(lines.size(), words.size()) << testing::PrintToString(lines);
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    expect_words(all, words);
  };
  expect_lines(
      R"(, "sed": 1, "axes": {"permutation": {"zip": [{"seed": [1, 2], "repeat": [1]}]}}, "limits": {"mem": 1})",
      {"zip[0].repeat", "unknown key 'sed'", "unknown key 'mem'"});
  expect_lines(R"(, "clip": [{"normal": [0,0,0]}, {"normal": [0,0,0]}], "lights": [{"type": "directional",
    "direction": [0,0,0]}], "illumination": [{"type": "blinn_phong"}, {"type": "blinn_phong"}])",
               {"clip[0].normal", "clip[1].normal", "lights[0].direction", "illumination[1]"});
  expect_lines(R"(, "metrics": ["psnr"], "reference": {"fine": {"sampling.step": 0.5}}, "expect": [
    {"metric": "psnr", "against": "fine", "at_lest": 1}, {"metric": "psnrr", "against": "fine", "at_least": 1},
    7, {"metric": "psnr", "against": "fien", "at_least": 1}])",
               {"expect[0].at_lest", "expect[1]: there is no metric 'psnrr'", "expect[2]",
                "expect[3]: there is no reference 'fien'"});
  // What an axis that cannot be read would have brought is not missing.
  std::string without_camera = small_config(R"(, "axes": {"permutation": {"camera": []}})");
  without_camera.erase(without_camera.find("\"camera\""),
                       without_camera.find("\"image\"") - without_camera.find("\"camera\""));
  expect_error(without_camera, {"axes.permutation.camera", "not empty"});
}

TEST(Config, AMissingFileAndAnUnknownKeyAreSaidTogether) {
  std::string text = small_config(R"(, "sed": 1)");
  const std::size_t begin = text.find("\"data\""), end = text.find('\n', begin);
  text.replace(begin, end - begin, R"("data": {"type": "nrrd", "file": "none.nrrd"},)");
  const std::vector<std::string> lines = errors_of(text);
  ASSERT_EQ(lines.size(), 2u) << testing::PrintToString(lines);
  expect_words(lines[0] + lines[1], {"'sed'", "data.file", "none.nrrd"});
}

TEST(Config, WhereOfAnExpectationNamesKeysAndValues) {
  const auto where = [](const std::string& condition) {
    return small_config(R"(, "axes": {"permutation": {"sampling.step": [2, 1]}}, "metrics": ["psnr"], "reference":
      {"fine": {"sampling.step": 0.5}}, "expect": [{"metric": "psnr", "against": "fine", "at_least": 1, "where":
{)" + condition + "}}]");
  };
  EXPECT_TRUE(errors_of(where(R"("sampling.step": 2)")).empty());
  expect_error(where(R"("sampling.stpe": 1)"),
               {"test.json:11:2: expect[0].where.sampling.stpe", "did you mean 'step'?", "there are: jitter"});
  expect_error(where(R"("samplng.step": 1)"), {"where.samplng.step", "did you mean 'sampling'?"});
  expect_error(where(R"("sampling.step": 77)"), {"test.json:11:2", "found 77", "the values are 2, 1"});
  expect_error(where(R"("sampling..step": 1)"), {"test.json:11:2", "a step is empty"});
}

TEST(Config, RangesOfWholeNumbers) {
  const Experiment e = plan(small_config(R"(, "axes": {"permutation": {"image.size[0]": {"lin": [4, 8, 3]}}})"));
  ASSERT_EQ(e.cases.size(), 3u);
  EXPECT_EQ(e.cases[1].resolved.config["image"]["size"].dump(), "[6,6]");
  expect_error(small_config(R"(, "axes": {"permutation": {"image.size[0]": {"lin": [4, 5, 3]}}})"),
               {"test.json:9:28: axes.permutation.image.size[0]", "found [4.5,6]", "whole numbers"});
  EXPECT_EQ(plan(small_config(), {"image.size=[3.0,4e0]"}).cases[0].resolved.config["image"]["size"].dump(), "[3,4]");
  const std::string orbit = R"({"type": "orbit", "views": 5})";
  EXPECT_EQ(plan(small_config(R"(, "axes": {"permutation": {"camera.view": {"lin": [0, 4, 3]}}})"), {"camera=" + orbit})
                .cases.size(),
            3u);
}

TEST(Config, IncludesHaveLimits) {
  const std::string folder = testing::TempDir() + "/dvrlab_includes";
  std::filesystem::create_directories(folder);
  for (int i = 0; i < 16; ++i) {
    const std::string next = "\"" + std::to_string(i + 1) + ".json\"";
    std::ofstream(folder + "/" + std::to_string(i) + ".json") << R"({"include": [)" << next << ", " << next << "]}";
  }
  std::ofstream(folder + "/16.json") << "{}";
  const auto error = [&](const std::string& name) -> std::string {
    try {
      parse_document(R"({"include": ")" + name + "\"}", "test.json", folder);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  expect_words(error("0.json"), {"more than 1000 includes"});
  EXPECT_EQ(error("8.json"), "") << "510 includes";
  expect_words(error("/dev/zero"), {"test.json:1:2: include", "'/dev/zero'", "no regular file"});
  std::ofstream(folder + "/long.json") << std::string((16 << 20) + 1, ' ');
  expect_words(error("long.json"), {"longer than 16 MiB"});
}

TEST(Config, IncludesAreMergedBelow) {
  const std::string folder = testing::TempDir();
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder + "/" + name) << text;
  };
  write(
      "view.json",
      R"({"camera": {"type": "ray", "origin": [0,0,3], "direction": [0,0,-1]}, "sampling": {"step": 0.5, "jitter": 1}})");
  const std::string text = small_config(R"(, "include": "view.json", "sampling": {"step": 0.125})");
  const Experiment e = plan_experiment(parse_document(text, "test.json", folder), registry());
  const ResolvedCase& c = e.cases.at(0).resolved;
  EXPECT_EQ(c.camera.type, "orthographic") << "a section that names its type is whole";
  EXPECT_EQ(c.sampling.parameters.number("step"), 0.125);
  EXPECT_EQ(c.sampling.parameters.number("jitter"), 1.0);
  write("loop.json", R"({"include": "loop.json"})");
  EXPECT_THROW(load_document(folder + "/loop.json"), InputError);
  EXPECT_THROW(load_document(folder + "/none.json"), InputError);
}

TEST(Config, Intervals) {
  EXPECT_TRUE(in_interval("[0,inf)", 0));
  EXPECT_FALSE(in_interval("(0,inf)", 0));
  EXPECT_TRUE(in_interval("[0,1]", 1));
  EXPECT_FALSE(in_interval("[0,1)", 1));
}

TEST(Config, FrameworkDefaultsAreLegal) {
  for (const SectionType& s : section_types()) {
    for (const Parameter& p : s.keys) {
      if (p.default_value == nullptr) continue;
      const nlohmann::json value = nlohmann::json::parse(p.default_value);
      EXPECT_EQ(wrong_value(p, value), "") << s.section << "." << p.name;
      for (const JsonShape& shape : s.shapes) {
        if (shape.key != std::string(p.name)) continue;
        EXPECT_TRUE(shape.fits(value)) << s.section << "." << p.name;
      }
    }
  }
}

}  // namespace
}  // namespace dvrlab::front
