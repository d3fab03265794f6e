// Runs the program as a shell does, in a folder of its own that looks like the root of the sources.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dvrlab::app_test {

struct Outcome {
  int code = -1;
  std::string out, err;
};

class Program : public testing::Test {
 protected:
  void SetUp() override;
  /// `line` is a shell command in which `dvrlab` is the program; `environment`: "NAME=value ..." in front.
  Outcome run(const std::string& line) const;
  /// The JSON that a command prints; the test fails when its exit code is another.
  nlohmann::json json_of(const std::string& line, int code = 0) const;
  void write(const std::string& file, const std::string& text) const;
  std::string read(const std::string& file) const;
  std::string path(const std::string& file) const { return folder_ + "/" + file; }

 private:
  std::string folder_;
};

/// True when a program of this name is on the PATH.
bool installed(const std::string& program);

void expect_words(const std::string& text, const std::vector<std::string>& words);
/// Exactly one line that begins with "error: ", with these words; nothing on stdout.
void expect_one_error(const Outcome& outcome, int code, const std::vector<std::string>& words);

/// A 4 x 3 x 2 NRRD of uint8 0..23 with more header lines ("space: ...\n").
std::string small_nrrd(const std::string& lines);

}  // namespace dvrlab::app_test

#define DVRLAB_NEEDS(program, package)         \
  if (!::dvrlab::app_test::installed(program)) \
  GTEST_SKIP() << "not supported: " program " is missing (Debian: " package ")"
