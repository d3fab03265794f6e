// An orbit camera becomes an axis of views.
#include <chrono>
#include <set>

#include "framework/metric/measure.h"
#include "tests/front/front_test.h"

namespace dvrlab::front {
namespace {

/// The small config with an orbit; `camera` and `more` begin with a comma.
std::string orbit(const std::string& camera = "", const std::string& more = "") {
  std::string text = small_config(more);
  const std::size_t begin = text.find("\"camera\""), end = text.find('\n', begin);
  return text.replace(begin, end - begin, R"("camera": {"type": "orbit", "views": 3)" + camera + "},");
}

std::vector<std::string> ids(const Experiment& e) {
  std::vector<std::string> all;
  for (const PlannedCase& c : e.cases) all.push_back(c.id);
  return all;
}

TEST(Orbit, EveryViewIsACase) {
  const Experiment e = plan(orbit());
  EXPECT_EQ(ids(e), (std::vector<std::string>{"camera.view=0", "camera.view=1", "camera.view=2"}));
  EXPECT_EQ(e.cases[2].resolved.camera.parameters.json("view"), 2);
  EXPECT_EQ(e.cases[2].resolved.config["camera"]["view"], 2);
  const Experiment again = plan(e.cases[2].resolved.config.dump());
  ASSERT_EQ(again.cases.size(), 1u) << "the config of one view is one view";
  EXPECT_EQ(again.cases[0].resolved.config["camera"], e.cases[2].resolved.config["camera"]);
}

TEST(Orbit, OneViewIsAskedForByItsIndex) {
  EXPECT_EQ(ids(plan(orbit(R"(, "view": 1)"))), (std::vector<std::string>{"case"}));
  EXPECT_EQ(ids(plan(orbit(), {"camera.view=0"})), (std::vector<std::string>{"case"}));
  EXPECT_EQ(ids(plan(orbit("", R"(, "axes": {"permutation": {"camera.view": [0, 2]}})"))),
            (std::vector<std::string>{"camera.view=0", "camera.view=2"}));
}

TEST(Orbit, LabelsSort) {
  const Experiment e = plan(orbit(), {"camera.views=12"});
  ASSERT_EQ(e.cases.size(), 12u);
  EXPECT_EQ(e.cases[3].id, "camera.view=03");
  EXPECT_EQ(e.cases[11].id, "camera.view=11");
}

// Each file is loaded once, and a view is through before the next one.
TEST(Orbit, DataRunOutsideTheViewsAndEverythingElseInside) {
  const Experiment e = plan(orbit("", R"(, "axes": {"permutation": {"sampling.step": [1, 0.5],
    "data.size": [[8, 8, 8], [9, 8, 8]]}})"),
                            {"camera.views=2"});
  EXPECT_EQ(ids(e),
            (std::vector<std::string>{
                "data.size=8+8+8,camera.view=0,sampling.step=1", "data.size=8+8+8,camera.view=0,sampling.step=0.5",
                "data.size=8+8+8,camera.view=1,sampling.step=1", "data.size=8+8+8,camera.view=1,sampling.step=0.5",
                "data.size=9+8+8,camera.view=0,sampling.step=1", "data.size=9+8+8,camera.view=0,sampling.step=0.5",
                "data.size=9+8+8,camera.view=1,sampling.step=1", "data.size=9+8+8,camera.view=1,sampling.step=0.5"}));
}

TEST(Orbit, CamerasMayHaveDifferentNumbersOfViews) {
  const Experiment e = plan(small_config(R"(, "axes": {"permutation": {"seed": [1, 2], "camera": [
    {"type": "orbit", "views": 2}, {"type": "perspective", "position": [0, 0, 3], "up": [0, 1, 0]}]}})"));
  EXPECT_EQ(ids(e), (std::vector<std::string>{"camera=orbit,camera.view=0,seed=1", "camera=orbit,camera.view=0,seed=2",
                                              "camera=orbit,camera.view=1,seed=1", "camera=orbit,camera.view=1,seed=2",
                                              "camera=perspective,seed=1", "camera=perspective,seed=2"}));
}

