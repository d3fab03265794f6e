// Every way in which a plugin can fail has its own sentence, and none of them harms the others.
#include "framework/plugin/registry.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "framework/interfaces/error.h"
#include "framework/interfaces/estimator.h"

namespace dvrlab {
namespace {

const std::string broken = DVRLAB_BROKEN_PLUGINS;

std::string why_not(const std::vector<std::string>& roots, const std::string& name) {
  const Registry registry(roots);
  EXPECT_NO_THROW(registry.find("estimator", "direct")) << "a broken plugin must not break the others";
  try {
    registry.find("estimator", name, "estimator.type");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is not in: " << text;
}

TEST(Registry, FindsTheFrameworksOwnPlugins) {
  const Registry registry;
  EXPECT_STREQ(registry.find("estimator", "direct").descriptor->kind, "estimator");
  EXPECT_EQ(&registry.get<EstimatorPlugin>("estimator", "direct"),
            &registry.get<EstimatorPlugin>("estimator", "direct"));
  EXPECT_TRUE(std::filesystem::is_directory(Registry::kernel_folder()));
}

TEST(Registry, NotFoundNamesKindFoldersNearestAndWhatIsThere) {
  expect_words(why_not({broken + "/good"}, "dirct"),
               {"estimator.type: ", "no estimator 'dirct'", "did you mean 'direct'?",
                "there are approximative, average, direct", "twin", broken + "/good/estimator"});
}

TEST(Registry, NotLoadableGivesTheLoadersReason) {
  expect_words(why_not({broken + "/not_loadable"}, "garbage"), {"not loadable", "garbage.so", "file too short"});
}

TEST(Registry, MissingLibrary) {
  expect_words(why_not({broken + "/no_library"}, "empty"), {"has no library", "empty.so"});
}

TEST(Registry, MissingEntryPoint) {
  expect_words(why_not({broken + "/no_entry"}, "silent"),
               {"no entry point", "silent.so", "dvrlab_plugin", "DVRLAB_PLUGIN"});
}

TEST(Registry, OtherAbiNamesBothTags) {
  expect_words(why_not({broken + "/other_abi"}, "foreign"), {"another ABI", "dvrlab-0-of-long-ago", DVRLAB_ABI_TAG});
}

TEST(Registry, MisplacedNamesBoth) {
  expect_words(why_not({broken + "/misplaced"}, "stranger"), {"misplaced", "'twin'", "'stranger'"});
}

TEST(Registry, DuplicateNamesBothFiles) {
  expect_words(why_not({broken + "/good", broken + "/twice"}, "twin"),
               {"twice", broken + "/good/estimator/twin/twin.so", broken + "/twice/estimator/twin/twin.so"});
}

TEST(Registry, OneLibraryThroughTwoRootsIsOnePlugin) {
  const std::string link = testing::TempDir() + "/root_link";
  std::filesystem::remove(link);
  std::filesystem::create_directory_symlink(broken + "/good", link);
  const std::string nested = testing::TempDir() + "/root_nested/estimator";
  std::filesystem::remove_all(nested);
  std::filesystem::create_directories(nested);
  std::filesystem::create_directory_symlink(broken + "/good/estimator/twin", nested + "/twin");
  const Registry registry({broken + "/good", link, testing::TempDir() + "/root_nested"});
  EXPECT_NE(registry.find("estimator", "twin").descriptor, nullptr);
}

TEST(Registry, ConstructorThatThrows) {
  const Registry registry({broken + "/throws"});
  try {
    registry.get<EstimatorPlugin>("estimator", "grumpy");
    FAIL() << "expected NotSupported";
  } catch (const NotSupported& e) {
    expect_words(e.what(), {"grumpy", "not in the mood", "grumpy.so"});
  }
}

TEST(Registry, ConstructorThatThrowsNoException) {
  const Registry registry({broken + "/throws_anything"});
  try {
    registry.get<EstimatorPlugin>("estimator", "odd");
    FAIL() << "expected NotSupported";
  } catch (const NotSupported& e) {
    expect_words(e.what(), {"'odd' could not be made", "no std::exception", "odd.so"});
  }
}

TEST(Registry, EntryPointThatThrows) {
  expect_words(why_not({broken + "/entry_throws"}, "moody"),
               {"broken entry point", "moody.so", "dvrlab_plugin", "threw an exception"});
}

TEST(Registry, EntryPointThatReturnsNothing) {
  expect_words(why_not({broken + "/entry_null"}, "mute"), {"broken entry point", "mute.so", "no descriptor"});
}

TEST(Registry, EveryProblemIsOneLine) {
  int problems = 0;
  for (const char* root :
       {"not_loadable", "no_library", "no_entry", "other_abi", "misplaced", "entry_throws", "entry_null"}) {
    const Registry registry({broken + "/" + root});
    for (const PluginEntryInfo& e : registry.entries()) {
      problems += e.problem.empty() ? 0 : 1;
      EXPECT_EQ(e.problem.find('\n'), std::string::npos) << e.problem;
      EXPECT_EQ(e.problem.empty(), e.descriptor != nullptr);
    }
  }
  EXPECT_EQ(problems, 7);
}

/// Sets DVRLAB_PLUGIN_PATH and puts it back.
class PluginPath {
 public:
  explicit PluginPath(const std::string& value)
      : before_(std::getenv("DVRLAB_PLUGIN_PATH") ? std::getenv("DVRLAB_PLUGIN_PATH") : "") {
    setenv("DVRLAB_PLUGIN_PATH", value.c_str(), 1);
  }
  ~PluginPath() { before_.empty() ? unsetenv("DVRLAB_PLUGIN_PATH") : setenv("DVRLAB_PLUGIN_PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

TEST(Registry, SearchPathIsOptionThenEnvironmentThenItsOwnTree) {
  const PluginPath path(":" + broken + "/good:" + broken + "/throws:");
  const Registry registry({broken + "/kernels"});
  EXPECT_EQ(registry.roots(), (std::vector<std::string>{broken + "/kernels", broken + "/good", broken + "/throws",
                                                        Registry::home() + "/plugins"}));
  EXPECT_NE(registry.find("estimator", "twin").descriptor, nullptr) << "from the environment";
  EXPECT_NE(registry.find("estimator", "crooked").descriptor, nullptr) << "from the option";
}

TEST(Registry, MissingFolderInTheEnvironmentIsNamed) {
  const PluginPath path("/no/such/place");
  try {
    const Registry registry;
    FAIL() << "expected InputError";
  } catch (const InputError& e) {
    expect_words(e.what(), {"DVRLAB_PLUGIN_PATH", "/no/such/place"});
  }
}

TEST(Registry, MissingPluginFolder) {
  try {
    const Registry registry({"/no/such/folder"});
    FAIL() << "expected InputError";
  } catch (const InputError& e) {
    expect_words(e.what(), {"--plugin-path", "/no/such/folder"});
  }
}

TEST(NearestName, GuessesTyposAndBeginningsOnly) {
  const std::vector<std::string> names = {"direct", "approximative", "preintegrated"};
  EXPECT_EQ(nearest_name("dirct", names), "direct");
  EXPECT_EQ(nearest_name("Direct", names), "direct");
  EXPECT_EQ(nearest_name("preint", names), "preintegrated");
  EXPECT_EQ(nearest_name("lattice", names), "");
}

}  // namespace
}  // namespace dvrlab
