// Where the name at a place of a document is defined, in this file or in another one.
#pragma once

#include "lsp/features/names.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

/// Where a name leads.
struct NameTarget {
  FileUnit *unit = nullptr;
  const ProgramInfo *program = nullptr; ///< the one that holds the place, or that the name means
  SourceRange name;                     ///< empty at the program's begin when it has no header
};

/// The definition of `one`, a name of the file `from` of the snapshot's project; none for names
/// that nothing within reach defines.
std::optional<NameTarget> targetOf(Snapshot &snapshot, FileUnit &from, const Occurrence &one);

/// Whether the name is one of those that other files may define or use: programs, and subprograms
/// between brackets.
bool isShared(const Occurrence &one);

struct DefinedPlace {
  SourceRange origin; ///< the name that was asked for
  SourceRange name;   ///< where it is defined; empty at the begin of a program without a header
  SourceRange block;  ///< the block that holds it
};

/// Definition of the name at the byte `offset` of the document. None: there is no name, or what it
/// means only the run decides (`GOTO #1`).
std::optional<DefinedPlace> definition(Snapshot &snapshot, uint32_t offset);

/// Where this file says that the name exists elsewhere, `EXTERN HOLE`; else its definition.
std::optional<SourceRange> declaration(Snapshot &snapshot, uint32_t offset);

} // namespace ncvet::lsp
