// The codes that end what is in force, for messages and fixes.
#include "analyzer/facts/ending_code.h"

#include "analyzer/facts/lookahead.h"

namespace ncvet {

namespace {

/// The first code with that action; null when the control has none.
const CodeInfo *firstWith(const Dialect &dialect, Action action) {
  const auto at =
      llvm::find_if(dialect.codes, [&](const CodeInfo &code) { return code.action == action; });
  return at == dialect.codes.end() ? nullptr : &*at;
}

std::string nameOf(const CodeInfo *code) { return code ? code->name : std::string(); }

} // namespace

std::string cancelOf(const Dialect &dialect, const CodeInfo &cycle) {
  if (cycle.opposite != noCode)
    return dialect.codes[cycle.opposite].name;
  const CodeInfo *cancel =
      makesHole(cycle.cycle) ? firstWith(dialect, Action::CycleCancel) : nullptr;
  return nameOf(cancel ? cancel : firstWith(dialect, Action::Rapid));
}

std::string compensationOffCode(const Dialect &dialect, const MachineState &state) {
  const CodeInfo *active = state.activeCode(dialect, StandardGroup::Compensation);
  return active && active->opposite != noCode ? dialect.codes[active->opposite].name
                                              : nameOf(firstWith(dialect, Action::CompensationOff));
}

std::string returnOf(const Dialect &dialect) {
  const auto code = llvm::find_if(
      dialect.codes, [](const CodeInfo &c) { return c.action == Action::Return && c.letter; });
  return nameOf(code == dialect.codes.end() ? firstWith(dialect, Action::Return) : &*code);
}

} // namespace ncvet
