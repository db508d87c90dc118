// Many regular expressions, looked for in one pass over a line.
#pragma once

#include "llvm/ADT/SmallVector.h"
#include "llvm/ADT/StringRef.h"
#include "llvm/Support/Error.h"

#include <memory>

namespace ncvet {

/// Extended regular expressions of POSIX (without back references), each with the number that `add`
/// gave it. Made once; then `matching` may be asked by several threads.
class PatternSet {
public:
  PatternSet();
  PatternSet(PatternSet &&other) noexcept;
  PatternSet &operator=(PatternSet &&other) noexcept;
  ~PatternSet();

  /// Numbers count from 0. The error says what is wrong with the expression.
  llvm::Expected<size_t> add(llvm::StringRef pattern);
  /// Ends the adding. An error when all expressions together need too much memory.
  llvm::Error compile();
  /// Numbers of the expressions that match somewhere in `line`, in no order.
  llvm::SmallVector<int, 16> matching(llvm::StringRef line) const;

private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

} // namespace ncvet
