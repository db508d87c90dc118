// Functions of Sinumerik expressions.
#include "formats/readers/sinumerik/sinumerik_functions.h"

#include "llvm/ADT/StringSwitch.h"

namespace ncvet {

Op sinumerikFunction(llvm::StringRef upper) {
  return llvm::StringSwitch<Op>(upper)
      .Case("SIN", Op::Sin)
      .Case("COS", Op::Cos)
      .Case("TAN", Op::Tan)
      .Case("ASIN", Op::Asin)
      .Case("ACOS", Op::Acos)
      .Case("SQRT", Op::Sqrt)
      .Case("ABS", Op::Abs)
      .Case("POT", Op::Square)
      .Case("TRUNC", Op::Truncate)
      .Case("ROUND", Op::Round)
      .Case("ROUNDUP", Op::Fup)
      .Case("LN", Op::Ln)
      .Case("EXP", Op::Exp)
      .Default(Op::Unknown);
}

bool isMisspeltFunction(llvm::StringRef upper) {
  // Functions that look like another one.
  for (const char *other : {"ASIN", "ACOS", "ATAN2", "MINVAL", "MAXVAL", "AC", "IC", "DC", "ACP",
                            "ACN", "CROT", "CROTS", "SPI", "POSM"})
    if (upper == other)
      return false;
  for (const char *function : {"SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN2", "SQRT", "ABS", "POT",
                               "TRUNC", "ROUND", "ROUNDUP", "EXP", "MINVAL", "MAXVAL"})
    if (upper.size() > 2 && upper.edit_distance(function, true, 1) == 1)
      return true;
  return false;
}

} // namespace ncvet
