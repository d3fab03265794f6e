// "${NAME}" wherever a config names a file or a folder.
#include "framework/config/environment.h"

#include "tests/front/run_test.h"

namespace dvrlab::front {
namespace {

class Environment : public Run {
 protected:
  void SetUp() override {
    Run::SetUp();
    setenv("DVRLAB_TEST_HERE", folder_.c_str(), 1);
    setenv("DVRLAB_TEST_LITERAL", "${DVRLAB_TEST_HERE}", 1);
    unsetenv("DVRLAB_TEST_NOWHERE");
  }
  void TearDown() override {
    unsetenv("DVRLAB_TEST_HERE");
    unsetenv("DVRLAB_TEST_LITERAL");
  }
};

TEST_F(Environment, Expands) {
  EXPECT_EQ(expand_environment("a/b", "x"), "a/b");
  EXPECT_EQ(expand_environment("${DVRLAB_TEST_HERE}/a-${DVRLAB_TEST_HERE}", "x"), folder_ + "/a-" + folder_);
  EXPECT_EQ(expand_environment("$HOME {x}", "x"), "$HOME {x}") << "only ${NAME} means a variable";
  EXPECT_EQ(expand_environment("${DVRLAB_TEST_LITERAL}", "x"), "${DVRLAB_TEST_HERE}") << "a value is taken as it is";
}

TEST_F(Environment, InIncludeAndBaseFolder) {
  fs::create_directories(folder_ + "/parts");
  std::ofstream(folder_ + "/parts/step.json") << R"({"sampling": {"step": 0.125}})";
  const Experiment e = plan(
      small_config(R"(, "include": ["${DVRLAB_TEST_HERE}/parts/step.json"], "base_folder": "${DVRLAB_TEST_HERE}")"));
  EXPECT_EQ(e.cases.at(0).resolved.sampling.parameters.number("step"), 0.125);
  EXPECT_EQ(e.cases[0].resolved.base_folder, fs::weakly_canonical(folder_).string());
}

TEST_F(Environment, UnsetVariableIsOneErrorWithItsPlace) {
  const std::vector<std::string> unset = {"environment variable DVRLAB_TEST_NOWHERE", "is not set"};
  const auto with = [&](const std::string& more) {
    std::vector<std::string> lines = errors_of(small_config(more));
    EXPECT_EQ(lines.size(), 1u) << testing::PrintToString(lines);
    if (!lines.empty()) expect_words(lines[0], unset);
    return lines.empty() ? "" : lines[0];
  };
  expect_words(with(R"(, "include": ["${DVRLAB_TEST_NOWHERE}/a.json"])"), {"test.json:9:15: include[0]: "});
  expect_words(with(R"(, "include": "${DVRLAB_TEST_NOWHERE}/a.json")"), {"test.json:9:3: include: "});
  expect_words(with(R"(, "base_folder": "${DVRLAB_TEST_NOWHERE}")"), {"test.json:9:3: base_folder: "});
  expect_words(
      with(R"(, "axes": {"permutation": {"data": [{"type": "nrrd", "file": "${DVRLAB_TEST_NOWHERE}/a.nrrd"}]}})"),
      {"test.json:9:", "axes.permutation.data[0].file: "});
}

TEST_F(Environment, MalformedVariable) {
  expect_error(small_config(R"(, "include": "${DVRLAB_TEST_HERE/a.json")"), {"test.json:9:3: include", "${NAME}"});
  expect_error(small_config(R"(, "include": "${}/a.json")"), {"test.json:9:3: include", "${NAME}"});
}

// Optional data whose folder is not configured on this machine is missing data.
TEST_F(Environment, UnsetInOptionalDataIsNotSupported) {
  const RunSummary s = run(small_config(R"(, "axes": {"permutation": {"data": [
    {"type": "procedural", "size": [8, 8, 8]},
    {"type": "nrrd", "file": "${DVRLAB_TEST_NOWHERE}/a.nrrd", "optional": true}]}})"));
  ASSERT_EQ(s.records.size(), 2u);
  EXPECT_EQ(s.records[1].verdict, Verdict::not_supported);
  expect_words(s.records[1].reason, {"DVRLAB_TEST_NOWHERE", "not set"});
}

}  // namespace
}  // namespace dvrlab::front
