// The codes that begin and end what is in force, by the names that messages and fixes give them.
#include "analyzer/facts/ending_code.h"

#include "analyzer/facts/lookahead.h"

namespace ncvet {

const CodeInfo *firstCodeWith(const Dialect &dialect, Action action) {
  const auto at =
      llvm::find_if(dialect.codes, [&](const CodeInfo &code) { return code.action == action; });
  return at == dialect.codes.end() ? nullptr : &*at;
}

static std::string nameOf(const CodeInfo *code) { return code ? code->name : std::string(); }

std::string compensationName(const Dialect &dialect, const MachineState &state) {
  const CodeInfo *code = state.activeCode(dialect, StandardGroup::Compensation);
  return code ? "`" + code->name + "`" : "compensation";
}

std::string cancelOf(const Dialect &dialect, const CodeInfo &cycle) {
  if (cycle.opposite != noCode)
    return dialect.codes[cycle.opposite].name;
  const CodeInfo *cancel =
      makesHole(cycle.cycle) ? firstCodeWith(dialect, Action::CycleCancel) : nullptr;
  return nameOf(cancel ? cancel : firstCodeWith(dialect, Action::Rapid));
}

std::string compensationOffCode(const Dialect &dialect, const MachineState &state) {
  const CodeInfo *active = state.activeCode(dialect, StandardGroup::Compensation);
  return active && active->opposite != noCode
             ? dialect.codes[active->opposite].name
             : nameOf(firstCodeWith(dialect, Action::CompensationOff));
}

std::string returnOf(const Dialect &dialect) {
  const auto code = llvm::find_if(
      dialect.codes, [](const CodeInfo &c) { return c.action == Action::Return && c.letter; });
  return nameOf(code == dialect.codes.end() ? firstCodeWith(dialect, Action::Return) : &*code);
}

} // namespace ncvet
