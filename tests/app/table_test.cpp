// `dvrlab table`: the errors of tables over all pairs of values.
#include <algorithm>

#include "framework/config/experiment.h"
#include "framework/scene/scene.h"
#include "framework/table_study.h"
#include "tests/app/program.h"

namespace dvrlab::app_test {
namespace {

using Table = Program;

constexpr const char* config = R"({
  "name": "study",
  "data": { "type": "procedural", "field": "ramp", "offset": 0.5, "scale": 0.5, "size": [9, 9, 9] },
  "optical_model": { "type": "absorption_emission", "extinction": [[0, 0.5], [1, 3]], "color": [[0, 0.1, 0.9, 0.5], [1, 0.9, 0.2, 0.4]] },
  "estimator": { "type": "power_series", "table_size": 4096 },
  "sampling": { "type": "uniform", "step": 0.4, "unit": "world" },
  "camera": { "type": "perspective", "position": [1, 2, 3] },
  "image": { "size": [8, 8] }, "backend": { "type": "cpu" } })";

TableStudy study(const std::vector<std::string>& set) {
  const Registry registry;
  const Experiment e = plan_experiment(parse_document(config, "study.json", ".", set), registry);
  FieldCache fields;
  const ResolvedCase& c = e.cases.front().resolved;
  return study_table(c, registry, *fields.load(c, registry), 17, 3);
}

TEST(TableStudies, DepthsAndErrorsAreThoseOfTheSegments) {
  const TableStudy s = study({});
  ASSERT_EQ(s.value.size(), 17u);
  EXPECT_NEAR(s.value.front(), 0, 1e-12);
  EXPECT_NEAR(s.value.back(), 1, 1e-12);
  EXPECT_DOUBLE_EQ(s.length, 0.4);
  EXPECT_EQ(s.bytes, 48u * 4098u + 16u) << "one group: sum, its rounding and mean, as floats; one quadrature point";
  EXPECT_GT(s.build_seconds, 0);
  double worst = 0;
  for (std::size_t y = 0; y < 17; ++y) {
    for (std::size_t x = 0; x < 17; ++x) {
      const double v0 = s.value[x], v1 = s.value[y], depth = 0.4 * (0.5 + 1.25 * (v0 + v1));
      EXPECT_NEAR(s.depth[17 * y + x], depth, 1e-7);
      EXPECT_LE(s.error[17 * y + x], depth * depth / 8 * 0.8 * std::abs(v1 - v0) + 1.5e-4) << v0 << " " << v1;
      worst = std::max(worst, s.error[17 * y + x]);
    }
  }
  EXPECT_EQ(worst, s.worst);
  EXPECT_GT(worst, 1e-3) << "order 1 is not exact where the colour changes";
  std::size_t pairs = 0;
  for (const DepthClass& d : s.classes) pairs += d.pairs;
  EXPECT_EQ(pairs, 17u * 17u);
  // v1 < v0 and v1 > v0 differ: the picture is not turned round.
  EXPECT_NE(s.error[17 * 16], s.error[16]);
}

TEST(TableStudies, WorseTablesAreSeen) {
  const TableStudy series = study({}), higher = study({"estimator.order=3"});
  const TableStudy exact = study({R"(estimator={"type":"exact"})", "optical_model.tf=nodes"});
  const TableStudy coarse = study({"estimator.table_size=8"});
  EXPECT_LT(exact.worst, 1e-6);
  EXPECT_LT(4 * higher.worst, series.worst);
  EXPECT_GT(coarse.worst, 2 * series.worst);
  EXPECT_LT(coarse.bytes, series.bytes / 100);
  const FrameImage a = error_picture(series), b = error_picture(exact);
  // The pair (1, 0) lies at the bottom right, (1, 1) at the top right.
  EXPECT_GT(a.color[3 * (16 * 17 + 16)], b.color[3 * (16 * 17 + 16)] + 0.3f);
  EXPECT_LT(a.color[3 * 16], 0.2f);
}

TEST_F(Table, WritesNumbersAndAPicture) {
  write("study.json", config);
  const nlohmann::json list =
      json_of("dvrlab table study.json --points 9 --json --set 'axes={\"permutation\":{\"estimator.order\":[1,3]}}'");
  ASSERT_EQ(list.size(), 2u);
  EXPECT_GT(list[0]["worst"].get<double>(), list[1]["worst"].get<double>());
  EXPECT_GT(list[0]["build_s"].get<double>(), 0);
  const std::string csv = read("out/study/tables/estimator.order=3/error.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 82);
  EXPECT_EQ(read("out/study/tables/estimator.order=3/error.png").substr(1, 3), "PNG");
  // A family of transfer functions as an axis.
  const nlohmann::json family = json_of(
      "dvrlab table study.json --points 9 --json --set optical_model.extinction=null --set "
      "optical_model.pulses.count=4 "
      "--set optical_model.pulses.width=0.05 --set "
      "'axes={\"permutation\":{\"optical_model.pulses.height\":[0.1,0.9]}}'");
  ASSERT_EQ(family.size(), 2u);
  EXPECT_LT(family[0]["worst"].get<double>(), family[1]["worst"].get<double>());
}

TEST_F(Table, OptionalDataMayBeMissing) {
  write("study.json", config);
  const Outcome r =
      run("dvrlab table study.json --points 5 --json --set 'axes={\"permutation\":{\"data\":[{\"type\":\"procedural\","
          "\"field\":\"ramp\",\"size\":[9,9,9]},{\"type\":\"nrrd\",\"file\":\"none.nrrd\",\"optional\":true}]}}'");
  EXPECT_EQ(r.code, 3);
  const nlohmann::json list = nlohmann::json::parse(r.out);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_TRUE(list[0].contains("worst"));
  EXPECT_TRUE(list[1].contains("not_supported"));
}

TEST_F(Table, RefusesTablesThatDoNotFit) {
  write("study.json", config);
  expect_one_error(run("dvrlab validate study.json --set limits.memory=100000000 --set "
                       "'estimator={\"type\":\"preintegrated\",\"table_size\":65000}'"),
                   2, {"preintegrated", "MiB", "limits.memory allows 95.4 MiB", "smaller table_size"});
  EXPECT_EQ(run("dvrlab validate study.json --set limits.memory=100000000").code, 0);
  // A table of 256 MiB and what its making needs, and no more than that.
  const std::string unlit =
      "dvrlab validate study.json --set 'estimator={\"type\":\"preintegrated\",\"table_size\":4096,"
      "\"lookup\":\"plain\"}' --set limits.memory=";
  EXPECT_EQ(run(unlit + "640000000").code, 0);
  EXPECT_EQ(run(unlit + "500000000").code, 2);
  EXPECT_EQ(run("dvrlab validate study.json --set limits.memory=1000").code, 0) << "order 1 has no tables of its own";
  EXPECT_EQ(run("dvrlab validate study.json --set estimator.order=3 --set limits.memory=3000000").code, 0);
}

}  // namespace
}  // namespace dvrlab::app_test
