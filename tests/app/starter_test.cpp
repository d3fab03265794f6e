// A stranger's path: own file to own image.
#include <algorithm>

#include "framework/image/image_io.h"
#include "tests/app/program.h"
#include "tests/support/render.h"

namespace dvrlab::app_test {
namespace {

class Starter : public Program {
 protected:
  /// The picture lies inside the image with a margin, fills it in one direction, and is neither black nor opaque.
  void expect_good_picture(const std::string& data, const std::vector<std::string>& words = {"background"}) const {
    const Outcome o = run("dvrlab render " + data + " --set image.size=[96,96] -o picture.exr");
    ASSERT_EQ(o.code, 0) << o.err;
    expect_words(o.err, {"is data, so a starter config is made from it", "dense", "--starter my.json"});
    expect_words(o.err, words);
    const FrameImage image = read_exr(path("picture.exr"));
    int lo[2] = {96, 96}, hi[2] = {-1, -1}, seen = 0, translucent = 0;
    for (int y = 0; y < 96; ++y) {
      for (int x = 0; x < 96; ++x) {
        const float t = image.trans[std::size_t(y * 96 + x) * 3];
        if (t > 0.9f) continue;
        ++seen;
        translucent += t > 0.05f;
        for (int a = 0; a < 2; ++a) {
          lo[a] = std::min(lo[a], a == 0 ? x : y);
          hi[a] = std::max(hi[a], a == 0 ? x : y);
        }
      }
    }
    EXPECT_GT(seen, 96 * 96 / 40) << data;
    EXPECT_GT(translucent, seen / 50) << data;
    EXPECT_TRUE(lo[0] > 0 && lo[1] > 0 && hi[0] < 95 && hi[1] < 95) << data << ": it touches the border";
    EXPECT_GT(std::max(hi[0] - lo[0], hi[1] - lo[1]), 48) << data << ": it fills less than half of the image";
  }
};

TEST_F(Starter, ShippedDataMakeGoodPictures) {
  for (const char* file : {"engine.nrrd", "fuel.nrrd", "hydrogen.nrrd", "hydrogenatom.nrrd"})
    expect_good_picture(std::string("data/") + file);
}

TEST_F(Starter, MeshesMakeGoodPictures) {
  for (const char* file : {"bluntfin_tets.vtu", "CylinderQuadratic.vtk --set data.array=pressure",
                           "notch_disp.vtu --set data.component=norm"})
    expect_good_picture(std::string("data/") + file, {"thin", "blue"});
  // Of several arrays one has to be chosen, and the written config keeps the choice.
  expect_one_error(run("dvrlab render data/disk_out_ref.vtu -o a.png"), 2, {"data.array", "Temp"});
  expect_good_picture("data/disk_out_ref.vtu --set data.array=Temp", {"thin", "red"});
  ASSERT_EQ(run("dvrlab info data/disk_out_ref.vtu --set data.array=Temp --starter disk.json").code, 0);
  expect_words(read("disk.json"), {"\"array\": \"Temp\""});
  EXPECT_EQ(run("dvrlab render disk.json --set image.size=[96,96] -o b.exr").code, 0);
  EXPECT_EQ(run("dvrlab compare picture.exr b.exr").code, 0);
}

TEST_F(Starter, SharedDataMakeGoodPictures) {
  if (test::shared_data("volumes/tooth.nhdr").empty())
    GTEST_SKIP() << "not supported: no data: volumes of DVRLAB_SHARED_DATA";
  for (const char* file : {"bonsai.nrrd", "cranium_ct.nrrd", "tooth.nhdr", "flair_rotated.nrrd"})
    expect_good_picture(test::shared_data(std::string("volumes/") + file));
}

TEST_F(Starter, TheWrittenConfigRendersTheSameImage) {
  ASSERT_EQ(run("mkdir sub; cp data/fuel.nrrd own.nrrd; dvrlab info own.nrrd --starter sub/my.json").code, 0);
  expect_words(read("sub/my.json"), {"// A first picture of own.nrrd", "\"../own.nrrd\"", "\"opacity\": [["});
  EXPECT_EQ(run("dvrlab validate sub/my.json").code, 0);
  EXPECT_EQ(run("dvrlab render sub/my.json -o a.exr").code, 0);
  EXPECT_EQ(run("dvrlab render data/fuel.nrrd -o b.exr").code, 0);
  EXPECT_EQ(run("dvrlab compare a.exr b.exr").code, 0);
  EXPECT_EQ(run("dvrlab render data/fuel.nrrd --set optical_model.dl_std=1 -o c.exr").code, 0);
  EXPECT_EQ(run("dvrlab compare a.exr c.exr").code, 1) << "--set must reach the starter config";
}

// What was loaded for the starter config is rendered, unless --set leads to other data.
TEST_F(Starter, SetOfTheDataReachesTheImage) {
  const auto source = [&](const std::string& set) -> std::string {
    const nlohmann::json j = json_of("dvrlab render data/fuel.nrrd --json --set image.size=[8,8] -o a.exr " + set);
    return j["scene"]["source"];
  };
  EXPECT_TRUE(source("").ends_with("data/fuel.nrrd"));
  const std::string other = R"({"type":"nrrd","file":"data/hydrogen.nrrd"})";
  EXPECT_TRUE(source("--set data.file=data/hydrogen.nrrd").ends_with("data/hydrogen.nrrd"));
  EXPECT_TRUE(source("--set 'data=" + other + "'").ends_with("data/hydrogen.nrrd"));
  EXPECT_TRUE(source("--set 'axes.permutation.data=[" + other + "]'").ends_with("data/hydrogen.nrrd"));
}

TEST_F(Starter, NothingIsOverwrittenUnasked) {
  write("mine.json", "my own work");
  expect_one_error(run("dvrlab info data/fuel.nrrd --starter mine.json"), 2, {"mine.json", "exists", "--force"});
  EXPECT_EQ(read("mine.json"), "my own work");
  EXPECT_EQ(run("dvrlab info data/fuel.nrrd --starter mine.json --force").code, 0);
  EXPECT_EQ(run("dvrlab validate mine.json").code, 0);
  expect_one_error(run("dvrlab info data/fuel.nrrd --force"), 2, {"--force belongs to --starter"});
  expect_one_error(run("dvrlab info configs/first_experiment.json --starter a.json"), 2, {"is a config already"});
}

TEST_F(Starter, PatientsAreSeenFromTheirLeftFront) {
  // The same voxels twice: as a patient's and as nobody's. Left is -x, the front +y.
  write("patient.nrrd", small_nrrd("space: RAS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\n"));
  write("nobody.nrrd", small_nrrd("spacings: 1 1 1\n"));
  const auto position = [&](const std::string& file) {
    run("dvrlab info " + file + " --starter s.json --force");
    return nlohmann::json::parse(read("s.json"), nullptr, true, true)["camera"]["position"].get<std::vector<double>>();
  };
  const auto patient = position("patient.nrrd"), nobody = position("nobody.nrrd");
  EXPECT_TRUE(patient[0] < 0 && patient[1] > 0 && patient[2] > 0) << testing::PrintToString(patient);
  EXPECT_TRUE(nobody[0] < 0 && nobody[1] < 0 && nobody[2] > 0) << testing::PrintToString(nobody);
}

TEST_F(Starter, DataWithoutAPicture) {
  std::string constant = small_nrrd("");
  std::fill(constant.end() - 24, constant.end(), char(7));
  write("constant.nrrd", constant);
  expect_one_error(run("dvrlab render constant.nrrd -o a.png"), 2, {"every voxel has the value 7"});
  EXPECT_EQ(run("dvrlab info constant.nrrd").code, 0) << "but there is something to say of it";
}

}  // namespace
}  // namespace dvrlab::app_test
