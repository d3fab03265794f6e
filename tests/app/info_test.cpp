// `dvrlab info`, and what it is made of: histogram, orientation, recognition.
#include "framework/scene/histogram.h"
#include "framework/scene/orientation.h"
#include "tests/app/program.h"

namespace dvrlab::app_test {
namespace {

using Info = Program;

template <class T>
GridField grid_of(std::vector<T> voxels, VoxelType type) {
  GridField g;
  g.dims = {int(voxels.size()) / 4, 2, 2};
  g.type = type;
  const auto shared = std::make_shared<std::vector<T>>(std::move(voxels));
  g.voxels = {shared, shared->data()};
  return g;
}

TEST(Histogram, IntegersAreExact) {
  GridField g = grid_of<std::int16_t>({-5, -5, -5, 0, 1, 1, 2, 10}, VoxelType::i16);
  finish_grid(g, "error", 0);
  const Histogram h = histogram_of(g);
  ASSERT_EQ(h.count.size(), 16u);
  EXPECT_EQ(h.count[0], 3u);
  EXPECT_EQ(h.count[6], 2u);
  EXPECT_EQ(h.quantile(0.0), -5);
  EXPECT_EQ(h.quantile(3.0 / 8), -5);
  EXPECT_EQ(h.quantile(3.1 / 8), 0);
  EXPECT_EQ(h.quantile(1.0), 10);
  EXPECT_EQ(h.at_least(1), 4u);
  EXPECT_EQ(h.at_least(1.5), 2u);
  const Histogram merged = h.merged(4);
  EXPECT_EQ(merged.count, (std::vector<std::uint64_t>{3, 4, 0, 1}));
  EXPECT_EQ(merged.first, -3.5) << "the centre of -5 to -2";
}

TEST(Histogram, NegativeSlopeTurnsItAround) {
  GridField g = grid_of<std::uint8_t>({0, 0, 0, 0, 0, 0, 1, 3}, VoxelType::u8);
  g.slope = -2;
  g.intercept = 1;
  finish_grid(g, "error", 0);
  const Histogram h = histogram_of(g);
  EXPECT_EQ(h.first, -5);
  EXPECT_EQ(h.step, 2);
  EXPECT_EQ(h.count, (std::vector<std::uint64_t>{1, 0, 1, 6}));
  EXPECT_EQ(h.last(), 1);
}

TEST(Histogram, FloatsAreCountedOnce) {
  GridField g = grid_of<float>({0, 0.25f, 0.5f, 0.5f, 0.5f, 0.75f, 1, 1}, VoxelType::f32);
  finish_grid(g, "error", 0);
  const Histogram h = histogram_of(g);
  EXPECT_FALSE(h.exact);
  EXPECT_NEAR(h.quantile(0.5), 0.5, 1.0 / 65535);
  EXPECT_EQ(h.quantile(1), 1);
  EXPECT_EQ(h.at_least(0.9), 2u);
}

TEST_F(Info, Engine) {
  const nlohmann::json j = json_of("dvrlab info data/engine.nrrd --json");
  EXPECT_EQ(j["reader"], "nrrd");
  EXPECT_EQ(j["dims"], (std::vector<int>{256, 256, 128}));
  EXPECT_EQ(j["stored_type"], "uint8");
  EXPECT_EQ(j["value_range"], (std::vector<double>{0, 255}));
  EXPECT_EQ(j["bytes"], 8388608);
  std::uint64_t sum = 0;
  for (const nlohmann::json& n : j["histogram"]["count"]) sum += n.get<std::uint64_t>();
  EXPECT_EQ(sum, 8388608u);
  expect_words(j["sha256"], {run("sha256sum < data/engine.nrrd | cut -d' ' -f1 | tr -d '\\n'").out});
  expect_words(run("dvrlab info data/engine.nrrd").out, {"256 x 256 x 128 grid points", "share of voxels", "####"});
}

// The plot of data is its histogram; that of a config has its transfer functions too. Equal input, equal bytes.
TEST_F(Info, PlotsShowHistogramAndTransferFunctions) {
  const auto drawn = [&](const std::string& arguments, const std::string& file) {
    EXPECT_EQ(run("dvrlab info " + arguments + " --plot " + file).code, 0);
    return run("cat " + file).out;
  };
  const std::string alone = drawn("data/fuel.nrrd", "alone.svg");
  expect_words(alone, {"<svg", "</svg>"});
  EXPECT_EQ(alone, drawn("data/fuel.nrrd", "again.svg"));
  const std::string example = "plugins/optical_model/hybrid/hybrid.example.json";
  const std::string config = drawn(example, "config.svg");
  EXPECT_EQ(config, drawn(example, "config_again.svg"));
  EXPECT_NE(config, drawn(example + " --set optical_model.scattering.color='[[0,1,0,0]]'", "red.svg"));
  EXPECT_NE(config, drawn(example + " --set estimator.approximate_dirac=0.1 --set "
                                    "optical_model.surface.delta='[{\"value\":0.5,\"opacity\":0.4}]'",
                          "spike.svg"));
  EXPECT_EQ(config, drawn(example + " --set optical_model.dl_std=7", "same_bars.svg")) << "no bar depends on dl_std";
  const std::string png = drawn(example, "config.png");
  EXPECT_EQ(png.substr(1, 3), "PNG");
  // one bar per pair: a model without transfer functions of its own leaves the histogram
  const auto height = [&](const std::string& svg) {
    const std::size_t at = svg.find("height=\"") + 8;
    return std::stod(svg.substr(at));
  };
  EXPECT_GT(height(config), height(alone) + 3 * 40);
}

TEST_F(Info, PlotsThatCannotBeDrawn) {
  expect_one_error(run("dvrlab info data/fuel.nrrd --plot x.jpg"), 2, {"--plot x.jpg", ".svg or .png"});
  expect_one_error(run("dvrlab info data/fuel.nrrd --plot nodir/x.svg"), 2, {"nodir/x.svg", "there is no folder"});
}

TEST_F(Info, AxesInWords) {
  write("lps.nrrd", small_nrrd("space: left-posterior-superior\n"
                               "space directions: (2,0,0) (0,0,3) (0,-1,0)\nspace origin: (10,20,30)\n"));
  const nlohmann::json j = json_of("dvrlab info lps.nrrd --json");
  EXPECT_EQ(j["anatomical"], true);
  EXPECT_EQ(j["orientation"], "LSA");
  EXPECT_EQ(j["axes"][0]["words"], "x index runs from right to left");
  EXPECT_EQ(j["axes"][1]["words"], "y index runs from bottom to top");
  EXPECT_EQ(j["axes"][2]["words"], "z index runs from back to front");
  EXPECT_EQ(j["axes"][1]["spacing"], 3);
  EXPECT_EQ(j["box"], (std::vector<double>{6, 6, 1}));
  // 3-4-5: the first axis lies 36.87 degrees off; without a space there is no patient.
  write("oblique.nrrd", small_nrrd("space dimension: 3\nspace directions: (4,3,0) (-3,4,0) (0,0,-2)\n"));
  const std::string text = run("dvrlab info oblique.nrrd").out;
  expect_words(text, {"x index runs along +x, 36.9 degrees off", "y index runs along +y, 36.9 degrees off",
                      "z index runs along -z\n", "no anatomy is known", "5 x 5 x 2"});
}

TEST_F(Info, ScalingAndConfigs) {
  const nlohmann::json j = json_of("dvrlab info data/sphere_int16.nii.gz --json");
  const double slope = j["slope"], intercept = j["intercept"];
  EXPECT_TRUE(slope != 1 || intercept != 0) << "the file is there to show scaling";
  expect_words(run("dvrlab info data/sphere_int16.nii.gz").out, {"value = ", "* stored + "});
  const nlohmann::json config = json_of("dvrlab info configs/first_experiment.json --json");
  EXPECT_EQ(config["dims"], (std::vector<int>{256, 256, 128}));
  const nlohmann::json formula = json_of("dvrlab info plugins/sampler/formula/formula.example.json --json");
  EXPECT_EQ(formula["sampler"], "formula");
  EXPECT_FALSE(formula.contains("histogram"));
}

// Nobody wrote a config, so nothing has a line in one.
TEST_F(Info, AFolderWithSeveralSeries) {
  if (run("dvrlab list data | grep -q dicom").code != 0) GTEST_SKIP() << "not supported: the dicom plugin is not built";
  const Outcome o = run("dvrlab info data/dicom_torus");
  expect_one_error(o, 2, {"error: data.series: ", "holds several series", "--set data.series=UID", "2.25.1"});
  EXPECT_EQ(run("dvrlab info data/dicom_torus --set data.series=2.25.1").code, 0);
  expect_one_error(run("dvrlab info data/dicom_torus --set data.seris=2.25.1"), 2, {"--set: data.seris", "'series'"});
}

// Text that could be anything: the reader is named by hand, for every verb that takes data.
TEST_F(Info, TheReaderMayBeNamed) {
  expect_one_error(run("dvrlab info data/samples.csv"), 2, {"no reader recognises it", "--set data.type=TYPE"});
  if (run("dvrlab describe data.points").code != 0) GTEST_SKIP() << "not supported: the points plugin is not built";
  const nlohmann::json j = json_of("dvrlab info data/samples.csv --set data.type=points --set data.column=4 --json");
  EXPECT_EQ(j["reader"], "points");
  const Outcome drawn =
      run("dvrlab render data/samples.csv --set data.type=points --set 'image.size=[8,8]' -o samples.png");
  EXPECT_EQ(drawn.code, 0) << drawn.err;
  expect_one_error(run("dvrlab info data/samples.csv --set data.type=poinst"), 2, {"data.type", "'points'"});
  expect_one_error(run("dvrlab run data/samples.csv --set data.type=points"), 2, {"is data", "--starter"});
}

TEST_F(Info, WhatCannotBeRead) {
  write("empty.vti", "");
  expect_one_error(run("dvrlab info empty.vti"), 2, {"empty.vti: is empty"});
  expect_one_error(run("mkfifo pipe; timeout 10 dvrlab info pipe"), 2, {"pipe: is no regular file"});
  expect_one_error(run("timeout 10 dvrlab info /dev/zero"), 2, {"/dev/zero: is no regular file"});
  write("notes.txt", "dear diary");
  expect_one_error(run("dvrlab info notes.txt"), 2, {"notes.txt: no reader recognises it", "nifti", "nrrd"});
  expect_one_error(run("dvrlab info nowhere.nrrd"), 2, {"there is no file or folder 'nowhere.nrrd'"});
  expect_one_error(run("dvrlab render notes.txt -o a.png"), 2, {"no reader recognises it"});
  const std::string whole = small_nrrd("");
  write("cut.nrrd", whole.substr(0, whole.size() - 5));
  expect_one_error(run("dvrlab info cut.nrrd"), 2, {"cut.nrrd", "cut off"});
  write("empty.json", "{}");
  expect_one_error(run("dvrlab info empty.json"), 2, {"empty.json: has no data section"});
  expect_one_error(run("dvrlab run data/fuel.nrrd"), 2, {"is data", "--starter"});
}

}  // namespace
}  // namespace dvrlab::app_test
