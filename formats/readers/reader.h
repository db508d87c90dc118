// The interface of all readers: a cursor over text that makes blocks.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/readers/block.h"

#include <functional>
#include <memory>
#include <string>

namespace ncvet {

/// Reads blocks of one text. Stateless: the same offset gives the same block, whatever was read
/// before. Never fails: bad text becomes a `SyntaxIssue` and reading goes on at the next word.
class Reader {
public:
  virtual ~Reader() = default;
  /// Reads the block that begins at `offset` into `block`, whose storage is reused. `offset` must
  /// be a block's beginning and inside the text.
  virtual void read(uint32_t offset, Block &block) const = 0;
  /// What identifies a label: the same for all its spellings, and for no other label.
  virtual std::string labelKey(llvm::StringRef label) const { return label.upper(); }
  /// Told of the name of one of the control's own programs (`CodeInfo::isProgram`); answers whether
  /// the project has a program of that name, which is called in its place.
  using HidesProgram = std::function<bool(llvm::StringRef)>;
  void setHidesProgram(HidesProgram hides) { hides_ = std::move(hides); }
  bool isHidden(llvm::StringRef name) const { return hides_ && hides_(name); }
  llvm::StringRef text() const { return text_; }
  /// Offset of the first block (after a byte order mark).
  uint32_t first() const { return text_.startswith("\xEF\xBB\xBF") ? 3 : 0; }

protected:
  explicit Reader(llvm::StringRef text) : text_(text) {}
  llvm::StringRef text_;

private:
  HidesProgram hides_;
};

} // namespace ncvet
