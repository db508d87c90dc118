// Where completions come from: each function adds the items of one kind.
#pragma once

#include "lsp/features/cursor_context.h"
#include "lsp/features/snapshot.h"
#include "lsp/features/word_use.h"
#include "lsp/features/writing/completion_item.h"

namespace ncvet::lsp {

/// What all sources look at, and where their items go.
struct CompletionRequest {
  Snapshot &snapshot;
  const CursorContext &context;
  const ExecutedBlock &executed; ///< the block as far as it is written
  SourceRange replace;           ///< what an item replaces
  llvm::StringRef typed;         ///< the text there
  std::vector<CompletionItem> &items;

  const Dialect &dialect() const { return snapshot.dialect(); }
  /// Adds an item that begins with what is typed.
  void add(CompletionItem item) const;
};

// completion_codes.cpp
/// Codes that the block may have beside those that it has.
void completeCodes(const CompletionRequest &request);
/// Words that codes of the block read, and what else the block may name.
void completeWords(const CompletionRequest &request);

// completion_names.cpp
/// Blocks of the program, by number and label.
void completeTargets(const CompletionRequest &request);
/// Variables that the program or the control knows.
void completeVariables(const CompletionRequest &request);
/// Programs of this file and of its folder.
void completePrograms(const CompletionRequest &request, bool byNumber);
/// Words that begin a statement.
void completeStatements(const CompletionRequest &request);

/// A placeholder of a snippet: `${1:depth}`.
std::string placeholder(unsigned number, llvm::StringRef text);
/// Text that means itself in a snippet.
std::string snippetText(llvm::StringRef text);

} // namespace ncvet::lsp
