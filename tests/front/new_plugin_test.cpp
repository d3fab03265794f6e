// new-plugin: what it makes of the templates, and what it refuses. That the results build and render: tests/sdk.
#include "framework/plugin/new_plugin.h"

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "framework/plugin/open_library.h"
#include "tests/front/front_test.h"

namespace dvrlab::front {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class NewPluginTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::canonical(testing::TempDir()) /
              (std::string("new_plugin_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    before_ = fs::current_path();
    fs::current_path(folder_);
  }
  void TearDown() override {
    fs::current_path(before_);
    fs::remove_all(folder_);
  }
  std::string refusal(const std::string& kind, const std::string& name, const std::string& out = "") {
    try {
      new_plugin(kind, name, out, registry());
    } catch (const InputError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "one line: " << e.what();
      return e.what();
    }
    return "";
  }
  fs::path folder_, before_;
};

TEST_F(NewPluginTest, EveryKindGetsItsNameEverywhere) {
  for (const std::string kind : plugin_kinds) {
    const NewPlugin made = new_plugin(kind, "light_field_2", kind, registry());
    EXPECT_FALSE(made.in_source_tree);
    EXPECT_EQ(fs::absolute(made.folder), folder_ / kind / "light_field_2");
    for (const char* role : {".cpp", ".md", ".example.json", "_test.cpp"})
      EXPECT_TRUE(fs::exists(fs::path(made.folder) / ("light_field_2" + std::string(role)))) << kind << role;
    const bool has_kernel = kind == "sampler" || kind == "estimator";
    EXPECT_EQ(fs::exists(fs::path(made.folder) / "light_field_2.kernel"), has_kernel) << kind;
    for (const std::string& file : made.files) {
      const std::string text = text_of(fs::path(made.folder) / file);
      EXPECT_EQ(text.find("my_"), std::string::npos) << kind << "/" << file;
      EXPECT_EQ(text.find("My"), std::string::npos) << kind << "/" << file;
    }
    expect_words(text_of(fs::path(made.folder) / "light_field_2.cpp"),
                 {"namespace dvrlab::light_field_2 {", "class LightField2 ", "\"" + kind + "\", \"light_field_2\""});
    expect_words(text_of(fs::path(made.folder) / "light_field_2_test.cpp"), {"TEST(LightField2, "});
    expect_words(text_of(fs::path(made.folder) / "CMakeLists.txt"),
                 {"find_package(dvrlab REQUIRED)", "KIND " + kind + " NAME light_field_2)"});
  }
}

TEST_F(NewPluginTest, InsideOfASourceTreeItLiesAmongThePlugins) {
  fs::create_directories("tree/plugins/_template");
  fs::create_directories("tree/framework/interfaces");
  std::ofstream("tree/framework/interfaces/plugin.h") << "";
  fs::create_directories("tree/docs/math");
  fs::current_path("tree/docs/math");
  const NewPlugin estimator = new_plugin("estimator", "mine", "", registry());
  EXPECT_TRUE(estimator.in_source_tree);
  EXPECT_EQ(fs::path(estimator.folder), folder_ / "tree/plugins/estimator/mine");
  EXPECT_FALSE(fs::exists(fs::path(estimator.folder) / "CMakeLists.txt")) << "the tree's own finds it";
  EXPECT_EQ(fs::path(new_plugin("backend", "mine", "", registry()).folder), folder_ / "tree/backends/mine");
  EXPECT_FALSE(new_plugin("metric", "mine", "elsewhere", registry()).in_source_tree);
  fs::current_path(folder_);
  EXPECT_EQ(fs::absolute(new_plugin("metric", "mine", "", registry()).folder), folder_ / "mine");
}

TEST_F(NewPluginTest, NothingIsOverwritten) {
  new_plugin("metric", "mine", "", registry());
  std::ofstream("mine/mine.cpp") << "my own work";
  expect_words(refusal("metric", "mine"), {"mine exists", "nothing is overwritten", "--out"});
  EXPECT_EQ(text_of("mine/mine.cpp"), "my own work");
  std::ofstream("other") << "a file of this name";
  expect_words(refusal("metric", "other"), {"other exists"});
  fs::create_symlink("nowhere", "dangling");
  expect_words(refusal("metric", "dangling"), {"dangling exists"});
}

TEST_F(NewPluginTest, UnknownKinds) {
  expect_words(refusal("estimater", "mine"), {"no kind 'estimater'", "did you mean 'estimator'?", "backend"});
  expect_words(refusal("", "mine"), {"no kind ''"});
  EXPECT_TRUE(fs::is_empty(folder_)) << "nothing is left behind";
}

TEST_F(NewPluginTest, BadAndTakenNames) {
  for (const char* name : {"", "Mine", "2d", "_mine", "my-plugin", "my plugin", "../mine", "a/b", "mäßig", "mine.cpp"})
    expect_words(refusal("estimator", name), {"'" + std::string(name) + "' cannot name a plugin", "small letter"});
  for (const char* name : {"class", "template", "requires", "co__lor", "mine_", "frame", "gl"})
    expect_words(refusal("estimator", name), {"'" + std::string(name) + "' cannot name a plugin"});
  expect_words(refusal("estimator", "direct"), {"estimator 'direct' already", "plugins/estimator/direct"});
  EXPECT_EQ(refusal("metric", "direct"), "") << "a name is taken within its kind only";
}

TEST_F(NewPluginTest, AFolderThatCannotBeMade) {
  std::ofstream("file") << "";
  expect_words(refusal("metric", "mine", "file"), {"file/mine cannot be made"});
  expect_words(refusal("metric", std::string(300, 'a')), {"new-plugin: the folder a", "cannot be made", "too long"});
}

TEST_F(NewPluginTest, CommandLine) {
  const auto command = [](const std::string& arguments) {
    return WEXITSTATUS(std::system((std::string(DVRLAB_PROGRAM) + " " + arguments + " >printed 2>&1").c_str()));
  };
  EXPECT_EQ(command("new-plugin metric mine"), 0) << text_of("printed");
  expect_words(text_of("printed"),
               {"made mine: ", "mine_test.cpp", "next:", "-Ddvrlab_DIR=", "cmake --build mine/build",
                "--plugin-path mine/build/plugins render mine/mine.example.json"});
  EXPECT_EQ(command("new-plugin metric mine"), 2);
  EXPECT_EQ(command("new-plugin metric"), 2);
  EXPECT_EQ(command("--json new-plugin sampler other"), 0);
  EXPECT_EQ(command("--plugin-path /no/such/folder list"), 2);
  EXPECT_EQ(command("--plugin-path '" + std::string(DVRLAB_BROKEN_PLUGINS) + "/good' list estimator"), 0);
  expect_words(text_of("printed"), {"direct", "twin"});
}

}  // namespace
}  // namespace dvrlab::front
