// Names of a program text: where each is defined, and every place that uses it.
#pragma once

#include "lsp/features/occurrence.h"

namespace ncvet::lsp {

/// All names of one file, found in one pass over its blocks. Bounded by the text: an occurrence
/// takes 24 bytes. One thread at a time may ask.
class Names {
public:
  explicit Names(const FileUnit &unit);

  /// In the order of the text.
  llvm::ArrayRef<Occurrence> all() const { return all_; }
  /// Occurrence at the byte `offset`, one that ends there included, and one whose address letter or
  /// mark is there (the N of `N10`); null: there is none.
  const Occurrence *at(uint32_t offset) const;
  /// Occurrences of the same name, ascending, as indices into `all()`; itself included.
  llvm::ArrayRef<uint32_t> same(const Occurrence &one) const;
  /// Those within [begin, end).
  llvm::ArrayRef<Occurrence> within(uint32_t begin, uint32_t end) const;
  /// Where the name is defined in this file, of several places the one that the control finds from
  /// `one`: a definition, else for a variable the first place that writes it. Null: nowhere here.
  const Occurrence *definition(const Occurrence &one) const;
  /// Of a profile's or section's last block the name of its first one beside it; null: none.
  const Occurrence *firstOf(const Occurrence &last) const;
  llvm::StringRef text(const Occurrence &one) const {
    return unit_.source.text().slice(one.begin, one.end);
  }
  SourceRange range(const Occurrence &one) const { return {unit_.source.id(), one.begin, one.end}; }
  /// Programs first, in the order of the text.
  llvm::ArrayRef<Scope> scopes() const { return scopes_; }
  /// By program.
  const UntoldNames &untold(uint32_t program) const { return untold_[program]; }
  const FileUnit &unit() const { return unit_; }
  /// Index of the program that holds `offset`.
  uint32_t programAt(uint32_t offset) const;

private:
  const FileUnit &unit_;
  std::vector<Occurrence> all_;
  std::vector<Scope> scopes_;
  std::vector<UntoldNames> untold_;
  mutable std::vector<uint32_t> byName_; ///< made when first asked for
};

} // namespace ncvet::lsp
