// Evaluates the formulas of the tables on a block and the state before it.
#pragma once

#include "interp/evaluate/condition_context.h"
#include "interp/value/value.h"

namespace ncvet {

/// Whether `formula` holds; unknown as soon as a value that decides it is not known. `code` is the
/// code whose words the formula names.
Truth truthOf(const Formula &formula, const CodeInfo &code, const ConditionContext &context);
/// Value of `formula`; none when a word that it names is not given.
std::optional<Interval> valueOf(const Formula &formula, const CodeInfo &code,
                                const ConditionContext &context);

/// The same of a formula that may do without some of its words: none when the missing ones decide.
std::optional<Interval> valueOfGiven(const Formula &formula, const CodeInfo &code,
                                     const ConditionContext &context);

/// Key of the variable at a place of several with one name: `_RADIUS[5]`.
uint64_t elementOf(llvm::StringRef list, double place);

/// Value of a formula in which words that are not given count as not known.
Interval levelOf(const Formula &formula, const CodeInfo &code, const ConditionContext &context);

} // namespace ncvet
