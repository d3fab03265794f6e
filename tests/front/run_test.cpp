// A whole run: results tree, verdicts, exit codes; then the same through the command line.
#include "tests/front/run_test.h"

#include "framework/image/averaged.h"
#include "framework/image/image_io.h"
#include "framework/metric/measure.h"
#include "framework/report/judge.h"
#include "framework/report/pretty_json.h"

namespace dvrlab::front {
namespace {

const std::string variants = R"(, "axes": {"variant": {"backend.isa": ["scalar", "auto"]}})";

TEST_F(Run, WritesTheTreeAndRunsAgainFromIt) {
  const RunSummary s = run(
      small_config(R"(, "metrics": ["rmse"], "repeat": 3, "reference": {"fine": {"sampling.step": 0.25}})" + variants));
  ASSERT_EQ(s.records.size(), 3u);
  EXPECT_EQ(exit_code(s), 0) << summary_text(s);
  const std::string first = folder_ + "/out/small/cases/backend.isa=scalar";
  for (const char* file : {"case.json", "image.exr", "image.png"}) EXPECT_TRUE(fs::exists(first + "/" + file)) << file;
  const nlohmann::ordered_json record = nlohmann::ordered_json::parse(text_of(first + "/case.json"));
  std::vector<std::string> sections;
  for (const auto& [key, value] : record.items()) sections.push_back(key);
  EXPECT_EQ(sections,
            (std::vector<std::string>{"config", "plugins", "scene", "backend", "image", "metrics", "report"}));
  EXPECT_GT(record["backend"]["counters"]["samples"].get<int>(), 0);
  EXPECT_EQ(record["backend"]["repeats"], 3);
  EXPECT_TRUE(record["backend"]["times"]["march"].contains("interquartile_range_s"));
  EXPECT_TRUE(record["metrics"]["against"]["fine"].contains("rmse"));
  EXPECT_FALSE(record["scene"]["sha256"].get<std::string>().empty());
  ASSERT_TRUE(s.records[2].variant.has_value());
  EXPECT_EQ(s.records[2].variant->max_abs, 0.0);
  const std::string table = text_of(folder_ + "/out/small/results.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4);

  const RunSummary again = run_experiment({first + "/case.json", {}, {}, folder_ + "/again"});
  const FrameImage a = read_exr(first + "/image.exr"), b = read_exr(again.folder + "/cases/case/image.exr");
  EXPECT_EQ(compare_bits(a, b).different, 0u);
}

TEST_F(Run, ExpectationsDecideTheExitCode) {
  const std::string with = R"(, "metrics": ["rmse"], "reference": {"fine": {"sampling.step": 0.0625}},
    "axes": {"permutation": {"sampling.step": [2, 1, 0.5]}}, "expect": [{"metric": "rmse", "against": "fine", )";
  EXPECT_EQ(exit_code(run(small_config(with + R"("at_most": 1}])"))), 0);
  const RunSummary failed = run(small_config(with + R"("at_most": 0, "where": {"sampling.step": 2}}])"));
  EXPECT_EQ(exit_code(failed), 1);
  expect_words(summary_text(failed), {"fail: expected rmse against fine <= 0", "found 0."});
  EXPECT_EQ(exit_code(run(small_config(with + R"("order": {"by": "sampling.step", "is": "increasing"}}])"))), 0);
  EXPECT_EQ(exit_code(run(small_config(with + R"("order": {"by": "sampling.step", "is": "decreasing"}}])"))), 1);
}

// An order of words, over the cases that the list names; a curve that is a straight line in a power of a key.
TEST_F(Run, OrdersOfValuesAndLines) {
  const std::string words = R"(, "metrics": ["rmse"], "reference": {"fine": {"sampling.step": 0.0625}},
    "axes": {"permutation": {"zip": [{"panel": ["a", "b", "c"], "sampling.step": [2, 1, 0.5]}]}},
    "expect": [{"metric": "rmse", "against": "fine", "order": {"by": "panel", )";
  EXPECT_EQ(exit_code(run(small_config(words + R"("values": ["a", "b", "c"], "is": "decreasing"}}])"))), 0);
  EXPECT_EQ(exit_code(run(small_config(words + R"("values": ["a", "c"], "is": "decreasing"}}])"))), 0);
  EXPECT_EQ(exit_code(run(small_config(words + R"("values": ["c", "a"], "is": "decreasing"}}])"))), 1);
  expect_error(small_config(words + R"("values": ["c", "d"], "is": "decreasing"}}])"),
               {"no case that is meant has \"d\" at 'panel'"});
  EXPECT_TRUE(fs::exists(folder_ + "/out/small/cases/panel=a/case.json")) << "a panel names its case";

  // The depth of a medium is proportional to 1 / dl_std.
  const std::string line = R"(, "metrics": ["bias"], "reference": {"thin": {"optical_model.dl_std": 1000}},
    "axes": {"permutation": {"optical_model.dl_std": [1, 2, 5, 11]}}, "expect": [{"metric": "bias.depth",
    "against": "thin", "affine": {"by": "optical_model.dl_std", )";
  const std::vector<std::string> opacity = {"optical_model.extinction=null",
                                            "optical_model.opacity=[[0,0],[0.3,0.2],[1,0.6]]"};
  EXPECT_EQ(exit_code(run(small_config(line + R"("power": -1, "within": 1e-4}}])"), opacity)), 0);
  EXPECT_EQ(exit_code(run(small_config(line + R"("power": -2, "within": 1e-2}}])"), opacity)), 1);
  EXPECT_EQ(exit_code(run(small_config(line + R"("within": 1e-2}}])"), opacity)), 1);
}

// Several rays per pixel: the mean of the larger image.
TEST_F(Run, SupersamplingAveragesRays) {
  run(small_config(""), {"image.supersampling=3"});
  const FrameImage fine = read_exr(folder_ + "/out/small/cases/case/image.exr");
  run(small_config(""),
      {"image.size=[" + std::to_string(3 * fine.width) + "," + std::to_string(3 * fine.height) + "]"});
  const FrameImage large = read_exr(folder_ + "/out/small/cases/case/image.exr");
  EXPECT_EQ(compare_bits(averaged(large, 3), fine).different, 0u);
  run(small_config(""));
  EXPECT_GT(compare_bits(read_exr(folder_ + "/out/small/cases/case/image.exr"), fine).different, 0u);
}

TEST_F(Run, ExpectationWithoutAMeasuredValueIsNoSuccess) {
  const RunSummary s = run(small_config(R"(, "metrics": ["rmse"], "reference": {"fine": {"sampling.step": 0.5}},
    "expect": [{"metric": "rmse.typo", "against": "fine", "at_most": 1}])"));
  EXPECT_EQ(exit_code(s), 3) << summary_text(s);
}

TEST_F(Run, ImageWithInfinitiesFails) {
  const RunSummary s = run(small_config(R"(, "illumination": [{"type": "blinn_phong"}])"),
                           {"data.scale=1e30", "optical_model.shaded=true", "optical_model.extinction=[[0,1]]"});
  ASSERT_EQ(s.records.size(), 1u);
  EXPECT_EQ(s.records[0].verdict, Verdict::fail) << summary_text(s);
  expect_words(s.records[0].reason, {"not finite", "pixel"});
}

TEST_F(Run, WhatCannotRunIsCountedAndDoesNotLoseTheOthers) {
  const RunSummary s = run(small_config(R"(, "axes": {"permutation": {"limits.memory": [1, null]}})"));
  ASSERT_EQ(s.records.size(), 2u);
  EXPECT_EQ(s.records[0].verdict, Verdict::not_supported);
  expect_words(s.records[0].reason, {"limits.memory allows"});
  EXPECT_EQ(s.records[1].verdict, Verdict::pass);
  EXPECT_EQ(exit_code(s), 0) << "not supported is a verdict, not a failure";
  EXPECT_TRUE(fs::exists(folder_ + "/out/small/cases/limits.memory=1/case.json"));
  EXPECT_EQ(exit_code(run(small_config(R"(, "limits": {"memory": 1})"))), 3) << "nothing could run";
}

TEST_F(Run, OptionalDataThatIsMissing) {
  const std::string missing = R"("data": {"type": "nrrd", "file": "none.nrrd", "optional": )";
  const std::string start = small_config().substr(0, small_config().find("\"data\"")),
                    rest = small_config().substr(small_config().find("\"optical_model\""));
  const RunSummary s = run(start + missing + "true}," + rest);
  EXPECT_EQ(s.records.at(0).verdict, Verdict::not_supported);
  expect_words(s.records[0].reason, {"data.file", "none.nrrd"});
  EXPECT_THROW(run(start + missing + "false}," + rest), InputError);
}

TEST_F(Run, InterruptLeavesAValidTree) {
  std::ofstream(folder_ + "/small.json") << small_config(
      R"(, "axes": {"permutation": {"sampling.step": {"lin": [0.001, 0.002, 2000]}}})");
  const std::string line = "timeout --preserve-status -s INT 6 " + std::string(DVRLAB_PROGRAM) + " run '" + folder_ +
                           "/small.json' --out '" + folder_ + "/out' 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3);
  EXPECT_TRUE(fs::exists(folder_ + "/out/small/results.csv"));
  for (const fs::directory_entry& c : fs::directory_iterator(folder_ + "/out/small/cases")) {
    EXPECT_TRUE(nlohmann::json::accept(text_of(c.path().string() + "/case.json"))) << c.path();
  }
}

TEST(CompareBits, FindsWhatDiffers) {
  const FrameImage a{1, 1, {0, 0.5f, 1}, {1, 1, 1}};
  FrameImage b = a;
  EXPECT_EQ(compare_bits(a, b).different, 0u);
  b.color[1] = 0.5000001f;
  EXPECT_EQ(compare_bits(a, b).different, 1u);
  EXPECT_GT(compare_bits(a, b).max_abs, 0.0);
  b = a;
  b.color[0] = -0.0f;
  EXPECT_EQ(compare_bits(a, b).different, 1u) << "another bit, no difference";
  EXPECT_EQ(compare_bits(a, b).max_abs, 0.0);
  b.trans[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(std::isinf(compare_bits(a, b).max_abs));
}

TEST(Statistics, MedianAndInterquartileRange) {
  const auto s = phase_statistics(
      {{{"march", 1, 2}}, {{"march", 2, 2}}, {{"march", 3, 2}}, {{"march", 10, -1}}, {{"march", 4, 2}}});
  ASSERT_EQ(s.size(), 1u);
  EXPECT_EQ(s[0].median, 3.0);
  EXPECT_EQ(s[0].interquartile_range, 2.0);
  EXPECT_LT(s[0].cpu_median, 0.0) << "not measured in every repeat";
}

TEST(PrettyJson, IsTheSameValue) {
  const auto value =
      nlohmann::ordered_json::parse(R"({"b": [1, 2.5], "a": {"x": [[0, 1], []], "y": {}}, "t": "a\"b"})");
  EXPECT_EQ(nlohmann::ordered_json::parse(pretty_json(value)), value);
}

TEST_F(Run, CommandLine) {
  std::ofstream(folder_ + "/small.json") << small_config();
  const std::string config = "'" + folder_ + "/small.json'";
  EXPECT_EQ(command("list"), 0);
  expect_words(printed_, {"estimator", "direct", "perspective"});
  EXPECT_EQ(command("list estimater"), 2);
  expect_words(printed_, {"did you mean 'estimator'?"});
  EXPECT_EQ(command("describe camera.perspective"), 0);
  expect_words(printed_, {"fov_deg", "degree", "(0,180)"});
  EXPECT_EQ(command("describe procedural"), 0);
  expect_words(printed_, {"angular frequency. (only with field=sinusoid)"});
  EXPECT_EQ(command("describe dirct"), 2);
  EXPECT_EQ(command("validate " + config), 0);
  EXPECT_EQ(command("validate " + config + " --set sampling.step=-1"), 2);
  EXPECT_EQ(command("render " + config + " -o '" + folder_ + "/a.exr'"), 0) << printed_;
  EXPECT_EQ(command("render " + config + " --set sampling.step=0.5 -o '" + folder_ + "/b.exr'"), 0);
  EXPECT_EQ(command("render " + config + " -o '" + folder_ + "/b.gif'"), 2);
  EXPECT_EQ(command("render " + config + " --set 'limits.memory=1' -o '" + folder_ + "/c.exr'"), 3);
  EXPECT_EQ(command("compare '" + folder_ + "/a.exr' '" + folder_ + "/a.exr'"), 0);
  EXPECT_EQ(command("compare '" + folder_ + "/a.exr' '" + folder_ + "/b.exr'"), 1);
  EXPECT_EQ(command("compare --tolerance 1 '" + folder_ + "/a.exr' '" + folder_ + "/b.exr'"), 0);
  EXPECT_EQ(command("run " + config + " --repeat 2 --out '" + folder_ + "/out'"), 0);
  EXPECT_EQ(command("probe " + config + " --pixel 4,3"), 0) << printed_;
  EXPECT_EQ(command("probe " + config + " --pixel 40,3"), 2);
  EXPECT_EQ(command("nonsense"), 2);
  EXPECT_EQ(command(""), 2);
}

}  // namespace
}  // namespace dvrlab::front
