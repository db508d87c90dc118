// The codes that begin and end what is in force, by the names that messages and fixes give them.
#include "analyzer/facts/ending_code.h"

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

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

std::string returnHere(const RuleContext &ctx) {
  Block head;
  readBlockAt(ctx.source(), ctx.index().reader(), ctx.index().programAt(ctx.block().begin).begin,
              head);
  if (head.items.empty() || head.items[0].kind != ItemKind::Structure ||
      head.items[0].structure != Structure::Sub)
    return returnOf(ctx.dialect());
  const Item &sub = head.items[0];
  const llvm::StringRef text = ctx.source().text(sub.begin, sub.end);
  const size_t name = sub.nameEnd - sub.begin; // its end; the bracket of a name follows
  return (text.take_front(name + text.substr(name).startswith(">")) + " return").str();
}

} // namespace ncvet
