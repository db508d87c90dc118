// Reads regular expressions for the texts that their matches hold.
#include "formats/text/needed_text.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/StringExtras.h"

namespace ncvet {

namespace {

constexpr size_t mostLetters = 4;  ///< of a set or a choice in a row of letters
constexpr size_t mostExact = 16;   ///< matches that are spelled out
constexpr size_t mostTexts = 40;   ///< more say little and cost more to look for
constexpr unsigned mostDepth = 50; ///< of groups

using Texts = std::vector<std::string>;

/// What is known of the matches of a part of an expression.
struct Matches {
  bool exact = false; ///< they are the texts, and nothing else
  Texts texts;        ///< … else each holds one of them; none: nothing is known
};

size_t shortest(const Texts &texts) {
  size_t least = texts.empty() ? 0 : texts.front().size();
  for (const std::string &text : texts)
    least = std::min(least, text.size());
  return least;
}

/// Keeps what says more.
void prefer(Texts &best, const Texts &other) {
  const size_t length = shortest(other);
  if (length > shortest(best) || (length && length == shortest(best) && other.size() < best.size()))
    best = other;
}

Texts joined(const Texts &before, const Texts &after) {
  Texts all;
  for (const std::string &begin : before)
    for (const std::string &end : after)
      all.push_back(begin + end);
  return all;
}

class NeededTexts {
public:
  explicit NeededTexts(llvm::StringRef pattern) : left_(pattern) {}

  Texts read() {
    Matches all = alternatives(0);
    if (unknown_ || !left_.empty() || !shortest(all.texts))
      return {};
    return all.texts;
  }

private:
  Matches alternatives(unsigned depth) {
    Matches all = sequence(depth);
    while (left_.consume_front("|")) {
      const Matches next = sequence(depth);
      all.exact &= next.exact && all.texts.size() + next.texts.size() <= mostExact;
      const bool nothing = !all.exact && (!shortest(all.texts) || !shortest(next.texts));
      all.texts.insert(all.texts.end(), next.texts.begin(), next.texts.end());
      if (nothing || all.texts.size() > mostTexts)
        all = {};
    }
    return all;
  }

  Matches sequence(unsigned depth) {
    Texts exact{""}, best;
    bool whole = true; // `exact` is all of it
    while (!left_.empty() && left_.front() != '|' && left_.front() != ')') {
      Matches part = repeated(depth);
      if (unknown_)
        return {};
      if (part.exact && part.texts.size() > 2 && !shortest(part.texts)) // `(^|[ (;])` says little
        part = {};
      if (part.exact && exact.size() * part.texts.size() <= mostExact) {
        exact = joined(exact, part.texts);
        continue;
      }
      prefer(best, exact);
      exact = part.exact ? part.texts : Texts{""};
      if (!part.exact)
        prefer(best, part.texts);
      whole = false;
    }
    if (whole)
      return {true, std::move(exact)};
    prefer(best, exact);
    return {false, std::move(best)};
  }

  Matches repeated(unsigned depth) {
    Matches part = single(depth);
    while (!left_.empty()) {
      if (left_.consume_front("*"))
        part = {};
      else if (left_.consume_front("+"))
        part.exact = false;
      else if (left_.consume_front("?"))
        part = part.exact ? withEmpty(std::move(part)) : Matches{};
      else if (left_.consume_front("{"))
        part = counted(std::move(part));
      else
        break;
    }
    return part;
  }

  static Matches withEmpty(Matches part) {
    part.texts.push_back("");
    return part;
  }

  Matches counted(Matches part) {
    unsigned least = 0;
    if (left_.consumeInteger(10, least) || !left_.contains('}')) {
      unknown_ = true;
      return {};
    }
    left_ = left_.drop_front(left_.find('}') + 1);
    part.exact = false;
    return least ? part : Matches{};
  }

  Matches single(unsigned depth) {
    const char letter = left_.front();
    left_ = left_.drop_front();
    switch (letter) {
    case '(':
      return group(depth + 1);
    case '[':
      return set();
    case '.':
      return {};
    case '^':
    case '$':
      return {true, {""}};
    case '\\':
      // Letters and digits have a meaning of their own after it.
      if (left_.empty() || llvm::isAlnum(left_.front())) {
        unknown_ = true;
        return {};
      }
      left_ = left_.drop_front();
      return {true, {std::string(1, left_.data()[-1])}};
    default:
      return {true, {std::string(1, letter)}};
    }
  }

  Matches group(unsigned depth) {
    if (depth > mostDepth || left_.startswith("?")) {
      unknown_ = true;
      return {};
    }
    Matches inner = alternatives(depth);
    if (!left_.consume_front(")"))
      unknown_ = true;
    return inner;
  }

  /// `[0-9A-Z]`, after its bracket.
  Matches set() {
    const bool others = left_.consume_front("^");
    Texts letters;
    for (bool first = true; !left_.empty() && (first || left_.front() != ']'); first = false) {
      // Classes such as `[:digit:]`, and escapes, have a meaning of their own.
      if (left_.startswith("[:") || left_.front() == '\\') {
        unknown_ = true;
        return {};
      }
      const auto from = uint8_t(left_.front());
      left_ = left_.drop_front();
      auto to = from;
      if (left_.size() > 1 && left_[0] == '-' && left_[1] != ']') {
        to = uint8_t(left_[1]);
        left_ = left_.drop_front(2);
      }
      for (unsigned letter = from; letter <= to && letters.size() <= mostLetters; ++letter)
        letters.push_back(std::string(1, char(letter)));
    }
    if (!left_.consume_front("]"))
      unknown_ = true;
    if (others || letters.size() > mostLetters)
      return {};
    return {true, std::move(letters)};
  }

  llvm::StringRef left_;
  bool unknown_ = false;
};

size_t pairOf(char first, char second) { return size_t(uint8_t(first)) << 8 | uint8_t(second); }

} // namespace

std::vector<std::string> neededTexts(llvm::StringRef pattern) {
  return NeededTexts(pattern).read();
}

HeldTexts::HeldTexts(llvm::StringRef text) : text_(text) {
  for (size_t i = 0; i < text.size(); ++i) {
    letters_.set(uint8_t(text[i]));
    if (i)
      pairs_.set(pairOf(text[i - 1], text[i]));
  }
}

bool HeldTexts::holds(llvm::StringRef part) const {
  if (part.size() == 1)
    return letters_.test(uint8_t(part.front()));
  for (size_t i = 1; i < part.size(); ++i)
    if (!pairs_.test(pairOf(part[i - 1], part[i])))
      return false;
  return part.size() <= 2 || text_.contains(part);
}

bool HeldTexts::holdsAny(llvm::ArrayRef<std::string> needed) const {
  return needed.empty() || llvm::any_of(needed, [&](const std::string &one) { return holds(one); });
}

} // namespace ncvet
