// The parts of a program text that people speak of: tool sections, operations, profiles, loops.
#pragma once

#include "lsp/features/names.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

enum class PartKind : uint8_t {
  Program,
  Subprogram, ///< between brackets, or from a block that a local call names to its return
  Tool,       ///< from a tool change to the next one, or to the program's end
  Profile,    ///< the blocks that a cycle works along
  Loop,       ///< with the brackets around it: loops, and IF with all its branches
  Branch,     ///< from IF or ELSE to the bracket that ends the branch
  Operation,  ///< a cycle; a modal one to the block that ends it
  Label,      ///< the block alone
  Generated,  ///< a block of many lines that a dialog of the control wrote
  Comments    ///< lines of comments, one below the other
};

/// Bytes [begin, end) from the first byte of a part's first block to after its last one's code,
/// line ends not counted.
struct Part {
  PartKind kind = PartKind::Program;
  uint32_t begin = 0, end = 0;
  uint32_t nameBegin = 0, nameEnd = 0; ///< what names it: the T word, the label; inside the part
  uint32_t noteBegin = 0, noteEnd = 0; ///< the comment beside it, with its marks; equal: none
  CodeIndex code = noCode;             ///< of an operation
  uint32_t closing = 0;                ///< of a loop or branch: begin of the block that ends it
};

/// Most operations, labels and comments that are gathered: a list for people has an end.
constexpr size_t mostParts = 20000;

/// The document's parts but loops and branches, by their begin, outer ones first. One pass over
/// the text; parts of different kinds may overlap.
std::vector<Part> partsOf(Snapshot &snapshot);
/// Its loops and branches in the same order.
std::vector<Part> structuresOf(Snapshot &snapshot);

/// The text of a comment without its marks and outer blanks, made valid UTF-8.
std::string noteText(const SourceFile &source, uint32_t begin, uint32_t end);

} // namespace ncvet::lsp
