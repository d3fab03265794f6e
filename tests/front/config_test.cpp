// What a config may say, and what dvrlab says when it is wrong.
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
