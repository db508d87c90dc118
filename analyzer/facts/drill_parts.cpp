// The part cycles of a control's dialogs that the machine profile names, each with its drilling
// code.
#include "analyzer/facts/drill_parts.h"

#include "formats/dialect/variable_key.h"

namespace ncvet {

std::map<std::string, CodeIndex> drillParts(const Dialect &dialect, const MachineProfile &machine) {
  std::map<std::string, CodeIndex> parts;
  for (const auto &[name, code] : machine.names("drillParts"))
    if (const CodeIndex index = dialect.find(code); index != noCode)
      parts[llvm::StringRef(name).upper()] = index;
  return parts;
}

CodeIndex codeOfPart(const std::map<std::string, CodeIndex> &parts, const CodeInfo &call,
                     const RuleContext &ctx) {
  for (const WordSpec &spec : call.words) {
    const Word *word = spec.variable ? assignmentOf(ctx.block(), spec.variable) : nullptr;
    const Interval value = word ? ctx.value(*word) : Interval::unknown();
    if (!value.isConstant())
      continue;
    for (const auto &[name, code] : parts)
      if (value.value() == double(variableKey(name)))
        return code;
  }
  return noCode;
}

} // namespace ncvet
