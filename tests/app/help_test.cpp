// Help, names that are nearly right, and the examples of the help, all of which must work.
#include <fstream>

#include "tests/app/program.h"

namespace dvrlab::app_test {
namespace {

using Help = Program;

TEST_F(Help, EveryVerbHasDescriptionExamplesAndExitCodes) {
  const nlohmann::json model = json_of("dvrlab help --json");
  ASSERT_GE(model["verbs"].size(), 12u);
  const std::string overview = run("dvrlab --help").out;
  for (const nlohmann::json& verb : model["verbs"]) {
    const std::string name = verb["name"];
    const Outcome help = run("dvrlab " + name + " --help");
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.out, run("dvrlab help " + name).out);
    expect_words(help.out, {"usage: dvrlab " + name, "Examples:", "Exit codes:", "something could not run"});
    expect_words(overview, {name, verb["summary"]});
    EXPECT_GE(verb["examples"].size(), 1u) << name;
    for (const nlohmann::json& option : verb["options"])
      for (const nlohmann::json& option_name : option["names"]) expect_words(help.out, {option_name});
  }
}

TEST_F(Help, EveryExampleWorks) {
  // In the order of the help: an example may use what an earlier one has written.
  const nlohmann::json model = json_of("dvrlab help --json");
  int count = 0;
  for (const nlohmann::json& verb : model["verbs"]) {
    for (const nlohmann::json& example : verb["examples"]) {
      const Outcome o = run(example["command"]);
      EXPECT_EQ(o.code, 0) << example["command"] << "\n" << o.err;
      EXPECT_EQ(o.err.find('\033'), std::string::npos) << "colour codes where stderr is no terminal";
      ++count;
    }
  }
  EXPECT_GE(count, 25);
  EXPECT_EQ(run("dvrlab render my.json --set camera.position=0 -o image.png").code, 2) << "an example that is wrong";
}

TEST_F(Help, EveryCommandOfTheTutorialWorks) {
  std::ifstream page(DVRLAB_SOURCE "/docs/first-experiment.md");
  const std::string start = "    dvrlab ", fails = "# exit code 1";
  int count = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with(start)) continue;
    const Outcome o = run(line);
    EXPECT_EQ(o.code, line.ends_with(fails) ? 1 : 0) << line << "\n" << o.err;
    ++count;
  }
  EXPECT_GE(count, 10);
}

TEST_F(Help, WithoutAVerb) {
  const Outcome o = run("dvrlab");
  EXPECT_EQ(o.code, 2);
  expect_words(o.err, {"usage: dvrlab VERB", "error: a verb is missing"});
}

TEST_F(Help, Version) {
  const Outcome o = run("dvrlab --version");
  EXPECT_EQ(o.code, 0);
  expect_words(o.out, {"dvrlab 0.", "plugin ABI dvrlab-", "compiler "});
}

TEST_F(Help, WrongNamesNameTheNearest) {
  expect_one_error(run("dvrlab rendr"), 2, {"unknown verb 'rendr'", "did you mean 'render'?", "doctor"});
  expect_one_error(run("dvrlab help rendr"), 2, {"did you mean 'render'?"});
  expect_one_error(run("dvrlab render a.json --ouput b.png"), 2,
                   {"dvrlab render: unknown option '--ouput'", "did you mean '--output'?", "--set"});
  expect_one_error(run("dvrlab --jsn list"), 2, {"unknown option '--jsn'", "did you mean '--json'?"});
  expect_one_error(run("dvrlab render --plugin-path x --seet=1 a.json"), 2, {"'--seet'", "'--set'"});
}

TEST_F(Help, WrongValuesSayHowItGoes) {
  expect_one_error(run("dvrlab render a.json"), 2, {"--output is required", "usage: dvrlab render [OPTIONS] FILE"});
  expect_one_error(run("dvrlab probe a.json --pixel 1"), 2, {"--pixel", "X,Y"});
  expect_one_error(run("dvrlab completion csh"), 2, {"csh", "bash,zsh,fish"});
  expect_one_error(run("dvrlab list estimator more"), 2, {"more", "usage: dvrlab list"});
  expect_one_error(run("dvrlab man --json"), 2, {"has no --json"});
}

TEST_F(Help, JsonOfEveryVerbThatHasOneIsJson) {
  for (const char* line :
       {"dvrlab describe axes --json", "dvrlab list --json", "dvrlab describe image --json", "dvrlab doctor --json",
        "dvrlab info data/fuel.nrrd --json", "dvrlab validate configs/first_experiment.json --json"})
    json_of(line);
}

TEST_F(Help, EverySectionIsDescribed) {
  for (const std::string section :
       {"data", "optical_model", "estimator", "lights", "illumination", "camera", "clip", "sampling", "image", "limits",
        "backend", "metrics", "axes", "reference", "expect", "include", "case"}) {
    const Outcome o = run("dvrlab describe " + section);
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_EQ(o.out.find(section + "\n"), 0u) << o.out;
    EXPECT_EQ(run("dvrlab completion types | grep -qx " + section).code, 0) << section;
  }
  expect_words(run("dvrlab describe camera").out, {"camera.orbit", "camera.perspective", "A pinhole camera."});
  expect_words(run("dvrlab describe data").out, {"data.nrrd", "shared by every type", "nan_policy"});
  expect_words(run("dvrlab describe metrics").out, {"metric.psnr"});
  expect_words(run("dvrlab describe axes").out, {"permutation", "variant", "{\"lin\": ...}", "[first, last, count]"});
  expect_words(run("dvrlab describe expect").out, {"at_least", "where"});
  EXPECT_EQ(json_of("dvrlab describe sampling --json")[0]["parts"][0]["name"], "sampling.uniform");
}

}  // namespace
}  // namespace dvrlab::app_test
