// A cursor over JSON text that finds the place of a path; it builds nothing.
#include "formats/dialect/json_place.h"

#include "llvm/ADT/Twine.h"

#include <algorithm>
#include <set>

namespace ncvet {

namespace {

constexpr unsigned maxDepth = 64; ///< tables of today need nine

/// Where the comment that begins at `at` ends; `at` when none begins there.
size_t endOfComment(llvm::StringRef text, size_t at) {
  const llvm::StringRef rest = text.drop_front(at);
  if (!rest.startswith("//") && !rest.startswith("/*"))
    return at;
  const bool line = rest.startswith("//");
  const size_t end = line ? text.find('\n', at) : text.find("*/", at + 2);
  return end == llvm::StringRef::npos ? text.size() : end + (line ? 1 : 2);
}

class JsonCursor {
public:
  explicit JsonCursor(llvm::StringRef text) : text_(text) {}

  size_t at() const { return at_; }
  char peek() {
    skipBlanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char wanted) {
    if (peek() != wanted)
      return false;
    ++at_;
    return true;
  }
  /// The raw text between the quotes.
  llvm::StringRef takeString() {
    if (!take('"'))
      return {};
    size_t start = at_;
    while (at_ < text_.size() && text_[at_] != '"')
      at_ += text_[at_] == '\\' ? 2 : 1;
    at_ = std::min(at_, text_.size());
    llvm::StringRef string = text_.slice(start, at_);
    take('"');
    return string;
  }
  void skipValue() {
    unsigned depth = 0;
    do {
      char next = peek();
      if (next == '\0')
        return;
      if (next == '"') {
        takeString();
        continue;
      }
      depth += next == '{' || next == '[';
      depth -= depth && (next == '}' || next == ']');
      ++at_;
      if (!isBracketOrMark(next))
        while (at_ < text_.size() && !isEnd(text_[at_]))
          ++at_;
    } while (depth);
  }

private:
  static bool isBracketOrMark(char c) { return llvm::StringRef("{}[]:,").contains(c); }
  static bool isEnd(char c) { return llvm::StringRef("{}[]:,\"/ \t\r\n").contains(c); }
  void skipBlanks() {
    while (at_ < text_.size()) {
      if (llvm::StringRef(" \t\r\n").contains(text_[at_]))
        ++at_;
      else if (const size_t end = endOfComment(text_, at_); end != at_)
        at_ = end;
      else
        break;
    }
  }

  llvm::StringRef text_;
  size_t at_ = 0;
};

/// Walks a value with all that is in it.
std::optional<size_t> repeatedKeyIn(JsonCursor &scanner, unsigned depth) {
  const char open = scanner.peek();
  if ((open != '{' && open != '[') || depth == maxDepth) {
    scanner.skipValue();
    return std::nullopt;
  }
  scanner.take(open);
  std::set<llvm::StringRef> keys;
  for (char next = scanner.peek(); next != '\0' && next != '}' && next != ']';
       next = scanner.peek()) {
    const size_t place = scanner.at();
    if (open == '{') {
      if (!keys.insert(scanner.takeString()).second)
        return place;
      scanner.take(':');
    }
    if (const auto found = repeatedKeyIn(scanner, depth + 1))
      return found;
    scanner.take(',');
    if (scanner.at() == place) // not JSON: no progress
      return std::nullopt;
  }
  scanner.take(open == '{' ? '}' : ']');
  return std::nullopt;
}

/// Moves to the value of one step and gives the place of its key or of the element.
std::optional<size_t> enter(JsonCursor &scanner, const JsonStep &step) {
  if (!scanner.take(step.isIndex ? '[' : '{'))
    return std::nullopt;
  for (size_t index = 0; scanner.peek() != '\0' && scanner.peek() != '}' && scanner.peek() != ']';
       ++index) {
    size_t place = scanner.at();
    if (!step.isIndex) {
      llvm::StringRef key = scanner.takeString();
      if (!scanner.take(':'))
        return std::nullopt;
      if (key == step.key)
        return place;
    } else if (index == step.index) {
      return place;
    }
    scanner.skipValue();
    scanner.take(',');
    if (scanner.at() == place) // not JSON: no progress
      return std::nullopt;
  }
  return std::nullopt;
}

} // namespace

std::string toString(llvm::ArrayRef<JsonStep> path) {
  std::string text;
  for (const JsonStep &step : path) {
    if (step.isIndex) {
      text += (llvm::Twine("[") + llvm::Twine(step.index) + "]").str();
      continue;
    }
    if (!text.empty())
      text += ".";
    text += step.key;
  }
  return text;
}

std::optional<size_t> findJsonPlace(llvm::StringRef text, llvm::ArrayRef<JsonStep> path) {
  JsonCursor scanner(text);
  std::optional<size_t> place = (scanner.peek(), scanner.at());
  for (const JsonStep &step : path)
    if (!(place = enter(scanner, step)))
      return std::nullopt;
  return place;
}

std::optional<llvm::StringRef> findJsonMember(llvm::StringRef text, llvm::StringRef key) {
  JsonCursor scanner(text);
  JsonStep step;
  step.key = key.str();
  if (!enter(scanner, step))
    return std::nullopt;
  scanner.peek();
  size_t start = scanner.at();
  scanner.skipValue();
  return text.slice(start, scanner.at());
}

std::optional<size_t> findRepeatedKey(llvm::StringRef text) {
  JsonCursor scanner(text);
  return repeatedKeyIn(scanner, 0);
}

unsigned lineAt(llvm::StringRef text, size_t offset) {
  return unsigned(text.take_front(offset).count('\n')) + 1;
}

bool nestsTooDeep(llvm::StringRef text) {
  unsigned depth = 0;
  for (size_t at = 0; at < text.size(); ++at) {
    switch (text[at]) {
    case '/': // to the last byte of a comment; a lone one is no JSON, which is said later
      if (const size_t end = endOfComment(text, at); end != at)
        at = end - 1;
      break;
    case '"': // to the closing quote: one after an odd number of backslashes is part of the text
      for (at = text.find('"', at + 1); at != llvm::StringRef::npos; at = text.find('"', at + 1)) {
        size_t slashes = at;
        while (text[slashes - 1] == '\\')
          --slashes;
        if ((at - slashes) % 2 == 0)
          break;
      }
      if (at == llvm::StringRef::npos)
        return false;
      break;
    case '{':
    case '[':
      if (++depth > maxDepth)
        return true;
      break;
    case '}':
    case ']':
      depth -= depth > 0;
      break;
    default:
      break;
    }
  }
  return false;
}

} // namespace ncvet
