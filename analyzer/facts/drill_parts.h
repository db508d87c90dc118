// The part cycles of a control's dialogs that the machine profile names, each with its drilling
// code.
#pragma once

#include "analyzer/rule/rule.h"

#include <map>
#include <string>

namespace ncvet {

/// Option `drillParts`: names of parts, in capitals, and the codes whose parameters they store.
std::map<std::string, CodeIndex> drillParts(const Dialect &dialect, const MachineProfile &machine);

/// The code of the part that the current block names as a value of one of the call's variables;
/// `noCode` when it names none of `parts`.
CodeIndex codeOfPart(const std::map<std::string, CodeIndex> &parts, const CodeInfo &call,
                     const RuleContext &ctx);

} // namespace ncvet
