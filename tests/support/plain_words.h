// Words that readers stumble over, and that pages and documents therefore do without.
#pragma once

#include "llvm/ADT/StringExtras.h"

#include <string>
#include <vector>

namespace ncvet::test {

/// The text of a Markdown page without its code, in small letters, one blank between words.
inline std::string proseOf(llvm::StringRef page) {
  std::string prose = " ";
  bool fenced = false, code = false, source = false;
  while (!page.empty()) {
    llvm::StringRef line;
    std::tie(line, page) = page.split('\n');
    if (line.startswith("```"))
      fenced = !fenced;
    source = line.startswith("Source:") || (source && !line.empty()); // names of other works
    if (fenced || source || line.startswith("    ") || line.startswith("#"))
      continue;
    for (const char c : line) {
      if (c == '`')
        code = !code;
      if (!code)
        prose += llvm::isAlpha(c) || c == '-' ? llvm::toLower(c) : ' ';
    }
    prose += ' ';
  }
  std::string single;
  for (const char c : prose)
    if (c != ' ' || single.empty() || single.back() != ' ')
      single += c;
  return single;
}

/// What of it is to be said in another word: "after" for "behind", "before" for "in front of", "is"
/// for "stands", "current" for "at hand".
inline std::vector<std::string> hardWords(llvm::StringRef page) {
  const std::string prose = proseOf(page);
  std::vector<std::string> found;
  for (const char *word : {" behind ", " in front of ", " stands ", " at hand "})
    if (prose.find(word) != std::string::npos)
      found.emplace_back(word);
  return found;
}

/// A source in small letters with its names taken apart: `behindLineBlanks` is " behind line blanks
/// ".
inline std::string namesApart(llvm::StringRef source) {
  std::string words = " ";
  bool small = false; // the letter before
  for (const char c : source) {
    const bool letter = llvm::isAlpha(c), capital = letter && llvm::toLower(c) != c;
    if (!letter || (capital && small))
      words += ' ';
    if (letter)
      words += llvm::toLower(c);
    small = letter && !capital;
  }
  return words + ' ';
}

/// What of the names of a source is to be said in another word.
inline std::vector<std::string> hardNames(llvm::StringRef source) {
  const std::string words = namesApart(source);
  std::vector<std::string> found;
  for (const char *word : {" behind ", " in front ", " stands ", " at hand "})
    if (words.find(word) != std::string::npos)
      found.emplace_back(word);
  return found;
}

} // namespace ncvet::test
