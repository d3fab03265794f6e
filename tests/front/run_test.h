// Whole runs in a folder of their own, by the library and by the command line.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "framework/pipeline.h"
#include "tests/front/front_test.h"

namespace dvrlab::front {

namespace fs = std::filesystem;

inline std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class Run : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "/dvrlab_run_" + testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  RunSummary run(const std::string& config, const std::vector<std::string>& set = {}) {
    std::ofstream(folder_ + "/small.json") << config;
    return run_experiment({folder_ + "/small.json", set, {}, folder_ + "/out"});
  }
  /// Exit code of the program; its output goes to `printed_`.
  int command(const std::string& arguments) {
    const std::string line = std::string(DVRLAB_PROGRAM) + " " + arguments + " >'" + folder_ + "/printed' 2>&1";
    const int status = std::system(line.c_str());
    printed_ = text_of(folder_ + "/printed");
    return WEXITSTATUS(status);
  }
  std::string folder_, printed_;
};

}  // namespace dvrlab::front
