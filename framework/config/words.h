// Lists of words in declarations and messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dvrlab {

/// "a|b|c" -> {"a", "b", "c"}; "" -> {}.
std::vector<std::string> split_words(std::string_view text, char separator = '|');

/// {"a", "b", "c"} -> "a, b, c".
std::string join_words(const std::vector<std::string>& words, const char* separator = ", ");

}  // namespace dvrlab
