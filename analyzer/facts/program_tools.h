// What a program does with each of its tools: what all of them but one do, that one lacks by a
// slip.
#pragma once

#include "analyzer/rule/rule.h"
#include "analyzer/rule/text_answers.h"

namespace ncvet {

/// What the first cut of a tool runs with.
enum class FirstCut : uint8_t { None, OwnFeed, OtherFeed };

/// The blocks from one change of the tool to the next one, by their text.
struct ToolPart {
  uint32_t begin = 0;                  ///< the block of its change
  bool follows = false;                ///< another tool has cut before it
  bool home = false;                   ///< which then went home
  bool cuts = false;                   ///< by a feed move or a cycle
  bool clockwise = false;              ///< M03
  bool counterClockwise = false;       ///< M04
  bool leftHanded = false;             ///< a cycle that wants the spindle to turn so
  FirstCut cutsFirst = FirstCut::None; ///< with an F since its change
};

/// The tools of programs, as their texts say, each program read once. What subprograms do for them
/// is not seen.
class ProgramTools {
public:
  /// Those of the program of the current block, one after another.
  llvm::ArrayRef<ToolPart> of(const RuleContext &ctx) const;
  /// The tool that is in use in the current block, by the text; null: none is changed before.
  const ToolPart *inUse(const RuleContext &ctx) const;
  /// Whether at least `habit` tools of the program are as `is` says, of those that `counts` lets
  /// count, and but one all of them.
  bool allButOne(const RuleContext &ctx, unsigned habit,
                 llvm::function_ref<bool(const ToolPart &)> counts,
                 llvm::function_ref<bool(const ToolPart &)> is) const;

private:
  TextAnswers<std::pair<FileId, uint32_t>, std::vector<ToolPart>> known_; ///< by file and begin
};

} // namespace ncvet
