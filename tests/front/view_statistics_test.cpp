// Mean and worst over views: the numbers, and what a run says of them.
#include "framework/report/view_statistics.h"

#include <cmath>
#include <limits>

#include "framework/image/image_io.h"
#include "framework/metric/measure.h"
#include "framework/report/judge.h"
#include "tests/front/run_test.h"

namespace dvrlab::front {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();

TEST(ViewStatistic, MeanAndWorst) {
  const ViewStatistic higher = view_statistic({41, 38, 44, 38}, true), lower = view_statistic({1, 3, 2}, false);
  EXPECT_DOUBLE_EQ(higher.mean, 40.25);
  EXPECT_EQ(higher.worst, 38);
  EXPECT_EQ(higher.worst_at, 1u) << "the first of equals";
  EXPECT_DOUBLE_EQ(lower.mean, 2);
  EXPECT_EQ(lower.worst, 3);
  EXPECT_EQ(lower.worst_at, 1u);
}

TEST(ViewStatistic, PerfectInfinitiesDoNotEnterTheMeanOthersDo) {
  const ViewStatistic some = view_statistic({inf, 40, 42}, true);
  EXPECT_EQ(some.mean, 41);
  EXPECT_EQ(some.worst, 40);
  EXPECT_EQ(some.perfect, 1u);
  const ViewStatistic all = view_statistic({inf, inf}, true);
  EXPECT_EQ(all.mean, inf);
  EXPECT_EQ(all.worst, inf);
  EXPECT_EQ(all.perfect, 2u);
  const ViewStatistic bad = view_statistic({0.5, inf, 0.25}, false);
  EXPECT_EQ(bad.mean, inf) << "an infinite error is no value to leave out";
  EXPECT_EQ(bad.worst, inf);
  EXPECT_EQ(bad.worst_at, 1u);
  EXPECT_EQ(bad.perfect, 0u);
}

TEST(ViewStatistic, NanIsWorstOfAll) {
  for (const bool higher : {true, false}) {
    const ViewStatistic s = view_statistic({1, nan, -inf, inf}, higher);
    EXPECT_TRUE(std::isnan(s.mean));
    EXPECT_TRUE(std::isnan(s.worst));
    EXPECT_EQ(s.worst_at, 1u);
  }
}

class Views : public Run {
 protected:
  /// Four views of a field without symmetry, coarse against fine; `expectation` may be "".
  std::string config(const std::string& expectation, const std::string& more = "") {
    return R"({"name": "views",
      "data": {"type": "procedural", "field": "marschner_lobb", "size": [12, 14, 10]},
      "optical_model": {"type": "absorption_emission", "extinction": [[0, 0], [1, 4]], "color": [[0, 1, 0.5, 0.25]]},
      "estimator": {"type": "direct"}, "image": {"size": [16, 12]}, "backend": {"type": "cpu"},
      "camera": {"type": "orbit", "views": 4, "elevation_deg": 33, "distance": 3},
      "metrics": ["psnr", "max_abs"], "reference": {"fine": {"sampling.step": 0.0625}},
      "axes": {"permutation": {"sampling.step": [3, 1]}})" +
           more +
           (expectation.empty() ? "" : R"(, "expect": [{"metric": "psnr", "against": "fine", )" + expectation + "}]") +
           "}";
  }
};

TEST_F(Views, ResultsSayMeanAndWorst) {
  const RunSummary s = run(config(""));
  ASSERT_EQ(exit_code(s), 0) << summary_text(s);
  double sum = 0, worst = inf;
  std::string worst_view;
  for (const CaseRecord& r : s.records) {
    if (!r.plan->reference_name.empty() || r.plan->resolved.sampling.parameters.number("step") != 3) continue;
    const double value = r.value("psnr", "fine").value();
    sum += value;
    if (value < worst) worst_view = r.plan->choices.at(0).label;
    worst = std::min(worst, value);
  }
  const std::vector<ViewRow> rows = view_rows(s.records);
  ASSERT_EQ(rows.size(), 2u * (5 + 3)) << "two steps; max_abs.x and .y are places, not measures";
  EXPECT_EQ(rows[0].metric, "psnr");
  EXPECT_DOUBLE_EQ(rows[0].statistic.mean, sum / 4);
  EXPECT_EQ(rows[0].statistic.worst, worst);
  EXPECT_EQ(rows[0].worst_view, worst_view);
  EXPECT_EQ(rows[0].views, 4u);
  ASSERT_EQ(rows[0].choices.size(), 1u);
  EXPECT_EQ(rows[0].choices[0].label, "3");
  const std::string table = text_of(s.folder + "/views.csv");
  expect_words(table, {"sampling.step,against,metric,mean,worst,worst_view,views,planned,perfect\n", "\n3,fine,psnr,"});
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 17);
  const auto json = summary_json(s)["views"];
  ASSERT_EQ(json.size(), 16u);
  EXPECT_EQ(json[0]["worst"], worst);
  EXPECT_EQ(json[0]["choices"]["sampling.step"], "3");
  expect_words(summary_text(s), {"over views of", "sampling.step=3", "psnr against fine", "max_abs against fine"});
  EXPECT_EQ(summary_text(s).find("psnr.r"), std::string::npos) << "people see the first value of each metric";
}

