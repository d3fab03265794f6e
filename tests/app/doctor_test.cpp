// `dvrlab doctor` on machines that lack something: drivers and libraries are hidden by the environment.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/app/program.h"

namespace dvrlab::app_test {
namespace {

class Doctor : public Program {
 protected:
  static nlohmann::json backend(const nlohmann::json& report, const std::string& name) {
    for (const nlohmann::json& b : report["backends"])
      if (b["name"] == name) return b;
    return {};
  }
  /// A folder whose files the dynamic loader finds before the real libraries, and cannot open.
  std::string hidden(const std::vector<std::string>& libraries) const {
    std::filesystem::create_directories(path("hidden"));
    for (const std::string& library : libraries) write("hidden/" + library, "this is no library");
    return "LD_LIBRARY_PATH=$PWD/hidden ";
  }
};

bool built(const std::string& backend) {
  return std::filesystem::exists(DVRLAB_PLUGIN_OUTPUT "/backend/" + backend + "/" + backend + ".so");
}

TEST_F(Doctor, TheProcessorCanAlwaysRender) {
  const nlohmann::json report = json_of("dvrlab doctor --json");
  EXPECT_EQ(report["can_render"], true);
  const nlohmann::json cpu = backend(report, "cpu");
  ASSERT_EQ(cpu["devices"].size(), 1u);
  EXPECT_EQ(cpu["runs"], true);
  expect_words(cpu["devices"][0]["properties"]["instruction sets"], {"scalar"});
  ASSERT_EQ(report["kernel_modules"].size(), 5u);
  for (const nlohmann::json& m : report["kernel_modules"]) EXPECT_EQ(m["present"], m["expected"]) << m;
  ASSERT_FALSE(report["plugin_folders"].empty());
  EXPECT_GE(report["plugin_folders"][0]["plugins"]["data"], 3);
  EXPECT_GT(report["memory"]["available_bytes"].get<double>(), 1e8);
  expect_words(run("dvrlab doctor").out,
               {"backend cpu: can render", "kernel modules (cpu)", "plugin folder", "cache ", "memory: "});
}

TEST_F(Doctor, VulkanWithoutADriver) {
  if (!built("vulkan")) GTEST_SKIP() << "not supported: the vulkan backend is not built";
  const nlohmann::json report =
      json_of("VK_ICD_FILENAMES=/nowhere.json VK_DRIVER_FILES=/nowhere.json dvrlab doctor --json");
  const nlohmann::json vulkan = backend(report, "vulkan");
  EXPECT_EQ(vulkan["runs"], false);
  EXPECT_EQ(vulkan["package"], "mesa-vulkan-drivers");
  EXPECT_EQ(report["can_render"], true) << "the cpu is left";
}

TEST_F(Doctor, VulkanWithoutItsLoader) {
  if (!built("vulkan")) GTEST_SKIP() << "not supported: the vulkan backend is not built";
  const std::string without = hidden({"libvulkan.so.1", "libvulkan.so"});
  const nlohmann::json vulkan = backend(json_of(without + "dvrlab doctor --json"), "vulkan");
  EXPECT_EQ(vulkan["runs"], false);
  EXPECT_EQ(vulkan["package"], "libvulkan1");
  expect_words(vulkan["problem"], {"libvulkan.so.1"});
  expect_words(run(without + "dvrlab doctor").out, {"apt-get install libvulkan1"});
  expect_one_error(
      run(without + "dvrlab render data/fuel.nrrd --set backend.type=vulkan -o a.png 2>&1 >/dev/null | grep "
                    "error: >&2; exit 3"),
      3, {"libvulkan.so.1", "Debian: libvulkan1"});
}

TEST_F(Doctor, OpenGlWithoutItsLibraryOrItsDriver) {
  if (!built("opengl")) GTEST_SKIP() << "not supported: the opengl backend is not built";
  const nlohmann::json no_library = backend(json_of(hidden({"libEGL.so.1"}) + "dvrlab doctor --json"), "opengl");
  EXPECT_EQ(no_library["runs"], false);
  EXPECT_EQ(no_library["package"], "libegl1");
  const nlohmann::json no_driver =
      backend(json_of("__EGL_VENDOR_LIBRARY_FILENAMES=/nowhere.json dvrlab doctor --json"), "opengl");
  EXPECT_EQ(no_driver["runs"], false);
  EXPECT_EQ(no_driver["package"], "libegl-mesa0");
  EXPECT_NE(no_driver["problem"], "");
}

TEST_F(Doctor, NoBackendIsExitCode3) {
  // A second copy of every backend: neither of the two may be used.
  std::filesystem::create_directories(path("more"));
  std::filesystem::copy(DVRLAB_PLUGIN_OUTPUT "/backend", path("more/backend"),
                        std::filesystem::copy_options::recursive);
  const nlohmann::json report = json_of("dvrlab doctor --json --plugin-path more", 3);
  EXPECT_EQ(report["can_render"], false);
  EXPECT_GE(report["broken_plugins"].size(), 2u);
  expect_words(report["broken_plugins"][0]["reason"], {"is there twice"});
  expect_words(run("dvrlab doctor --plugin-path more").out, {"no backend can render", "missing:", "broken plugin"});
}

TEST_F(Doctor, BrokenPluginsAreNamed) {
  std::filesystem::create_directories(path("more/estimator/garbage"));
  write("more/estimator/garbage/garbage.so", "this is no library");
  const nlohmann::json report = json_of("dvrlab doctor --json --plugin-path more");
  ASSERT_EQ(report["broken_plugins"].size(), 1u);
  EXPECT_EQ(report["broken_plugins"][0]["plugin"], "estimator/garbage");
  expect_words(report["broken_plugins"][0]["reason"], {"is not loadable"});
}

TEST_F(Doctor, AMissingFolderOfTheSearchPathIsAFinding) {
  const std::string lost = "DVRLAB_PLUGIN_PATH=/nope:configs:/nor/this ";
  const nlohmann::json report = json_of(lost + "dvrlab doctor --json");
  ASSERT_EQ(report["missing_plugin_folders"].size(), 2u);
  expect_words(run(lost + "dvrlab doctor").out, {"missing:", "DVRLAB_PLUGIN_PATH: there is no folder '/nope'"});
  const Outcome list = run(lost + "dvrlab list");
  EXPECT_EQ(list.code, 0);
  expect_words(list.err, {"DVRLAB_PLUGIN_PATH: there is no folder '/nope'", "'/nor/this'"});
  expect_one_error(run(lost + "dvrlab describe image"), 2, {"DVRLAB_PLUGIN_PATH: there is no folder '/nope'"});
  EXPECT_TRUE(json_of("dvrlab doctor --json")["missing_plugin_folders"].empty());
}

TEST_F(Doctor, ADuplicateIsListedOnce) {
  std::filesystem::create_directories(path("more/metric/psnr"));
  std::filesystem::copy_file(DVRLAB_PLUGIN_OUTPUT "/metric/psnr/psnr.so", path("more/metric/psnr/psnr.so"));
  std::size_t rows = 0;
  for (const nlohmann::json& row : json_of("dvrlab list metric --json --plugin-path more"))
    if (row["name"] == "psnr") ++rows;
  EXPECT_EQ(rows, 1u);
  expect_words(run("dvrlab list metric --plugin-path more").out, {"is there twice"});
}

TEST_F(Doctor, PluginsThatWereNotBuiltAreThoseOfTheBuild) {
  std::ifstream in(DVRLAB_BUILD "/lib/dvrlab/plugins_not_built.txt");
  ASSERT_TRUE(in) << "the build writes it";
  std::size_t expected = 0;
  for (std::string line; std::getline(in, line);) expected += line.empty() ? 0 : 1;
  EXPECT_EQ(json_of("dvrlab doctor --json")["plugins_not_built"].size(), expected);
}

TEST_F(Doctor, Cache) {
  write("file", "");
  const nlohmann::json bad = json_of("DVRLAB_CACHE=$PWD/file dvrlab doctor --json")["cache"];
  EXPECT_EQ(bad["writable"], false);
  expect_words(bad["problem"], {"is no folder", "DVRLAB_CACHE"});
  const nlohmann::json fresh = json_of("DVRLAB_CACHE=$PWD/new/cache dvrlab doctor --json")["cache"];
  EXPECT_EQ(fresh["writable"], true);
  EXPECT_EQ(fresh["exists"], false);
  EXPECT_FALSE(std::filesystem::exists(path("new"))) << "looking makes nothing";
}

}  // namespace
}  // namespace dvrlab::app_test
