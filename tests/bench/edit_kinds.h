// The kinds of edits that are timed: programs, and what is changed in them.
#pragma once

#include <string>
#include <vector>

namespace ncvet::bench {

/// The bytes [begin, end) of a text become others.
struct Edit {
  size_t begin = 0, end = 0;
  std::string text;
};

/// One way of editing a program.
struct Kind {
  const char *name;
  const char *program; ///< in the folder; null: `make` writes it
  const char *dialect;
  double goal; ///< milliseconds, 99 of 100 edits
  std::string (*make)(std::string text);
  Edit (*edit)(const std::string &text, unsigned turn); ///< every second one takes one back
};

const std::vector<Kind> &editKinds();

/// The text of the program before the first edit.
std::string textOf(const Kind &kind, const std::string &folder);

/// A program of surfacing of this many lines in which a thousand blocks hold a word twice.
std::string surfacingWithFindings(const std::string &folder, size_t lines);

} // namespace ncvet::bench
