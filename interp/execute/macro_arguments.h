// The arguments of a macro call.
#pragma once

#include "interp/state/event.h"
#include "interp/value/macro_argument.h"

namespace ncvet {

/// Calls `take(variable, word)` for the words of a macro call that are arguments, in their order.
/// `code`: the word of the call. Repeated I, J, K sets count on: I4 J5 K6 I7 J8 K9 …
template <typename Take>
void forEachArgument(const Block &block, const Word &code, Take take) {
  unsigned sets[3] = {0, 0, 0};
  bool second = false;
  for (const Word &word : block.words)
    if (word.address >= letterAddress('I') && word.address <= letterAddress('K'))
      second |= ++sets[word.address - letterAddress('I')] > 1;
  sets[0] = sets[1] = sets[2] = 0;
  for (const Word &word : block.words) {
    if (word.address >= 26 || &word == &code || word.offset < code.offset)
      continue;
    const char letter = char('A' + word.address);
    if (letter == 'P' || letter == 'L' || letter == 'G' || letter == 'N' || letter == 'O')
      continue;
    uint32_t variable = macroArgument(letter);
    if (second && letter >= 'I' && letter <= 'K')
      variable = 4 + 3 * sets[letter - 'I']++ + uint32_t(letter - 'I');
    if (variable && variable <= 33)
      take(variable, word);
  }
}

/// Whether the block is nothing but a call of a subprogram between brackets, or the end of one that
/// gives no value back.
bool isBracketFlow(const Block &block);

/// Whether a block that was executed is a call or a return of which nothing but the arguments of a
/// macro depends on numbers.
bool isKnownFlow(const Dialect &dialect, const Block &block, const Outcome &outcome);

/// Gives the arguments of such a call of `outcome` the numbers that they have in this state; false,
/// and all stay as they are: one of them is not known, or the block would change the state.
bool computeArguments(const Block &block, const MachineState &state, Outcome &outcome);

} // namespace ncvet
