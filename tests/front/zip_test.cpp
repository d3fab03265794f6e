// Keys that vary together.
#include "framework/config/axes.h"
#include "tests/front/run_test.h"

namespace dvrlab::front {
namespace {

std::string axes(const std::string& text, const std::string& more = "") {
  return small_config(R"(, "axes": )" + text + more);
}

const std::string zipped =
    R"({"permutation": {"zip": [{"sampling.step": [2, 1, 0.5], "sampling.termination": {"log10": [0.01, 0.0001]}}]}})";

TEST(Zip, IsOneAxisWithOneChoicePerKey) {
  const Experiment e = plan(axes(zipped));
  ASSERT_EQ(e.cases.size(), 3u) << "not 9: the keys vary together";
  EXPECT_EQ(e.cases[1].id, "sampling.step=1,sampling.termination=0.001");
  const ParameterSet& p = e.cases[2].resolved.sampling.parameters;
  EXPECT_EQ(p.number("step"), 0.5);
  EXPECT_DOUBLE_EQ(p.number("termination"), 1e-4);
  ASSERT_EQ(e.cases[2].choices.size(), 2u);
  EXPECT_EQ(e.cases[2].choices[0].axis, e.cases[2].choices[1].axis);
}

TEST(Zip, TakesItsPlaceInTheProduct) {
  const Experiment e = plan(axes(R"({"permutation": {
    "seed": [1, 2],
    "zip": [{"sampling.step": [2, 1], "sampling.jitter": [0, 1]},
            {"estimator": [{"type": "direct"}, {"type": "direct"}], "image.size": [[4, 4], [6, 4]]}],
    "optical_model.shaded": [true, false]}})"));
  ASSERT_EQ(e.cases.size(), 16u);
  EXPECT_EQ(e.cases[0].id,
            "seed=1,sampling.step=2,sampling.jitter=0,estimator=direct,image.size=4+4,optical_model.shaded=true");
  EXPECT_EQ(e.cases[7].id,
            "seed=1,sampling.step=1,sampling.jitter=1,estimator=direct,image.size=6+4,optical_model.shaded=false");
}

TEST(Zip, OfVariants) {
  const Experiment e = plan(axes(R"({"variant": {"zip": [{"backend.threads": [1, 2], "backend.tile": [8, 16]}]}})"));
  ASSERT_EQ(e.cases.size(), 2u);
  EXPECT_EQ(e.cases[1].first_variant, 0u);
  EXPECT_EQ(e.cases[1].id, "backend.threads=2,backend.tile=16");
}

TEST(Zip, RepeatedValuesKeepTheirLabel) {
  const Experiment e = plan(axes(R"({"permutation": {"zip": [{"sampling.step": [1, 1, 0.5], "seed": [0, 1, 1]}]}})"));
  EXPECT_EQ(e.cases[0].id, "sampling.step=1,seed=0");
  EXPECT_EQ(e.cases[1].id, "sampling.step=1,seed=1");
  EXPECT_EQ(e.cases[2].id, "sampling.step=0.5,seed=1");
}

TEST(Zip, DifferentValuesThatReadAlikeHaveDifferentLabels) {
  const Experiment e = plan(axes(R"({"permutation": {"zip": [{
    "clip": [[{"normal": [1, 0, 0]}], [{"normal": [0, 1, 0]}], [{"normal": [1, 0, 0]}]], "seed": [0, 1, 2]}]}})"));
  EXPECT_NE(e.cases[0].choices[0].label, e.cases[1].choices[0].label);
  EXPECT_EQ(e.cases[0].choices[0].label, e.cases[2].choices[0].label);
}

TEST(Zip, ErrorsNameThePlace) {
  expect_error(axes(R"({"permutation": {"zip": [{"sampling.step": [2, 1, 0.5],
    "seed": [1, 2]}]}})"),
               {"test.json:10:5: axes.permutation.zip[0].seed", "found 2 values; must be 3", "'sampling.step'"});
  expect_error(axes(R"({"permutation": {"zip": {"seed": [1]}}})"),
               {"test.json:9:", "axes.permutation.zip", "must be a list of sections"});
  expect_error(axes(R"({"permutation": {"zip": []}})"), {"axes.permutation.zip", "must be a list of sections"});
  expect_error(axes(R"({"permutation": {"zip": [{}]}})"), {"axes.permutation.zip[0]", "must be a list of sections"});
  expect_error(
      axes(R"({"permutation": {"zip": [{"sampling.stepp": [1], "seed": [1]}]}})"),
      {"axes.permutation.zip[0].sampling.stepp", "unknown key 'stepp'", "did you mean 'step'?", "legal: jitter"});
  expect_error(axes(R"({"permutation": {"zip": [{"seed": [1, -1], "repeat": [1, 2]}]}})"),
               {"axes.permutation.zip[0].seed[1]", "found -1"});
  expect_error(axes(R"({"permutation": {"seed": [3], "zip": [{"seed": [1], "repeat": [1]}]}})"), {"axis twice"});
  expect_error(axes(R"({"permutation": {"zip": [{"seed": {"log2": [1, 0]}, "repeat": [1]}]}})"),
               {"axes.permutation.zip[0].seed", "\"log10\""});
  expect_error(axes(R"({"permutations": {"seed": [3]}})"), {"axes.permutations", "did you mean 'permutation'?"});
}

