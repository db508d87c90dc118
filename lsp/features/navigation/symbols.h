// The outline of a document: its programs, and in them tools, operations, subprograms and labels.
#pragma once

#include "lsp/features/parts.h"

namespace ncvet::lsp {

struct Symbol {
  PartKind kind = PartKind::Program; ///< Program, Subprogram, Tool, Operation or Label
  std::string name;                  ///< never empty: "O01000", "T0101 ROUGH", "G83"
  std::string detail;                ///< comment or title
  SourceRange full, selection;       ///< the second one lies inside the first
  std::vector<Symbol> children;      ///< ascending, inside `full`
};

/// At most `mostParts` symbols.
std::vector<Symbol> documentSymbols(Snapshot &snapshot);

/// A symbol that is looked for among those of many files.
struct NamedSymbol {
  PartKind kind = PartKind::Program; ///< Program, Subprogram or Label
  std::string name;
  std::string container; ///< name of the program that holds it; empty for programs
  SourceRange selection;
};

/// Programs, subprograms and labels whose names contain `query`, in capitals or not.
std::vector<NamedSymbol> workspaceSymbols(Snapshot &snapshot, llvm::StringRef query);

} // namespace ncvet::lsp
