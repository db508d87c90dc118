// Many regular expressions, looked for in one pass over a line.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/SmallVector.h"
#include "llvm/ADT/StringRef.h"
#include "llvm/Support/Error.h"

#include <memory>
#include <string>
#include <vector>

namespace ncvet {

/// Extended regular expressions of POSIX (without back references), each with the number that `add`
/// gave it, from 0. Made once; then several threads may ask. All of them together are compiled when
/// that pays: for a second text, or a single line. Of the first text most can be told at a glance.
class PatternSet {
public:
  PatternSet();
  PatternSet(PatternSet &&other) noexcept;
  PatternSet &operator=(PatternSet &&other) noexcept;
  ~PatternSet();

  size_t add(llvm::StringRef pattern);
  /// Compiles them now. The error says what is wrong with one, or that all together need too much
  /// memory.
  llvm::Error compile() const;
  /// What is wrong with an expression.
  static llvm::Error check(llvm::StringRef pattern);
  /// Numbers of the expressions that match somewhere in `line`, in no order.
  llvm::SmallVector<int, 16> matching(llvm::StringRef line) const;
  /// By the number of each expression: whether it matches in one of the lines.
  std::vector<bool> inLines(llvm::ArrayRef<std::string> lines) const;

private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

} // namespace ncvet
