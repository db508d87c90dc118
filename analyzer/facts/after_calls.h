// What the callers of a program do after their calls, for rules on what a return leaves in force.
#pragma once

#include "analyzer/rule/rule.h"
#include "analyzer/rule/text_answers.h"

#include <tuple>

namespace ncvet {

/// What a block after a call means for the mode that the called program has left in force.
enum class AfterCall : uint8_t {
  GoesOn, ///< neither of the two: the next block decides
  Ends,   ///< it ends the mode
  Relies  ///< it runs under the mode
};

/// Asks that once of each program: the text stays what it is while a file is checked.
class AfterCalls {
public:
  /// Whether the file calls the program that holds the current block, and every call of it by
  /// number is followed, in its own program, by a block that `judge` says to end the mode before
  /// one that relies on it. A call that repeats the program comes back to the program itself, which
  /// has to end the mode too. `judge` is asked of the blocks after a call in the order of the text;
  /// `begin` says that a new call is looked at. Blocks that a switch leaves out end nothing. `mode`
  /// is all that the judgement depends on besides.
  bool allEnd(uint64_t mode, const RuleContext &ctx, llvm::function_ref<void()> begin,
              llvm::function_ref<AfterCall(const Block &)> judge) const;

private:
  TextAnswers<std::tuple<FileId, uint32_t, uint64_t>, bool> answers_; ///< by program and mode
};

} // namespace ncvet
