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

/// Two letters that are next to each other have changed places: `SQTR`.
static bool areSwapped(llvm::StringRef one, llvm::StringRef other) {
  if (one.size() != other.size())
    return false;
  size_t at = 0;
  while (at < one.size() && one[at] == other[at])
    ++at;
  return at + 1 < one.size() && one[at] == other[at + 1] && one[at + 1] == other[at] &&
         one.drop_front(at + 2) == other.drop_front(at + 2);
}

bool isMisspeltFunction(llvm::StringRef upper) {
  // Functions that look like another one.
  for (const char *other : {"ASIN", "ACOS", "ATAN2", "MINVAL", "MAXVAL", "BOUND", "AC", "IC", "DC",
                            "ACP", "ACN", "CROT", "CROTS", "SPI", "POSM"})
    if (upper == other)
      return false;
  for (const char *function : {"SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN2", "SQRT", "ABS", "POT",
                               "TRUNC", "ROUND", "ROUNDUP", "EXP", "MINVAL", "MAXVAL"})
    if (upper.size() > 2 &&
        (upper.edit_distance(function, true, 1) == 1 || areSwapped(upper, function)))
      return true;
  return false;
}

} // namespace ncvet
