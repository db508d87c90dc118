// Names that the language of a control has for its modes.
#pragma once

#include "formats/dialect/dialect.h"

namespace ncvet {

/// Whether `name` is a code of a group: `ROT`, `CFTCP`. Names of cycles and procedures are none.
inline bool isModeName(llvm::StringRef name, const Dialect &dialect) {
  const CodeIndex code = name.empty() ? noCode : dialect.keyword(name);
  return code != noCode && dialect.codes[code].group != noGroup &&
         dialect.codes[code].action != Action::Cycle && !dialect.codes[code].isProgram;
}

} // namespace ncvet
