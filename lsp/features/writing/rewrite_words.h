// Words that rewritings put in the place of others, spelled as their text is.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/readers/block.h"

#include <string>

namespace ncvet::lsp {

/// The digits of a coordinate: as many decimals as it needs, six at most, of a scaled one those of
/// the unit; a point where the old word has one or the control wants one.
std::string coordinateText(const Dialect &dialect, const Word &word, double value);
/// The same for a word that is new; `pointed`: those around it have a point.
std::string coordinateText(const Dialect &dialect, AddressId address, double value, bool pointed);
/// The address of the coordinate of an axis; `noAddress`: the control has none.
AddressId addressOf(const Dialect &dialect, AddressKind kind, Axis axis);
/// The G code of a group with this action and the least number; null: there is none.
const CodeInfo *codeFor(const Dialect &dialect, StandardGroup group, Action action);
/// The G code of the same group with this action whose number is nearest; null: there is none.
const CodeInfo *counterpart(const Dialect &dialect, const CodeInfo &code, Action action);
/// The code of a G word; null: the table does not know it.
const CodeInfo *gCodeOf(const Dialect &dialect, const Word &word);
/// Its number as it is written after the letter, with leading zeros up to the width of `old`.
std::string codeDigits(const CodeInfo &code, llvm::StringRef old);
/// The bytes of a word after its address.
llvm::StringRef digitsOf(llvm::StringRef text, const Block &block, const Word &word,
                         const Dialect &dialect);

} // namespace ncvet::lsp
