// A cursor over JSON text that finds the place of a path; it builds nothing.
#include "formats/dialect/json_place.h"

#include "llvm/ADT/STLExtras.h"
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

/// The quote that closes a text which begins at `at`; one after an odd number of backslashes is
/// part of it. `npos`: none does.
size_t closingQuote(llvm::StringRef text, size_t at) {
  for (size_t quote = text.find('"', at); quote != llvm::StringRef::npos;
       quote = text.find('"', quote + 1)) {
    size_t slashes = quote;
    while (slashes > at && text[slashes - 1] == '\\')
      --slashes;
    if ((quote - slashes) % 2 == 0)
      return quote;
  }
  return llvm::StringRef::npos;
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
    const size_t start = at_;
    const size_t end = closingQuote(text_, start);
    at_ = end == llvm::StringRef::npos ? text_.size() : end + 1;
    return text_.slice(start, end);
  }
  /// Past a value with all that is in it. The tables of all controls are gone over at each start:
  /// what is neither a bracket nor a text nor a comment costs a look at its byte.
  void skipValue() {
    skipBlanks();
    unsigned depth = 0;
    while (at_ < text_.size()) {
      const char next = text_[at_];
      if (next == '"') {
        takeString();
        if (depth == 0)
          return;
      } else if (next == '{' || next == '[') {
        ++depth;
        ++at_;
      } else if (next == '}' || next == ']') {
        at_ += depth > 0;
        if (depth <= 1)
          return;
        --depth;
      } else if (depth == 0 && isBlankOrMark(next)) {
        return;
      } else {
        const size_t end = next == '/' ? endOfComment(text_, at_) : at_;
        at_ = std::max(end, at_ + 1);
      }
    }
  }

private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  static bool isBlankOrMark(char c) { return isBlank(c) || c == ':' || c == ','; }
  void skipBlanks() {
    while (at_ < text_.size()) {
      if (isBlank(text_[at_]))
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

std::vector<std::optional<llvm::StringRef>> findJsonMembers(llvm::StringRef text,
                                                            llvm::ArrayRef<llvm::StringRef> keys) {
  std::vector<std::optional<llvm::StringRef>> found(keys.size());
  JsonCursor scanner(text);
  if (!scanner.take('{'))
    return found;
  for (char next = scanner.peek(); next != '\0' && next != '}' && next != ']';
       next = scanner.peek()) {
    const size_t place = scanner.at();
    const llvm::StringRef key = scanner.takeString();
    if (!scanner.take(':'))
      break;
    scanner.peek();
    const size_t start = scanner.at();
    scanner.skipValue();
    const auto *wanted = llvm::find(keys, key);
    if (wanted != keys.end() && !found[size_t(wanted - keys.begin())])
      found[size_t(wanted - keys.begin())] = text.slice(start, scanner.at());
    scanner.take(',');
    if (scanner.at() == place) // not JSON: no progress
      break;
  }
  return found;
}

std::optional<llvm::StringRef> findJsonMember(llvm::StringRef text, llvm::StringRef key) {
  return findJsonMembers(text, key).front();
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
    case '"':
      at = closingQuote(text, at + 1);
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
