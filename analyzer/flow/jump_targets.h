// The blocks that the targets of a jump name.
#pragma once

#include "analyzer/flow/loops.h"
#include "analyzer/program/references.h"

namespace ncvet {

/// Finds blocks by number and label, and goes on at many where only the run knows which.
class JumpTargets {
public:
  JumpTargets(FlowRun &run, Loops &loops) : run_(run), loops_(loops) {}

  /// Offset of the block that `target` names in `program`, looked for from `from` on; none, with an
  /// issue, when there is none.
  std::optional<uint32_t> resolve(const Step &step, FileUnit &unit, const ProgramInfo &program,
                                  const Argument &target, uint32_t from, JumpKind kind);
  /// A jump of which only the run decides where it leads: to any numbered block.
  void anywhere(const Step &step);
  /// Every label and number of the block's jumps is in use, wherever this time's values lead.
  void note(const Step &step);

private:
  std::optional<uint32_t> resolveNumber(const Step &step, FileUnit &unit,
                                        const ProgramInfo &program, const Argument &target,
                                        uint32_t from, JumpKind kind, bool &computed);
  void anyLabel(const Step &step, const Argument &target, JumpKind kind);
  void tooMany(const Step &step);
  void useLabel(const FileUnit &unit, std::string key);

  FlowRun &run_;
  Loops &loops_;
};

} // namespace ncvet
