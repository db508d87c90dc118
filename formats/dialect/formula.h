// Formulas of the tables: what must hold between the words of a code's format.
#pragma once

#include "formats/dialect/address.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/StringRef.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ncvet {

/// Operations of a formula in postfix order.
enum class FormulaOp : uint8_t {
  Number,
  Word,    ///< value of word `index` of the code's format
  Address, ///< value of the block's word with address `index`
  Given,   ///< whether word `index` of the format is there
  GivenAddress,
  Variable,      ///< value of the variable whose key is `number`: `$NAME`
  GivenVariable, ///< whether it has one
  Element,       ///< value of the variable `names[index]` at the place on top: `$NAME[x]`
  ToolRadius,    ///< of the tool in use, by the machine profile
  Tool,          ///< number of the tool in use
  Edge,          ///< number of its edge in force, 0 without one
  Level,         ///< place along the tool axis before the block
  Feed,          ///< F in force before the block
  Speed,         ///< S in force before the block
  Length,        ///< characters of word `index` of the code's format
  Here,          ///< whether that word is in the block itself
  Bare,          ///< whether the block's word with address `index` has no value
  Note,          ///< characters of the block's comment for the operator; 0: there is none
  Place,         ///< of axis `index` before the block
  Origin,        ///< number of the work offset in force: 3 of G54.03
  Index,         ///< of the place in a pattern, from 0
  Option,        ///< number of the machine profile's option `names[index]`
  Increment,     ///< least increment of a length in the program's unit: 0.001 mm, 0.0001 inch
  Unknown,       ///< a value that no reference gives
  Add,
  Subtract,
  Multiply,
  Divide,
  Negate,
  Absolute,
  Floor,
  Sine, ///< of degrees
  Cosine,
  SquareRoot,
  Minimum,
  Maximum,
  Less,
  LessEqual,
  Equal,
  NotEqual,
  And,
  Or,
  Not,
  Select ///< the second operand where the first holds, else the third
};

struct FormulaStep {
  FormulaOp op = FormulaOp::Number;
  uint16_t index = 0;
  double number = 0;
};

/// `given(DP) and given(DPR) and abs(RFP - DPR - DP) > 0.001`. Empty: no condition.
struct Formula {
  std::vector<FormulaStep> steps;
  std::vector<std::string> names; ///< of options, and of several variables

  bool empty() const { return steps.empty(); }
};

/// What a name in a formula means; none: it is not known.
struct FormulaName {
  FormulaOp word = FormulaOp::Word; ///< `Word` or `Address`
  uint16_t index = 0;
};

/// Reads `text`: numbers, names, `+ - * /`, `< <= > >= == !=`, `and or not`, parentheses,
/// `$NAME` for a variable of the program, `$NAME[x]` for one of several, `abs(x) min(x,y) max(x,y)
/// floor(x) sqrt(x) sin(x) cos(x) select(x,y,z) index() increment() unknown() given(NAME)
/// toolRadius() tool() edge() level() feed() speed() note() origin() key(SYMBOL) option(NAME)
/// length(NAME) here(NAME) bare(ADDRESS) place(AXIS)`. None, with `error` set, when it cannot.
std::optional<Formula>
parseFormula(llvm::StringRef text,
             llvm::function_ref<std::optional<FormulaName>(llvm::StringRef)> name,
             std::string &error);

} // namespace ncvet
