// One pass over the blocks of a file that gathers its names.
#pragma once

#include "analyzer/program/references.h"
#include "lsp/features/occurrence.h"

#include "llvm/ADT/DenseSet.h"
#include "llvm/ADT/StringExtras.h"

#include <algorithm>

namespace ncvet::lsp {

/// What `Names` is made of.
struct FoundNames {
  std::vector<Occurrence> all; ///< in the order of the text
  std::vector<Scope> scopes;
  std::vector<UntoldNames> untold; ///< by program
};

/// Reads the names of a file's blocks, one block after the other: all that the engine would follow
/// or evaluate, as the reader gives it.
class NamePass {
public:
  explicit NamePass(const FileUnit &unit)
      : unit_(unit), dialect_(*unit.dialect), text_(unit.source.text()), references_(dialect_) {}

  FoundNames find();

private:
  struct Return {
    size_t occurrence;
    uint32_t program;
  };

  void block();
  void header();
  void numberAndLabel();
  void words();
  void reference(const Reference &reference);
  void tool(const Word &word);
  void elements();
  void item(const Item &item);
  void assignment(const Item &item);
  void parameters(const Item &item);
  void bracket(const Item &item);
  void operations();
  void finishBlock(size_t first);
  void resolveReturns();
  void scopeVariables();

  Occurrence &add(NameKind kind, NameUse use, uint64_t key, uint32_t begin, uint32_t end,
                  uint32_t scope) {
    Occurrence &one = all_.emplace_back();
    one.kind = kind;
    one.use = use;
    one.key = key;
    one.begin = begin;
    one.end = std::max(begin, end);
    one.scope = scope;
    return one;
  }
  void addProgram(NameUse use, uint32_t begin, uint32_t end);
  void addVariable(NameUse use, uint64_t key, uint32_t begin, uint32_t end) {
    if (key)
      add(NameKind::Variable, use, key, begin, end, isOwn(key) ? scope_ : wholeFile);
  }
  /// Whether a variable belongs to the running program, by its key alone.
  bool isOwn(uint64_t key) const {
    return key < firstSharedVariable ? key <= uint64_t(dialect_.variableRanges.lastLocal)
                                     : key >= firstNamedVariable && isNamedLocal();
  }
  bool isNamedLocal() const { return dialect_.variableRanges.namedLocal; }
  void untold(uint32_t UntoldNames::*what, uint32_t at) {
    uint32_t &place = untold_[program_].*what;
    place = std::min(place, at);
  }
  uint32_t firstDigit(uint32_t begin, uint32_t end) const {
    while (begin < end && !llvm::isDigit(text_[begin]))
      ++begin;
    return begin;
  }
  uint32_t endOfDigits(uint32_t begin) const {
    while (begin < text_.size() && llvm::isDigit(text_[begin]))
      ++begin;
    return begin;
  }
  std::pair<uint32_t, uint32_t> variableAt(uint32_t offset) const;
  uint32_t scopeOf(const ProgramInfo *program) const {
    return uint32_t(program - unit_.index.programs().begin());
  }
  /// Scope of the first program of this file with a key, or `otherFile`.
  uint32_t programOf(uint64_t key) const {
    const auto found = programs_.find(key);
    return found == programs_.end() ? otherFile : found->second;
  }

  const FileUnit &unit_;
  const Dialect &dialect_;
  const llvm::StringRef text_;
  const ReferenceReader references_;
  std::vector<Occurrence> all_;
  std::vector<Scope> scopes_;
  std::vector<UntoldNames> untold_;
  llvm::DenseMap<uint64_t, uint32_t> programs_; ///< by key: by number or by name
  std::vector<Return> returns_;
  uint32_t untoldReturn_ = UntoldNames::nowhere; ///< a return to a computed block of the caller
  llvm::DenseSet<std::pair<uint32_t, uint64_t>> defined_; ///< variables, by program
  llvm::DenseSet<std::pair<uint32_t, uint64_t>> macros_;  ///< by program
  std::vector<bool> callsLocally_;                        ///< by program
  Block block_;
  uint32_t program_ = 0;
  uint32_t scope_ = 0;
  uint32_t called_ = otherFile; ///< scope of the program that the last reference names
};

} // namespace ncvet::lsp