TEST(Orbit, ReferencesFollowTheView) {
  const Experiment e =
      plan(orbit("", R"(, "reference": {"fine": {"sampling.step": 0.25}, "tight": {"camera.fov_deg": 10}},
    "axes": {"permutation": {"sampling.step": [1, 0.5]}})"));
  std::set<std::string> fine;
  for (const PlannedCase& c : e.cases) {
    if (!c.reference_name.empty()) continue;
    const PlannedCase& reference = e.cases[c.references.at(0).second];
    fine.insert(reference.id);
    EXPECT_EQ(reference.resolved.config["camera"], c.resolved.config["camera"]) << c.id;
    const PlannedCase& tight = e.cases[c.references.at(1).second];
    EXPECT_EQ(tight.resolved.camera.parameters.json("view"), c.resolved.camera.parameters.json("view"));
    EXPECT_EQ(tight.resolved.camera.parameters.number("fov_deg"), 10);
  }
  EXPECT_EQ(fine.size(), 3u) << "one for each view, shared by the steps";
}

TEST(Orbit, ErrorsOfItsKeys) {
  expect_error(orbit(R"(, "veiws": 4)"),
               {"test.json:6:", "camera.veiws", "did you mean 'views'?", "legal: axis, distance"});
  expect_error(orbit(R"(, "view": 3)"), {"test.json:6:", "camera.view: found 3", "views 0 to 2"});
  expect_error(orbit(R"(, "view": -1)"), {"camera.view: found -1", "null (all views", "[0, views-1]"});
  expect_error(orbit(R"(, "view": 0.5)"), {"camera.view: found 0.5"});
  expect_error(orbit(), {"camera.views: found 0", "[1,10000]"}, {"camera.views=0"});
  expect_error(orbit(), {"camera.views: found \"many\""}, {"camera.views=many"});
  expect_error(orbit(R"(, "axis": [0, 0, 0])"), {"test.json:6:", "camera.axis", "is 0; give a direction"});
  expect_error(orbit(R"(, "distance": 0)"), {"camera.distance", "(0,inf)"});
  expect_error(orbit(R"(, "elevation_deg": 90)"), {"camera.elevation_deg", "(-90,90)"});
  expect_error(orbit(R"(, "path": "sphere", "elevation_deg": 5)"), {"camera.elevation_deg", "path is circle"});
  expect_error(orbit(R"(, "projection": "orthographic", "fov_deg": 5)"),
               {"camera.fov_deg", "projection is perspective"});
  expect_error(orbit(R"(, "projection": "parallel")"), {"camera.projection", "one of perspective, orthographic"});
  expect_error(orbit(R"(, "position": [1, 2, 3])"), {"camera.position", "unknown key", "target"});
}

TEST(Orbit, AllViewsAreRefusedWhereOneIsNeeded) {
  expect_error(orbit("", R"(, "axes": {"permutation": {"camera.view": [0,
    null]}})"),
               {"test.json:10:5: axes.permutation.camera.view[1]", "null stands for all views"});
  expect_error(orbit("", R"(, "reference": {"front": {"camera": {"type": "orbit"}}})"),
               {"reference.front.camera", "one image", "8", "index of a view"});
  expect_error(orbit("", R"(, "axes": {"variant": {"camera": [{"type": "orbit"}]}})"),
               {"axes.variant.camera[0]", "variant axis", "index of a view"});
  expect_error(orbit("", R"(, "axes": {"permutation": {"seed": {"lin": [1, 9999, 9999]}}})"),
               {"axes", "more than 100000 cases"}, {"camera.views=11"});
}

TEST(Orbit, ExpectationsOverViewsNeedViews) {
  const auto with = [](const std::string& expectation) {
    return R"(, "metrics": ["psnr"], "reference": {"fine": {"sampling.step": 0.25}}, "axes": {"permutation":
      {"sampling.step": [1, 0.5]}}, "expect": [{"metric": "psnr", "against": "fine", )" +
           expectation + "}]";
  };
  EXPECT_TRUE(errors_of(orbit("", with(R"("over": "views", "take": "mean", "at_least": 4)"))).empty());
  expect_error(small_config(with(R"("over": "views", "at_least": 4)")),
               {"test.json:10:", "expect[0]", "there are no views"});
  expect_error(orbit("", with(R"("over": "vews", "at_least": 4)")),
               {"expect[0].over", "did you mean 'views'?", "cases, views"});
  expect_error(orbit("", with(R"("take": "mean", "at_least": 4)")), {"expect[0].take", "only where over is views"});
  expect_error(orbit("", with(R"("over": "views", "take": "best", "at_least": 4)")), {"expect[0].take", "worst, mean"});
  expect_error(orbit("", with(R"("over": "views", "order": {"by": "camera.view", "is": "increasing"})")),
               {"expect[0]", "camera.view", "cases"});
}

TEST(Orbit, ManyViewsArePlannedAtOnceAndKeepFewImages) {
  const auto start = std::chrono::steady_clock::now();
  const Experiment e = plan(orbit("", R"(, "metrics": ["rmse"], "reference": {"fine": {"sampling.step": 0.25}},
    "axes": {"permutation": {"sampling.step": [2, 1, 0.5]}})"),
                            {"camera.views=360"});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_EQ(e.cases.size(), 360u * 4);
  std::printf("360 views x 3 values and their references planned in %.2f s\n", seconds);
  EXPECT_LT(seconds, 2.0);

  // The metrics stage on images of one pixel: what it keeps does not grow with the number of views.
  Measurer measurer(e, registry());
  std::size_t most = 0, measured = 0;
  for (std::size_t i = 0; i < e.cases.size(); ++i) {
    CaseRecord record;
    record.plan = &e.cases[i];
    measurer.measure_case(i, FrameImage{1, 1, {0, 0.5f, 1}, {1, 1, 1}}, record);
    most = std::max(most, measurer.kept());
    measured += record.measures.size();
    measurer.done(i);
  }
  EXPECT_EQ(measured, 360u * 3) << "every case against its reference";
  EXPECT_LE(most, 2u) << "the reference of the view, and the image that is being measured";
}

}  // namespace
}  // namespace dvrlab::front
