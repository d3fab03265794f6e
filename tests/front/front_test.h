// What the tests of the front share: a small config and words in messages.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "framework/config/experiment.h"
#include "framework/interfaces/error.h"

namespace dvrlab::front {

/// A complete config; `more` is further JSON text for the top, beginning with a comma.
inline std::string small_config(const std::string& more = "") {
  return R"({
  "name": "small",
  "data": {"type": "procedural", "field": "sphere", "size": [12, 12, 12]},
  "optical_model": {"type": "absorption_emission", "extinction": [[0, 0], [1, 2]], "color": [[0, 1, 0.5, 0.25]]},
  "estimator": {"type": "direct"},
  "camera": {"type": "orthographic", "position": [0, 0, 3], "up": [0, 1, 0]},
  "image": {"size": [8, 6]},
  "backend": {"type": "cpu"}
)" + more +
         "}";
}

inline const Registry& registry() {
  static const Registry found;
  return found;
}

inline Experiment plan(const std::string& text, const std::vector<std::string>& set = {}) {
  return plan_experiment(parse_document(text, "test.json", ".", set), registry());
}

/// The lines of the InputError that planning throws; none when it does not.
inline std::vector<std::string> errors_of(const std::string& text, const std::vector<std::string>& set = {}) {
  std::vector<std::string> lines;
  try {
    plan(text, set);
  } catch (const InputError& e) {
    std::string all = e.what();
    for (std::size_t at; (at = all.find('\n')) != std::string::npos; all.erase(0, at + 1))
      lines.push_back(all.substr(0, at));
    lines.push_back(all);
  }
  return lines;
}

inline void expect_words(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is not in: " << text;
}

/// Exactly one error line, with these words.
inline void expect_error(const std::string& text, const std::vector<std::string>& words,
                         const std::vector<std::string>& set = {}) {
  const std::vector<std::string> lines = errors_of(text, set);
  ASSERT_EQ(lines.size(), 1u) << testing::PrintToString(lines);
  expect_words(lines[0], words);
}

}  // namespace dvrlab::front
