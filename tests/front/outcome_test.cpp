// What a batch can rely on: exit codes when something is missing, and results that can be moved.
#include "framework/image/image_io.h"
#include "framework/metric/measure.h"
#include "tests/front/run_test.h"

namespace dvrlab::front {
namespace {

class Outcome : public Run {};

// A limit of memory stands for any reason why a case cannot run on this machine.
TEST_F(Outcome, VariantsOfWhichOnlyOneRanHaveNotBeenCompared) {
  const std::string two = R"(, "axes": {"variant": {"limits.memory": [null, 1]}})";
  const RunSummary in_vain = run(small_config(two));
  EXPECT_EQ(in_vain.records.at(1).verdict, Verdict::not_supported);
  EXPECT_EQ(exit_code(in_vain), 3);
  expect_words(summary_text(in_vain), {"variants: none could be compared"});

  const RunSummary some = run(small_config(R"(, "axes": {"variant": {"limits.memory": [null, 1, 1e10]}})"));
  EXPECT_EQ(some.records.at(1).verdict, Verdict::not_supported);
  EXPECT_EQ(exit_code(some), 0) << "two were compared, the third is counted";
  expect_words(summary_text(some), {"variants: 1 compared", "1 not supported"});
}

TEST_F(Outcome, ReferenceThatIsMissing) {
  const std::string lost = R"(, "metrics": ["rmse"], "reference": {"truth": {"limits.memory": 1}})";
  const RunSummary in_vain = run(small_config(lost));
  EXPECT_EQ(exit_code(in_vain), 3);
  expect_words(summary_text(in_vain), {"references: nothing could be measured"});
  EXPECT_EQ(exit_code(run(small_config(R"(, "metrics": ["rmse"], "reference": {"truth": {"sampling.step": 0.5}})"))),
            0);
  EXPECT_EQ(exit_code(run(small_config(R"(, "reference": {"truth": {"limits.memory": 1}})"))), 0)
      << "without metrics nothing was to be measured";
}

TEST_F(Outcome, ExpectationAgainstVariantMeansTheOthers) {
  const std::string expect =
      R"(, "metrics": ["max_abs"], "expect": [{"metric": "max_abs", "against": "variant", "at_most": )";
  const std::string two = R"(, "axes": {"variant": {"backend.threads": [1, 2]}})";
  EXPECT_EQ(exit_code(run(small_config(two + expect + "0}]"))), 0);
  EXPECT_EQ(exit_code(run(small_config(two + expect + "-1}]"))), 1);
  expect_error(small_config(expect + "0}]"), {"expect[0]", "there is no reference 'variant'"});
}

TEST_F(Outcome, ARefusedRerunLeavesNoOldImages) {
  const std::string images = run(small_config()).folder + "/cases/case/image";
  EXPECT_TRUE(fs::exists(images + ".exr") && fs::exists(images + ".png"));
  const RunSummary refused = run(small_config(), {"limits.memory=1000"});
  EXPECT_EQ(refused.records.at(0).verdict, Verdict::not_supported);
  EXPECT_FALSE(fs::exists(images + ".exr") || fs::exists(images + ".png")) << "they are of another case.json";
}

// The folder with config, data and results is moved; a case still runs, on the data of the new place.
TEST_F(Outcome, ResultsMoveWithTheirFolder) {
  const std::string old = folder_ + "/project", moved = folder_ + "/elsewhere/project";
  fs::create_directories(old + "/configs");
  fs::create_directories(old + "/data");
  fs::copy_file(std::string(DVRLAB_CONFIGS) + "/../data/fuel.nrrd", old + "/data/fuel.nrrd");
  std::string config = small_config();
  const std::size_t begin = config.find("\"data\""), end = config.find('\n', begin);
  config.replace(begin, end - begin, R"("data": {"type": "nrrd", "file": "../data/fuel.nrrd"},)");
  std::ofstream(old + "/configs/a.json") << config;
  const RunSummary first = run_experiment({old + "/configs/a.json", {}, {}, old + "/out"});
  const FrameImage a = read_exr(first.folder + "/cases/case/image.exr");
  const auto record = nlohmann::json::parse(text_of(first.folder + "/cases/case/case.json"));
  EXPECT_EQ(record["config"]["base_folder"], "../../../../configs");

  fs::create_directories(folder_ + "/elsewhere");
  fs::rename(old, moved);
  const RunSummary again = run_experiment({moved + "/out/small/cases/case/case.json", {}, {}, moved + "/again"});
  EXPECT_EQ(exit_code(again), 0);
  EXPECT_EQ(compare_bits(a, read_exr(again.folder + "/cases/case/image.exr")).different, 0u);

  // Only the results are moved: one error, and where the config was is the fix.
  fs::create_directories(folder_ + "/alone/deep/inside");
  fs::rename(moved + "/out", folder_ + "/alone/deep/inside/out");
  const std::string alone = folder_ + "/alone/deep/inside/out/small/cases/case/case.json";
  EXPECT_THROW(run_experiment({alone, {}, {}, folder_ + "/third"}), InputError);
  EXPECT_EQ(exit_code(run_experiment({alone, {"base_folder=" + moved + "/configs"}, {}, folder_ + "/third"})), 0);
}

}  // namespace
}  // namespace dvrlab::front
