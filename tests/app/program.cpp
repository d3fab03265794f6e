#include "tests/app/program.h"

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace dvrlab::app_test {
namespace fs = std::filesystem;

void Program::SetUp() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  folder_ = testing::TempDir() + "/dvrlab_app_" + info->test_suite_name() + "_" + info->name();
  fs::remove_all(folder_);
  fs::create_directories(folder_ + "/bin");
  fs::create_symlink(DVRLAB_PROGRAM, folder_ + "/bin/dvrlab");
  for (const char* name : {"configs", "data", "plugins"})
    fs::create_directory_symlink(std::string(DVRLAB_SOURCE "/") + name, folder_ + "/" + name);
}

Outcome Program::run(const std::string& line) const {
  write("command.sh", "cd '" + folder_ + "'\nPATH='" + folder_ + "/bin':$PATH\n" + line + "\n");
  const int status = std::system(
      ("sh '" + folder_ + "/command.sh' >'" + folder_ + "/stdout' 2>'" + folder_ + "/stderr' </dev/null").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("stdout"), read("stderr")};
}

nlohmann::json Program::json_of(const std::string& line, int code) const {
  const Outcome o = run(line);
  EXPECT_EQ(o.code, code) << line << "\n" << o.err;
  EXPECT_TRUE(nlohmann::json::accept(o.out)) << line << "\n" << o.out;
  return nlohmann::json::parse(o.out, nullptr, false);
}

void Program::write(const std::string& file, const std::string& text) const {
  std::ofstream(folder_ + "/" + file, std::ios::binary) << text;
}

std::string Program::read(const std::string& file) const {
  std::ifstream in(folder_ + "/" + file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is not in: " << text;
}

void expect_one_error(const Outcome& o, int code, const std::vector<std::string>& words) {
  EXPECT_EQ(o.code, code) << o.err;
  EXPECT_EQ(o.out, "");
  EXPECT_EQ(o.err.find("error: "), 0u) << o.err;
  EXPECT_EQ(o.err.find('\n'), o.err.size() - 1) << o.err;
  expect_words(o.err, words);
}

std::string small_nrrd(const std::string& lines) {
  std::string text = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\nencoding: raw\n" + lines + "\n";
  for (char v = 0; v < 24; ++v) text += v;
  return text;
}

}  // namespace dvrlab::app_test
