// A kernel that cannot be used is the verdict of its own cases, with the kernel's own file and line where it has one.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "framework/interfaces/kernel_module.h"
#include "framework/pipeline.h"
#include "framework/report/judge.h"
#include "tests/front/front_test.h"

namespace dvrlab::front {
namespace {

namespace fs = std::filesystem;

/// Right in both languages, but that `word` of line 3 is unknown.
std::string estimator_text(const std::string& word) {
  return "// Line 1 of the kernel.\n"
         "KFN void segment_kernel(segment q, OUT(vec3r) c, OUT(spectral) t) {\n"
         "  c = v3(R(0.0), " +
         word +
         ", R(0.0));\n"
         "  t = spectral_of(v3(R(1.0), R(1.0), R(1.0)));\n"
         "}\n";
}
std::string sampler_text(const std::string& word) {
  return "KFN real sample_value(vec3r p) { return p.x; }\n"
         "\n"
         "\n"
         "KFN vec3r sample_gradient(vec3r p) { return v3(R(1.0), " +
         word + ", R(0.0)); }\n";
}

class KernelErrors : public testing::Test {
 protected:
  /// The broken plugins with these kernel texts, as a plugin root.
  void SetUp() override {
    std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(test.begin(), test.end(), '/', '_');
    root_ = testing::TempDir() + "/kernel_errors_" + test;
    fs::remove_all(root_);
    fs::copy(std::string(DVRLAB_BROKEN_PLUGINS) + "/kernels", root_, fs::copy_options::recursive);
    write("estimator/crooked/crooked.kernel", estimator_text("crookedness"));
    write("sampler/bent/bent.kernel", sampler_text("bending"));
  }
  void TearDown() override { fs::remove_all(root_); }
  void write(const std::string& file, const std::string& text) { std::ofstream(root_ + "/" + file) << text; }

  /// Every case of a run whose axes are `axes`.
  RunSummary run(const std::string& axes) {
    write("config.json", small_config(R"(, "axes": )" + axes));
    return run_experiment({root_ + "/config.json", {}, {root_}, root_ + "/out"});
  }
  std::string root_;
};

/// The cases of the sound plugin pass; those of the broken one are errors with these words. "" or a reason to skip.
std::string judge(const RunSummary& summary, const std::string& key, const std::string& broken,
                  const std::vector<std::string>& words) {
  int sound = 0, errors = 0;
  for (const CaseRecord& r : summary.records) {
    if (r.verdict == Verdict::not_supported) return r.reason;
    bool is_broken = false;
    for (const AxisChoice& c : r.plan->choices) is_broken = is_broken || (c.key == key && c.label == broken);
    EXPECT_EQ(r.verdict, is_broken ? Verdict::error : Verdict::pass) << r.plan->id << ": " << r.reason;
    if (is_broken) {
      expect_words(r.reason, words);
      EXPECT_EQ(r.reason.find('\n'), std::string::npos) << "one line: " << r.reason;
    }
    ++(is_broken ? errors : sound);
  }
  EXPECT_GT(errors, 0);
  EXPECT_GT(sound, 0) << "the control: the other plugin renders in the same run";
  return "";
}

class OnGpu : public KernelErrors, public testing::WithParamInterface<const char*> {
 protected:
  std::string axes(const std::string& key, const std::string& values) const {
    return R"({"permutation": {")" + key + R"(": )" + values + R"(}, "variant": {"backend": [{"type": ")" + GetParam() +
           R"("}]}})";
  }
};

TEST_P(OnGpu, EstimatorThatDoesNotCompile) {
  const std::string skip =
      judge(run(axes("estimator", R"([{"type": "crooked"}, {"type": "direct"}])")), "estimator", "crooked",
            {"do not compile", "estimator/crooked/crooked.kernel:3: error", "crookedness"});
  if (!skip.empty()) GTEST_SKIP() << "not supported: " << skip;
}

TEST_P(OnGpu, SamplerThatDoesNotCompile) {
  const std::string skip = judge(run(axes("sampler.type", R"(["bent", "grid"])")), "sampler.type", "bent",
                                 {"do not compile", "sampler/bent/bent.kernel:4: error", "bending"});
  if (!skip.empty()) GTEST_SKIP() << "not supported: " << skip;
}

TEST_P(OnGpu, TheSameTextsWithoutTheUnknownWordCompile) {
  write("estimator/crooked/crooked.kernel", estimator_text("R(0.5)"));
  write("sampler/bent/bent.kernel", sampler_text("R(0.5)"));
  const RunSummary s = run(R"({"permutation": {"estimator": [{"type": "crooked"}], "sampler.type": ["bent"]},
                               "variant": {"backend": [{"type": ")" +
                           std::string(GetParam()) + R"("}]}})");
  ASSERT_EQ(s.records.size(), 1u);
  if (s.records[0].verdict == Verdict::not_supported) GTEST_SKIP() << "not supported: " << s.records[0].reason;
  EXPECT_EQ(s.records[0].verdict, Verdict::pass) << s.records[0].reason;
}

INSTANTIATE_TEST_SUITE_P(Backends, OnGpu, testing::Values("vulkan", "opengl"),
                         [](const auto& instance) { return std::string(instance.param); });

TEST_F(KernelErrors, ModuleOfAnotherAbiOnTheCpu) {
  const std::string number = std::to_string(DVR_KERNEL_ABI + 1000);
  judge(run(R"({"permutation": {"estimator": [{"type": "crooked"}, {"type": "direct"}]},
                "variant": {"backend.isa": ["scalar"]}})"),
        "estimator", "crooked", {"crooked.scalar.so", "kernel ABI " + number, std::to_string(DVR_KERNEL_ABI), "again"});
  judge(run(R"({"permutation": {"sampler.type": ["bent", "grid"]}, "variant": {"backend.isa": ["scalar"]}})"),
        "sampler.type", "bent", {"bent.scalar.so", "kernel ABI " + number, "again"});
}

TEST_F(KernelErrors, ModuleThatIsMissingOnTheCpu) {
  fs::remove(root_ + "/estimator/crooked/crooked.scalar.so");
  judge(run(R"({"permutation": {"estimator": [{"type": "crooked"}, {"type": "direct"}]},
                "variant": {"backend.isa": ["scalar"]}})"),
        "estimator", "crooked", {"crooked.scalar.so", "is missing", "scalar"});
}

TEST_F(KernelErrors, ModuleThatIsNotLoadableOnTheCpu) {
  fs::remove(root_ + "/estimator/crooked/crooked.scalar.so");
  write("estimator/crooked/crooked.scalar.so", "this is no library");
  judge(run(R"({"permutation": {"estimator": [{"type": "crooked"}, {"type": "direct"}]},
                "variant": {"backend.isa": ["scalar"]}})"),
        "estimator", "crooked", {"crooked.scalar.so", "file too short"});
}

TEST_F(KernelErrors, PluginThatCannotBeMadeIsTheVerdictOfItsCases) {
  write("config.json",
        small_config(R"(, "axes": {"permutation": {"estimator": [{"type": "grumpy"}, {"type": "direct"}]}})"));
  const RunSummary s =
      run_experiment({root_ + "/config.json", {}, {std::string(DVRLAB_BROKEN_PLUGINS) + "/throws"}, root_ + "/out"});
  ASSERT_EQ(s.records.size(), 2u);
  EXPECT_EQ(s.records[0].verdict, Verdict::not_supported);
  expect_words(s.records[0].reason, {"grumpy", "not in the mood"});
  EXPECT_EQ(s.records[1].verdict, Verdict::pass) << s.records[1].reason;
}

}  // namespace
}  // namespace dvrlab::front
