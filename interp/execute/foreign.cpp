// Blocks in the language of another control: what they do is not known.
#include "interp/execute/execution.h"
#include "interp/state/zero_point.h"

namespace ncvet {

bool Execution::inForeignLanguage() const {
  if (masks_.language == noGroup)
    return false;
  const uint64_t now = state_.groups[masks_.language];
  return (now & masks_.foreign) && !(now & groupUnset);
}

/// Whether all words of the block are codes that choose the language.
bool Execution::choosesLanguageOnly() const {
  return block_.items.empty() && llvm::all_of(block_.words, [&](const Word &word) {
           const CodeIndex code = word.isNumber() && word.address == letterAddress('G')
                                      ? dialect_.find('G', word.codeNumber())
                                      : noCode;
           return code != noCode && info({code, &word}).group == masks_.language;
         });
}

/// A block of the other language may set all that a program's caller may; what changes the meaning
/// of all words it takes back before it leads to the control's own language again, as most do.
void Execution::forgetForeign() {
  stateUse.everything();
  MachineState any = calledState(dialect_);
  any.origin = state_.origin;
  any.profile = state_.profile;
  any.modalCalls = state_.modalCalls;
  any.setGroup(masks_.language, state_.groups[masks_.language]);
  state_ = std::move(any);
}

/// Only what leads back to the control's own language counts, what ends the program, and words that
/// no other language has.
void Execution::foreignBlock() {
  outcome_.foreign = true;
  outcome_.setupChanged = true;
  if (block_.isEmpty())
    return;
  if (!choosesLanguageOnly())
    forgetForeign();
  for (const Word &word : block_.words) {
    if (word.address != keywordAddress &&
        (!word.isNumber() ||
         (word.address != letterAddress('G') && word.address != letterAddress('M'))))
      continue;
    const CodeIndex code = word.address == keywordAddress
                               ? CodeIndex(word.mantissa)
                               : dialect_.find(char('A' + word.address), word.codeNumber());
    if (code == noCode)
      continue;
    const CodeUse use{code, &word};
    switch (info(use).action) {
    case Action::ProgramEnd:
    case Action::ProgramEndRewind:
    case Action::Return:
      carryOut(Phase::Flow, use);
      break;
    default:
      break;
    }
    if (info(use).group == masks_.language)
      activate(info(use), &word);
    else if (word.address == keywordAddress) {
      outcome_.codes.push_back(use);
      Event &event = outcome_.emit(EventKind::Code);
      event.code = code;
      event.word = &word;
    }
  }
}

} // namespace ncvet
