// Texts that a program shows to the operator.
#pragma once

#include "analyzer/program/project.h"

#include <string>
#include <vector>

namespace ncvet {
struct MachineState; // interp/state/state.h
}

namespace ncvet::dap {

struct OperatorMessage {
  std::string text;
  uint32_t offset = 0; ///< where it is written
};

/// What `block` shows to the operator when it is executed in `state`: comments and instructions as
/// the facts of the control's table have it, and comments after a value of a variable for messages.
std::vector<OperatorMessage> messagesOf(const FileUnit &unit, const Block &block,
                                        const MachineState &state);

/// Whether the block gives a variable a value that stops the program with a message.
bool stopsWithMessage(const FileUnit &unit, const Block &block);

} // namespace ncvet::dap
