// Blocks in the language of another control: what they do is not known.
#include "interp/execute/execution.h"

namespace ncvet {

bool Execution::inForeignLanguage() const {
  if (masks_.language == noGroup)
    return false;
  const uint64_t now = state_.groups[masks_.language];
  return (now & masks_.foreign) && !(now & groupUnset);
}

/// Only what leads back to the control's own language counts, what ends the program, and words that
/// no other language has.
void Execution::foreignBlock() {
  outcome_.foreign = true;
  outcome_.setupChanged = true;
  if (block_.isEmpty())
    return;
  stateUse.everything();
  MachineState any = unknownState(dialect_);
  any.origin = state_.origin;
  any.profile = state_.profile;
  any.modalCalls = state_.modalCalls;
  any.setGroup(masks_.language, state_.groups[masks_.language]);
  state_ = std::move(any);
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
