// One item of a completion.
#pragma once

#include "formats/text/source.h"

#include <string>

namespace ncvet::lsp {

enum class CompletionKind : uint8_t {
  Code,      ///< `G01`, `TRANS`, `CYCLE81`
  Word,      ///< an address
  Parameter, ///< a word or variable that a code of the block reads
  Keyword,   ///< a statement
  Label,     ///< a block, by its number or label
  Variable,
  Program
};

struct CompletionItem {
  std::string label;
  std::string detail;        ///< one line
  std::string documentation; ///< id for `completionHelp`; empty: there is none
  std::string insert;        ///< text; with `${1:name}` and `$0` when it is a snippet
  bool snippet = false;
  CompletionKind kind = CompletionKind::Code;
  uint8_t rank = 0; ///< lower ones are more likely
  SourceRange replace;
};

} // namespace ncvet::lsp
