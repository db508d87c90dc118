// Expressions that the user writes while a program is stopped, read and evaluated as the control
// does.
#pragma once

#include "analyzer/program/project.h"
#include "formats/readers/block.h"
#include "interp/value/value.h"

#include "llvm/Support/Error.h"

namespace ncvet {
struct MachineState; // interp/state/state.h
}

namespace ncvet::dap {

/// An expression in the language of a control, `#101 GT 5` or `R1>5`. Signs of comparison are
/// understood where the control has words for them: `#101 > 5`.
class WatchExpression {
public:
  /// An error says that the control reads no expression in `text`.
  static llvm::Expected<WatchExpression> parse(const FileUnit &unit, llvm::StringRef text);

  Value evaluate(const MachineState &state) const;

private:
  WatchExpression(Block block, uint16_t index) : block_(std::move(block)), index_(index) {}

  Block block_;
  uint16_t index_;
};

/// Executes `name = value` in the state, as a block of the program would; of the state only
/// variables change. An error says that the control reads no assignment in it, or that the variable
/// cannot be written.
llvm::Error assign(const FileUnit &unit, MachineState &state, llvm::StringRef name,
                   llvm::StringRef value);

/// `12.5`, `1 to 5`, `not set`, `unknown`.
std::string valueText(const Value &value);
std::string valueText(const Interval &value);

} // namespace ncvet::dap