TEST_F(Views, WithoutViewsThereIsNoFile) {
  run(config(""));
  const RunSummary s = run(config(""), {"camera.view=1"});
  EXPECT_FALSE(fs::exists(s.folder + "/views.csv")) << "that of the earlier run";
  EXPECT_TRUE(view_rows(s.records).empty());
}

TEST_F(Views, ExpectationsAskForMeanOrWorst) {
  const std::vector<ViewRow> rows = view_rows(run(config("")).records);
  const double mean = rows[0].statistic.mean, worst = rows[0].statistic.worst;
  ASSERT_GT(mean, worst + 0.01) << "the views differ";
  const std::string between = nlohmann::json((mean + worst) / 2).dump();
  const std::string where = R"("where": {"sampling.step": 3}, "over": "views", "at_least": )" + between;
  const RunSummary good = run(config(where + R"(, "take": "mean")"));
  EXPECT_EQ(exit_code(good), 0) << summary_text(good);
  const RunSummary bad = run(config(where + R"(, "take": "worst")"));
  EXPECT_EQ(exit_code(bad), 1);
  expect_words(summary_text(bad), {"fail: expected worst over views of psnr against fine >= ",
                                   "found " + nlohmann::json(worst).dump(), "camera.view=" + rows[0].worst_view});
  std::size_t judged = 0;
  for (const CaseRecord& r : bad.records) judged += r.expectations.size();
  EXPECT_EQ(judged, 4u) << "every view of the group";
  const std::string order = R"("over": "views", "take": "mean", "order": {"by": "sampling.step", "is": )";
  EXPECT_EQ(exit_code(run(config(order + R"("decreasing"})"))), 0);
  EXPECT_EQ(exit_code(run(config(order + R"("increasing"})"))), 1);
}

// A view that could not run leaves no statement about all of them.
TEST_F(Views, MissingViewIsNoSuccess) {
  RunSummary s = run(config(R"("over": "views", "at_least": 1)", R"(, "limits": {"memory": null})"));
  ASSERT_EQ(exit_code(s), 0);
  for (CaseRecord& r : s.records) r.expectations.clear();
  CaseRecord& lost = *std::find_if(s.records.begin(), s.records.end(),
                                   [](const CaseRecord& r) { return r.plan->reference_name.empty(); });
  lost.measures.clear();
  lost.ran = false;
  lost.verdict = Verdict::not_supported;
  lost.reason = "no device";
  judge_expectations(*s.experiment, s.records);
  EXPECT_EQ(exit_code(s), 3);
  expect_words(summary_text(s), {"1 of 4 views have no value", "no device", "3 of 4"});
}

TEST_F(Views, CaseFileOfOneViewRendersThatView) {
  const RunSummary s = run(config(""));
  const std::string file = s.folder + "/cases/camera.view=2,sampling.step=3/";
  const RunSummary again = run_experiment({file + "case.json", {}, {}, folder_ + "/again"});
  ASSERT_EQ(again.records.size(), 1u);
  const FrameImage a = read_exr(file + "image.exr"), b = read_exr(again.folder + "/cases/case/image.exr"),
                   other = read_exr(s.folder + "/cases/camera.view=1,sampling.step=3/image.exr");
  EXPECT_EQ(compare_bits(a, b).different, 0u);
  EXPECT_GT(compare_bits(a, other).different, 0u);
}

TEST_F(Views, SingleCaseVerbsAskForOne) {
  std::ofstream(folder_ + "/views.json") << config(R"("over": "views", "at_least": 1)");
  const std::string render = "render '" + folder_ + "/views.json' -o '" + folder_ + "/a.png'";
  EXPECT_EQ(command(render), 2);
  expect_words(printed_, {"8 cases, this verb takes one", "--set camera.view=0", "axes={}"});
  EXPECT_EQ(command(render + " --set axes={}"), 2);
  expect_words(printed_, {"4 cases, this verb takes one", "--set camera.view=0"});
  EXPECT_EQ(command(render + " --set axes={} --set camera.view=0"), 0) << printed_;
  EXPECT_EQ(command("probe '" + folder_ + "/views.json' --pixel 1,1 --set axes={}"), 2);
  expect_words(printed_, {"--set camera.view=0"});
}

}  // namespace
}  // namespace dvrlab::front
