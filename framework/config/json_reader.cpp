#include "framework/config/json_reader.h"

#include <iterator>

namespace dvrlab {
namespace {

constexpr std::size_t max_depth = 64;

/// Feeds the lexer and knows how far it has read.
struct CountingIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  const char* at;
  const char** read;  // one past the last character that was taken
  reference operator*() const { return *at; }
  CountingIterator& operator++() {
    *read = ++at;
    return *this;
  }
  CountingIterator operator++(int) {
    CountingIterator old = *this;
    ++*this;
    return old;
  }
  bool operator==(const CountingIterator& o) const { return at == o.at; }
  bool operator!=(const CountingIterator& o) const { return at != o.at; }
};

class TreeBuilder : public nlohmann::json_sax<ConfigJson> {
 public:
  TreeBuilder(const std::string& text, const std::string& file, Problems& problems)
      : file_(file),
        problems_(problems),
        begin_(text.data()),
        end_(begin_ + text.size()),
        read_(begin_),
        token_(begin_),
        line_begin_(begin_) {}

  const char** read() { return &read_; }
  ConfigTree take() { return std::move(tree_); }

  bool null() override { return value(nullptr); }
  bool boolean(bool v) override { return value(v); }
  bool number_integer(number_integer_t v) override { return number(v); }
  bool number_unsigned(number_unsigned_t v) override { return number(v); }
  bool number_float(number_float_t v, const string_t&) override { return number(v); }
  bool string(string_t& v) override { return value(std::move(v)); }
  bool binary(binary_t&) override { return false; }  // does not occur in text
  bool start_object(std::size_t) override { return open(ConfigJson::object()); }
  bool start_array(std::size_t) override { return open(ConfigJson::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    const Place here = next_place();
    key_ = name;
    if (stack_.back().node->contains(name)) {
      const std::string path = child_path(stack_.back().path, name);
      problems_.add(text_of(here) + path + ": duplicate key; it was written before at " + tree_.where(path) +
                    " (keep one)");
    }
    key_place_ = here;
    return true;
  }

  bool parse_error(std::size_t position, const std::string& last, const nlohmann::detail::exception& e) override {
    const std::size_t read = std::min(position, static_cast<std::size_t>(end_ - begin_));
    token_ = begin_ + (read == 0 ? 0 : read - 1);
    const std::string what = e.what();
    std::size_t reason = what.find(": ");
    if (reason == std::string::npos)
      reason = what.find("] ");  // "[json.exception.out_of_range.406] number overflow ..."
    problems_.add(text_of(place_of(token_)) + "not valid JSON" +
                  (reason == std::string::npos ? "" : ": " + what.substr(reason + 2)) +
                  (last.empty() ? "" : " (read so far: '" + last.substr(0, 40) + "')"));
    return false;
  }

 private:
  struct Level {
    ConfigJson* node;
    std::string path;
  };

  std::string text_of(const Place& p) const {
    return p.file + ":" + std::to_string(p.line) + ":" + std::to_string(p.column) + ": ";
  }

  Place place_of(const char* where) {
    for (; counted_ < where; ++counted_) {
      if (*counted_ == '\n') {
        ++line_;
        line_begin_ = counted_ + 1;
      }
    }
    return {file_, line_, static_cast<int>(where - line_begin_) + 1, ""};
  }

  /// The place of the token that was just read: the first character after the token before it that is neither
  /// space nor separator nor comment.
  Place next_place() {
    const char* at = token_;
    const auto comment_end = [&](const char* mark, std::size_t skip) {
      const char* found = std::search(at, end_, mark, mark + skip);
      return found == end_ ? end_ : found + skip;
    };
    for (;;) {
      while (at < read_ && (std::isspace(static_cast<unsigned char>(*at)) || *at == ',' || *at == ':')) ++at;
      if (at + 1 < read_ && at[0] == '/' && at[1] == '/') {
        at = comment_end("\n", 1);
      } else if (at + 1 < read_ && at[0] == '/' && at[1] == '*') {
        at = comment_end("*/", 2);
      } else {
        break;
      }
    }
    token_ = read_;
    return place_of(at);
  }

  template <class T>
  bool number(T v) {
    value(v);
    if (read_ < end_) token_ = read_ - 1;  // the lexer looks one character ahead to see where a number ends
    return true;
  }

  template <class T>
  bool value(T&& v) {
    place(std::forward<T>(v));
    return true;
  }

  /// Puts the value into the section or list that is open and notes where it was written.
  ConfigJson* place(ConfigJson v) {
    const Place value_place = next_place();
    ConfigJson* made = &tree_.root;
    Place here = value_place;
    if (stack_.empty()) {
      *made = std::move(v);
    } else {
      Level& level = stack_.back();
      if (level.node->is_array()) {
        here.path = child_path(level.path, level.node->size());
        level.node->push_back(std::move(v));
        made = &level.node->back();
      } else {
        here = key_place_;
        here.path = child_path(level.path, key_);
        made = &((*level.node)[key_] = std::move(v));
      }
    }
    path_ = here.path;
    tree_.set_place(path_, std::move(here));
    return made;
  }

  bool open(ConfigJson v) {
    if (stack_.size() >= max_depth) {
      problems_.add(text_of(place_of(token_)) + "sections lie deeper than " + std::to_string(max_depth) +
                    " levels (flatten the file)");
      return false;
    }
    ConfigJson* made = place(std::move(v));
    stack_.push_back({made, path_});
    return true;
  }

  bool close() {
    stack_.pop_back();
    token_ = read_;
    return true;
  }

  const std::string& file_;
  Problems& problems_;
  const char *begin_, *end_, *read_, *token_;
  const char* counted_ = begin_;
  const char* line_begin_;
  int line_ = 1;
  ConfigTree tree_;
  std::vector<Level> stack_;
  std::string key_, path_;
  Place key_place_;
};

}  // namespace

ConfigTree read_json(const std::string& text, const std::string& file, Problems& problems) {
  TreeBuilder builder(text, file, problems);
  const CountingIterator begin{text.data(), builder.read()}, end{text.data() + text.size(), builder.read()};
  ConfigJson::sax_parse(begin, end, &builder, nlohmann::detail::input_format_t::json, true, true);
  return builder.take();
}

}  // namespace dvrlab
