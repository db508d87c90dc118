// Which program calls which, by the text: every call that is written, whether it is reached or not.
#pragma once

#include "lsp/features/parts.h"

namespace ncvet::lsp {

/// A program, a subprogram between brackets, or the blocks that local calls name.
struct CallItem {
  PartKind kind = PartKind::Program; ///< Program or Subprogram
  std::string name;
  std::string detail;    ///< its comment
  SourceRange full;      ///< of any file of the snapshot's project
  SourceRange selection; ///< its name, inside `full`; names the item in later questions
};

struct CallEdge {
  CallItem item;                   ///< who calls, or who is called
  std::vector<SourceRange> places; ///< of the calls, in the caller's file
};

/// The item that the name at `offset` means, else the one whose blocks are there. None only in a
/// text without a program.
std::optional<CallItem> callItem(Snapshot &snapshot, uint32_t offset);

/// Calls that the item makes whose name is at `offset` of the file at `path`.
std::vector<CallEdge> outgoingCalls(Snapshot &snapshot, llvm::StringRef path, uint32_t offset);

/// Calls of that item in its own file, in the document and in the files `paths`.
std::vector<CallEdge> incomingCalls(Snapshot &snapshot, llvm::StringRef path, uint32_t offset,
                                    llvm::ArrayRef<std::string> paths = {});

} // namespace ncvet::lsp
