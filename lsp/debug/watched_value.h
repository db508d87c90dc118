// What a breakpoint looks at: an expression of the control, or a letter of which the machine has a
// value.
#pragma once

#include "interp/evaluate/operators.h"
#include "lsp/debug/watch_expression.h"

#include <optional>

namespace ncvet::dap {

/// The value of an axis, or of a letter that says what is in force; none: the text is no such
/// letter.
std::optional<Value> letterValue(llvm::StringRef text, const MachineState &state);

/// `#101`, `R1*2`, `X`.
class WatchedValue {
public:
  /// An error says that the text is neither.
  static llvm::Expected<WatchedValue> parse(const FileUnit &unit, llvm::StringRef text);
  Value evaluate(const MachineState &state) const;

private:
  std::string letter_; ///< empty: it is an expression
  std::optional<WatchExpression> expression_;
};

/// `#101 GT 5`, `Z < 0`, `T == 3`.
class WatchedCondition {
public:
  /// An error says that the text is no condition.
  static llvm::Expected<WatchedCondition> parse(const FileUnit &unit, llvm::StringRef text);
  Truth holds(const MachineState &state) const;

private:
  WatchedValue left_; ///< a condition by itself when there is no sign
  Operator compares_ = Operator::Equal;
  std::optional<WatchedValue> right_;
};

} // namespace ncvet::dap
