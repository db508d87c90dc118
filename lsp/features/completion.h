// Completion: what may stand at the cursor.
#pragma once

#include "lsp/features/snapshot.h"

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

/// What fits at byte `offset`, the likely first; a few thousand at most. `before` is the state on
/// entry of the block; null: nothing is known.
std::vector<CompletionItem> completions(Snapshot &snapshot, uint32_t offset,
                                        const MachineState *before = nullptr);

/// The documentation of an item, Markdown; empty for an unknown id.
std::string completionHelp(const Dialect &dialect, llvm::StringRef id);

} // namespace ncvet::lsp
