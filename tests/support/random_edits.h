// Edits as somebody types them, and as somebody cuts and pastes: random, the same in every run.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace ncvet::test {

/// One edit: the bytes [begin, end) are replaced.
struct RandomEdit {
  size_t begin = 0, end = 0;
  std::string text;

  std::string applied(const std::string &to) const {
    return to.substr(0, begin) + text + to.substr(end);
  }
};

class RandomEdits {
public:
  /// Pieces of `program` are pasted when the text has become shorter than that.
  explicit RandomEdits(unsigned seed, std::string program = {})
      : random_(seed), program_(std::move(program)) {}

  RandomEdit next(const std::string &text) {
    const auto [begin, end] = line(text, below(text.size() + 1));
    switch (below(8)) {
    case 0: // a line goes
      return {begin, end, ""};
    case 1: // a line comes twice
      return {end, end, text.substr(begin, end - begin)};
    case 2: { // a line of another place is pasted
      const auto [from, to] = line(text, below(text.size() + 1));
      return {begin, begin, text.substr(from, to - from)};
    }
    case 3: // a comment
      return {begin, begin, "(X)\n"};
    case 4: { // a digit is changed
      const size_t at = text.find_first_of("0123456789", begin);
      if (at != std::string::npos && at < end)
        return {at, at + 1, std::string(1, char('0' + below(10)))};
      return {begin, begin, " "};
    }
    case 5: { // a letter is typed
      const std::string typed[] = {"G",     "X",    "1",       ".", " ",    "\n",
                                   "F100.", "G40 ", "T1 M6\n", "(", "M30\n"};
      const size_t at = begin + below(end - begin + 1);
      return {at, at, typed[below(std::size(typed))]};
    }
    case 6: { // some bytes are rubbed out
      const size_t at = begin + below(end - begin + 1);
      return {at, std::min(text.size(), at + below(12)), ""};
    }
    default: // some lines go at once, or come
      if (text.size() < program_.size()) {
        const auto [from, to] = line(program_, below(program_.size()));
        return {begin, begin,
                program_.substr(from, std::min(program_.size(), to + below(800)) - from)};
      }
      return {begin, std::min(text.size(), end + below(400)), ""};
    }
  }

private:
  size_t below(size_t limit) { return limit == 0 ? 0 : size_t(random_()) % limit; }
  static std::pair<size_t, size_t> line(const std::string &text, size_t at) {
    const size_t front = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
    const size_t begin = front == std::string::npos ? 0 : front + 1;
    const size_t end = text.find('\n', at);
    return {begin, end == std::string::npos ? text.size() : end + 1};
  }

  std::mt19937 random_;
  std::string program_;
};

} // namespace ncvet::test
