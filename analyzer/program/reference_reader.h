// What the blocks of a program refer to: the programs that they call, the blocks that they jump to,
// repeat, return to or run as a profile.
#pragma once

#include "analyzer/program/program_index.h"
#include "formats/dialect/dialect.h"

namespace ncvet {

/// What control does with the place that a reference names.
enum class ReferenceKind : uint8_t {
  Call,   ///< runs it and comes back, or reads it as a contour
  Jump,   ///< goes there
  Return, ///< goes there in the caller
  First,  ///< first block of a profile, of a section that runs again, or of the called program
  Last    ///< last block of a profile or section
};

/// What a reference names.
enum class ReferredKind : uint8_t {
  Program,       ///< by its number
  NamedProgram,  //
  Subprogram,    ///< between brackets of structured flow
  Block,         ///< by its number
  Label,         //
  UntoldProgram, ///< only the run decides which one
  UntoldBlock
};

struct Reference {
  ReferenceKind kind = ReferenceKind::Call;
  ReferredKind to = ReferredKind::UntoldProgram;
  Search search = Search::Anywhere; ///< of a block: where it is looked for
  bool inCalled = false;            ///< a block of the program that the reference before it names
  int64_t number = -1;              ///< of the program or block
  int64_t runs = 1;                 ///< of a call; 0: not known
  bool packed = false;              ///< the number may have a count before that of the program
  /// Its spelling, a part of the file's text: a number without address, a label without marks. Of
  /// an untold one empty, where it is.
  llvm::StringRef text;

  /// A block of the program, by its number or by its label.
  static Reference toBlock(int64_t number, Search search = Search::Anywhere);
  static Reference toLabel(llvm::StringRef label, Search search = Search::Anywhere);
};

/// Direction in which the target `target` of a jump `item` is looked for.
JumpKind searchKind(const Item &item, const Argument &target);
Search searchOf(JumpKind kind);

/// Reads references as the text says them. The words and items that hold some are made out once.
class ReferenceReader {
public:
  using Visit = llvm::function_ref<void(const Reference &)>;

  explicit ReferenceReader(const Dialect &dialect);

  /// Those in the words of `block`, a block of `text`.
  void words(const Block &block, llvm::StringRef text, Visit visit) const;
  /// Those of one of its items.
  void item(const Block &block, const Item &item, llvm::StringRef text, Visit visit) const;
  void all(const Block &block, llvm::StringRef text, Visit visit) const {
    words(block, text, visit);
    for (const Item &one : block.items)
      item(block, one, text, visit);
  }

private:
  /// What a code's words name, those of its variants included.
  struct CodeWords {
    Action action = Action::None;
    AddressMask first = 0, last = 0; ///< blocks of a profile
    AddressMask sequence = 0;        ///< a block to jump to
    unsigned contour = 0;            ///< argument that names a contour, from 1; 0: none
    bool any = false;
    void take(const CodeInfo &code);
  };

  const Dialect &dialect_;
  std::vector<CodeWords> codes_; ///< by code
  friend class BlockReferences;
};

} // namespace ncvet
