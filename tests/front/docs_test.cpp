// docs/config.md keeps its word: every example is planned, the wrong ones fail with the lines that are shown.
#include <regex>

#include "tests/front/run_test.h"

namespace dvrlab::front {
namespace {

struct Example {
  std::string name, text;          // "zip.json", the block itself
  int cases = -1, references = 0;  // -1: a fragment or a wrong one
  std::string errors;              // the block of text after a wrong one
};

/// The fenced blocks of a page, with what their first line promises: "// zip.json: 6 cases and 2 references".
std::vector<Example> examples_of(const std::string& page) {
  std::vector<Example> examples;
  static const std::regex block("```(jsonc|text)\n([^]*?)\n```"),
      title("// ([^:\n]+)(: (\\d+) cases?( and (\\d+) references?)?)?\n");
  for (std::sregex_iterator it(page.begin(), page.end(), block), end; it != end; ++it) {
    const std::string text = (*it)[2];
    if ((*it)[1] == "text") {
      examples.back().errors = text;
      continue;
    }
    std::smatch m;
    EXPECT_TRUE(std::regex_search(text, m, title, std::regex_constants::match_continuous)) << text;
    examples.push_back({m[1], text, m[3].matched ? std::stoi(m[3]) : -1, m[5].matched ? std::stoi(m[5]) : 0, ""});
  }
  return examples;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

class Docs : public Run {
 protected:
  void SetUp() override {
    Run::SetUp();
    fs::create_directories(folder_ + "/configs/fragments");
    fs::create_directory_symlink(fs::canonical(std::string(DVRLAB_CONFIGS) + "/../data"), folder_ + "/data");
    setenv("DVRLAB_DATA", (folder_ + "/data").c_str(), 1);
    examples_ = examples_of(text_of(std::string(DVRLAB_CONFIGS) + "/../docs/config.md"));
    for (const Example& e : examples_) std::ofstream(folder_ + "/configs/" + e.name) << e.text << "\n";
  }
  void TearDown() override { unsetenv("DVRLAB_DATA"); }
  std::string file(const Example& e) const { return folder_ + "/configs/" + e.name; }
  std::vector<Example> examples_;
};

TEST_F(Docs, ExamplesAreValid) {
  std::size_t valid = 0;
  for (const Example& e : examples_) {
    if (e.cases < 0) continue;
    try {
      const Experiment planned = plan_experiment(load_document(file(e)), registry());
      const auto references = std::count_if(planned.cases.begin(), planned.cases.end(),
                                            [](const PlannedCase& c) { return !c.reference_name.empty(); });
      EXPECT_EQ(std::ssize(planned.cases) - references, e.cases) << e.name;
      EXPECT_EQ(references, e.references) << e.name;
      ++valid;
    } catch (const InputError& error) {
      ADD_FAILURE() << e.name << ": " << error.what();
    }
  }
  EXPECT_GE(valid, 9u);
}

TEST_F(Docs, WrongExamplesFailAsShown) {
  std::size_t wrong = 0;
  for (const Example& e : examples_) {
    if (e.name.compare(0, 5, "wrong") != 0) continue;
    ASSERT_FALSE(e.errors.empty()) << e.name << " shows no message";
    ++wrong;
    try {
      plan_experiment(load_document(file(e)), registry());
      ADD_FAILURE() << e.name << " is valid";
    } catch (const InputError& error) {
      EXPECT_EQ(replaced(error.what(), folder_ + "/configs/", ""), e.errors);
    }
  }
  EXPECT_EQ(wrong, 3u);
}

// The page says so of this example; 64 x 48 pixels, so that it is cheap.
TEST_F(Docs, ViewsMeetTheirExpectations) {
  const RunSummary s = run_experiment({folder_ + "/configs/views.json", {}, {}, folder_ + "/out"});
  EXPECT_EQ(exit_code(s), 0) << summary_text(s);
  EXPECT_TRUE(fs::exists(s.folder + "/views.csv"));
}

}  // namespace
}  // namespace dvrlab::front