TEST(Axes, KeysThatCannotBeVaried) {
  for (const std::string key : {"", ".", "[0]", "lights[x].color", "name", "expect", "base_folder", "axes.variant"}) {
    const std::vector<std::string> lines = errors_of(axes(R"({"permutation": {")" + key + R"(": [1, 2]}})"));
    ASSERT_EQ(lines.size(), 1u) << key << ": " << testing::PrintToString(lines);
    expect_words(lines[0], {"test.json:9:", "axes.permutation"});
  }
  expect_error(axes(R"({"permutation": {"name": ["a", "b"]}})"), {"axes.permutation.name", "one for all cases"});
  expect_error(axes(R"({"permutation": {"lights[x].color": [1]}})"), {"'[x]' is no index"});
}

TEST(Zip, SetReachesIt) {
  EXPECT_EQ(plan(axes(zipped), {"axes.permutation.zip=[{\"seed\": [1, 2]}]"}).cases.size(), 2u);
  EXPECT_EQ(plan(axes(zipped), {"axes.permutation.zip[0].sampling.step=[4,3,2]"}).cases[0].id,
            "sampling.step=4,sampling.termination=0.01");
  expect_error(axes(zipped), {"axes.permutation.zip[0].sampling.step decides this key"}, {"sampling.step=1"});
  expect_error(axes(zipped), {"--set", "there is no section 'axes.permutation.zip[1]'"},
               {"axes.permutation.zip[1].seed=[1]"});
  expect_error(axes(zipped), {"--set: axes.permutation.zip[0].sampling.step[1]", "found -3"},
               {"axes.permutation.zip[0].sampling.step=[4,-3,2]"});
  expect_error(small_config(R"(, "axes": 3)"), {"test.json:9:3: axes", "must be a section"},
               {"axes.permutation.seed=[1]"});
}

TEST(Zip, ReferencesAreSharedWhereTheirPatchDecides) {
  const Experiment e = plan(axes(zipped, R"(, "reference": {"fine": {"sampling.step": 0.1}, "own": {"seed": 4}})"));
  std::size_t fine = 0, own = 0;
  for (const PlannedCase& c : e.cases) {
    fine += c.reference_name == "fine";
    own += c.reference_name == "own";
  }
  EXPECT_EQ(fine, 1u) << "the patch decides the step, and every reference the termination";
  EXPECT_EQ(own, 3u);
}

class ZipRun : public Run {
 protected:
  /// The coarser a case, the larger its error; `expectation` begins after the metric's name.
  RunSummary run_with(const std::string& permutation, const std::string& expectation) {
    return run(axes(R"({"permutation": )" + permutation + "}",
                    R"(, "metrics": ["rmse"], "reference": {"fine": {"sampling.step": 0.0625}},
    "expect": [{"metric": "rmse", "against": "fine", )" +
                        expectation + "}]"));
  }
};

TEST_F(ZipRun, OrderAndWhereWork) {
  const std::string both =
      R"({"zip": [{"sampling.step": [2, 1, 0.5], "sampling.termination": [0.0003, 0.0002, 0.0001]}]})";
  EXPECT_EQ(exit_code(run_with(both, R"("order": {"by": "sampling.step", "is": "increasing"})")), 0);
  EXPECT_EQ(exit_code(run_with(both, R"("order": {"by": "sampling.step", "is": "decreasing"})")), 1);
  const RunSummary s = run_with(both, R"("at_most": 0, "where": {"sampling.termination": 0.0003})");
  EXPECT_EQ(exit_code(s), 1);
  std::size_t judged = 0;
  for (const CaseRecord& r : s.records) judged += r.expectations.size();
  EXPECT_EQ(judged, 1u);
  expect_words(text_of(s.folder + "/results.csv"), {"sampling.step", "sampling.termination"});
}

// An axis of whole sections orders by a key in them.
TEST_F(ZipRun, OrderByAKeyOfASection) {
  const std::string sections = R"({"sampling": [{"type": "uniform", "step": 2}, {"type": "uniform", "step": 0.5}]})";
  EXPECT_EQ(exit_code(run_with(sections, R"("order": {"by": "sampling.step", "is": "increasing"})")), 0);
  EXPECT_EQ(exit_code(run_with(sections, R"("order": {"by": "sampling.step", "is": "decreasing"})")), 1);
}

}  // namespace
}  // namespace dvrlab::front
