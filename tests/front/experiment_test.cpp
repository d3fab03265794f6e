// Axes, references and expectations become planned cases.
#include "framework/config/axes.h"
#include "tests/front/front_test.h"

namespace dvrlab::front {
namespace {

std::vector<std::string> ids(const Experiment& e) {
  std::vector<std::string> all;
  for (const PlannedCase& c : e.cases) all.push_back(c.id);
  return all;
}

TEST(Axes, FullProductWithPermutationsOutermostInTheirWrittenOrder) {
  const Experiment e = plan(small_config(R"(, "axes": {
    "variant": {"backend": [{"type": "cpu", "threads": 1}, {"type": "cpu", "threads": 2}]},
    "permutation": {"sampling.step": [1, 0.5], "estimator": [{"type": "direct"}]}})"));
  EXPECT_EQ(ids(e), (std::vector<std::string>{"sampling.step=1,estimator=direct,backend=cpu+threads=1",
                                              "sampling.step=1,estimator=direct,backend=cpu+threads=2",
                                              "sampling.step=0.5,estimator=direct,backend=cpu+threads=1",
                                              "sampling.step=0.5,estimator=direct,backend=cpu+threads=2"}));
  EXPECT_EQ(e.cases[1].first_variant, 0u);
  EXPECT_EQ(e.cases[3].first_variant, 2u);
  EXPECT_EQ(e.cases[3].resolved.sampling.parameters.number("step"), 0.5);
  EXPECT_EQ(e.cases[3].resolved.backend.parameters.integer("threads"), 2);
}

TEST(Axes, Ranges) {
  const auto steps = [](const std::string& range) {
    std::vector<double> values;
    for (const PlannedCase& c :
         plan(small_config(R"(, "axes": {"permutation": {"sampling.step": )" + range + "}}")).cases) {
      values.push_back(c.resolved.sampling.parameters.number("step"));
    }
    return values;
  };
  EXPECT_EQ(steps(R"({"log2": [2, 0.125]})"), (std::vector<double>{2, 1, 0.5, 0.25, 0.125}));
  EXPECT_EQ(steps(R"({"log10": [1, 100]})"), (std::vector<double>{1, 10, 100}));
  EXPECT_EQ(steps(R"({"lin": [1, 2, 3]})"), (std::vector<double>{1, 1.5, 2}));
}

TEST(Axes, ErrorsNameTheAxis) {
  expect_error(small_config(R"(, "axes": {"permutation": {"sampling.stepp": [1, 2]}})"),
               {"axes.permutation.sampling.stepp: unknown key", "did you mean 'step'?"});
  expect_error(small_config(R"(, "axes": {"permutation": {"sampling.step": [1, -2]}})"),
               {"axes.permutation.sampling.step[1]", "found -2"});
  expect_error(small_config(R"(, "axes": {"permutation": {"estimator": [{"type": "direkt"}]}})"),
               {"axes.permutation.estimator[0].type", "did you mean 'direct'?"});
  expect_error(small_config(R"(, "axes": {"permutation": {"sampling.step": []}})"),
               {"axes.permutation.sampling.step", "must be a list of values"});
  expect_error(small_config(R"(, "axes": {"variants": {}})"), {"axes.variants", "unknown key", "permutation, variant"});
  expect_error(small_config(R"(, "axes": {"variant": {"seed": [1]}, "permutation": {"seed": [2]}})"), {"axis twice"});
  expect_error(small_config(R"(, "axes": {"permutation": {"lights[3].color": [[1, 1, 1]]}})"), {"lights[3].color"});
}

TEST(Axes, IdsAreSafeAndUnique) {
  EXPECT_EQ(file_safe("a/b c"), "a_b_c");
  EXPECT_EQ(file_safe(".."), "_..");
  const Experiment e =
      plan(small_config(R"(, "axes": {"permutation": {"optical_model.color": [[[0,1,1,1]], [[0,1,1,1]]]}})"));
  EXPECT_NE(e.cases[0].id, e.cases[1].id);
  EXPECT_LE(e.cases[0].id.size(), 200u);
}

TEST(Reference, PatchesTheFirstVariantAndIsSharedWherePossible) {
  const Experiment e = plan(
      small_config(R"(, "axes": {"permutation": {"sampling.step": [1, 0.5]}, "variant": {"backend.threads": [1, 2]}},
    "reference": {"fine": {"sampling": {"step": 0.125}}, "tables": {"optical_model.tf": "nodes"}})"));
  EXPECT_EQ(ids(e), (std::vector<std::string>{
                        "reference=fine", "reference=tables,sampling.step=1", "sampling.step=1,backend.threads=1",
                        "sampling.step=1,backend.threads=2", "reference=tables,sampling.step=0.5",
                        "sampling.step=0.5,backend.threads=1", "sampling.step=0.5,backend.threads=2"}));
  const ResolvedCase& fine = e.cases[0].resolved;
  EXPECT_EQ(fine.sampling.parameters.number("step"), 0.125);
  EXPECT_EQ(fine.sampling.parameters.number("termination"), 0.0) << "a reference runs every ray to its end";
  EXPECT_EQ(fine.backend.parameters.integer("threads"), 1);
  EXPECT_EQ(e.cases[1].resolved.optical_model.parameters.text("tf"), "nodes");
  EXPECT_EQ(e.cases[6].references, (std::vector<std::pair<std::string, std::size_t>>{{"fine", 0}, {"tables", 4}}));
  expect_error(small_config(R"(, "reference": {"truth": {"sampling": {"stepp": 1}}})"),
               {"reference.truth.sampling.stepp", "did you mean 'step'?"});
  expect_error(small_config(R"(, "reference": {"truth": {"expect": []}})"),
               {"reference.truth.expect", "cannot change"});
}

TEST(Expect, IsCheckedBeforeAnythingRuns) {
  const auto with = [](const std::string& expectation) {
    return small_config(R"(, "metrics": ["psnr"], "reference": {"truth": {}}, "expect": [)" + expectation + "]");
  };
  EXPECT_TRUE(
      errors_of(
          with(R"({"metric": "psnr.r", "against": "truth", "at_least": 40, "where": {"estimator.type": "direct"}})"))
          .empty());
  expect_error(with(R"({"metric": "psnr", "against": "truth"})"), {"expect[0]", "exactly one of at_least"});
  expect_error(with(R"({"metric": "ssim", "against": "truth", "at_least": 1})"),
               {"expect[0]", "no metric 'ssim'", "psnr"});
  expect_error(with(R"({"metric": "psnr", "against": "thruth", "at_least": 1})"), {"did you mean 'truth'?"});
  expect_error(with(R"({"metric": "psnr", "against": "truth", "at_least": 1, "where": {"sampling.step": 7}})"),
               {"expect[0].where.sampling.step", "found 7, which no case has", "the values are 1"});
  expect_error(small_config(R"(, "metrics": ["psnr"], "reference": {"truth": {}},
    "axes": {"permutation": {"zip": [{"seed": [1, 2], "repeat": [1, 2]}]}}, "expect": [{"metric": "psnr",
    "against": "truth", "at_least": 1, "where": {"seed": 1, "repeat": 2}}])"),
               {"expect[0]", "no case is meant"});
  expect_error(with(R"({"metric": "psnr", "against": "truth", "order": {"by": "estimator.type", "is": "increasing"}})"),
               {"is no number"});
  expect_error(with(R"({"metric": "psnr", "against": "truth", "atleast": 1})"),
               {"expect[0].atleast", "did you mean 'at_least'?"});
}

}  // namespace
}  // namespace dvrlab::front
