#include "content/json_value.h"

#include "graben/core/errors.h"

#include <algorithm>

namespace graben {
namespace {

constexpr int deepest = 64;

class JsonParser {
public:
  JsonParser(std::string_view text, const std::string& path)
      : text_(text)
      , path_(path) {}

  JsonValue parse() {
    JsonValue value = next(0);
    skip();
    if (at_ != text_.size())
      fail("text behind the end of the JSON");
    return value;
  }

private:
  [[noreturn]] void fail(const std::string& what) const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(at_);
    throw ParseError(path_, 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n')),
                     what);
  }

  void skip() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

  char peek() {
    skip();
    if (at_ == text_.size())
      fail("the JSON ends in the middle; the file may be cut short");
    return text_[at_];
  }

  void expect(char c) {
    if (peek() != c)
      fail(std::string("the JSON needs a '") + c + "' here");
    ++at_;
  }

  std::string_view string() {
    expect('"');
    const std::size_t begin = at_;
    for (; at_ < text_.size() && text_[at_] != '"'; ++at_)
      at_ += text_[at_] == '\\' ? 1 : 0;
    if (at_ >= text_.size()) {
      at_ = text_.size();
      fail("the JSON ends in the middle; the file may be cut short");
    }
    return text_.substr(begin, at_++ - begin);
  }

  /// What stands between brackets, parted by commas.
  template <typename Item>
  void list(char end, Item item) {
    ++at_;
    if (peek() == end) {
      ++at_;
      return;
    }
    for (;;) {
      item();
      const char c = peek();
      if (c != end && c != ',')
        fail(std::string("the JSON needs a ',' or '") + end + "' here");
      ++at_;
      if (c == end)
        return;
    }
  }

  JsonValue next(int depth) {
    if (depth > deepest)
      fail("the JSON is nested too deeply");
    JsonValue value;
    switch (peek()) {
    case '{':
      value.kind = JsonValue::Kind::Object;
      list('}', [&] {
        peek();
        value.keys.push_back(string());
        expect(':');
        value.items.push_back(next(depth + 1));
      });
      break;
    case '[':
      value.kind = JsonValue::Kind::List;
      list(']', [&] { value.items.push_back(next(depth + 1)); });
      break;
    case '"':
      value.kind = JsonValue::Kind::String;
      value.text = string();
      break;
    default: {
      const std::size_t end = std::min(text_.find_first_of(",]}: \t\r\n[{\"", at_), text_.size());
      if (end == at_)
        fail("the JSON needs a value here");
      value.text = text_.substr(at_, end - at_);
      at_ = end;
    }
    }
    return value;
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
};

} // namespace

const JsonValue* JsonValue::find(std::string_view key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

std::string JsonValue::plain() const {
  std::string word;
  bool escaped = false;
  for (const char c : text) {
    const bool mark = c == '\\' && !escaped;
    if (!mark)
      word += escaped && (c == 'n' || c == 't' || c == 'r') ? ' ' : c;
    escaped = mark;
  }
  return word;
}

JsonValue parseJson(std::string_view text, const std::string& path) {
  return JsonParser(text, path).parse();
}

} // namespace graben
