// Names of instructions, which take their arguments after a colon and no value after `=`.
#pragma once

#include "formats/dialect/dialect.h"

#include <set>

namespace ncvet {

/// The names of all instructions in angle brackets, without the first argument that some have in
/// theirs: `DCT` of `<DCT:ON>`.
inline std::set<std::string> instructionNames(const Dialect &dialect) {
  std::set<std::string> names;
  for (const CodeInfo &code : dialect.codes) {
    llvm::StringRef name = code.name;
    if (name.consume_front("<"))
      names.insert(name.take_until([](char c) { return c == ':' || c == '>'; }).str());
  }
  return names;
}

} // namespace ncvet
