#include "framework/config/words.h"

namespace dvrlab {

std::vector<std::string> split_words(std::string_view text, char separator) {
  std::vector<std::string> words;
  if (text.empty()) return words;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = text.find(separator, begin);
    words.emplace_back(text.substr(begin, end == std::string_view::npos ? end : end - begin));
    if (end == std::string_view::npos) return words;
    begin = end + 1;
  }
}

std::string join_words(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += separator;
    text += word;
  }
  return text;
}

}  // namespace dvrlab
