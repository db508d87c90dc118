// Which offset numbers the tools of a file have: what all of them but one keep to, that one lacks
// by a slip.
#pragma once

#include "analyzer/rule/rule.h"
#include "analyzer/rule/text_answers.h"

#include <set>

namespace ncvet {

/// The habits of files with the numbers of offsets, as their texts say, each file read once.
class OffsetHabits {
public:
  /// Whether a T word of the current file has the number.
  bool isTool(int64_t number, const RuleContext &ctx) const;
  /// The lengths of at least three others are their own, and a second length of this tool it is
  /// not.
  bool isSlip(const Word &length, const RuleContext &ctx) const;
  /// The lengths of all other tools of the file, two at least, have the numbers of their tools:
  /// what is a shop's scheme elsewhere is a slip here. A second length of a tool often lies tens
  /// above its first one.
  bool breaksHabit(const Word &length, const RuleContext &ctx) const;
  /// `T0305` where at least three other stations have the offsets of their own numbers, this one
  /// never has, and no other has another.
  bool isOnlyStation(int64_t tool, int64_t offset, const RuleContext &ctx) const;
  /// One length of the current program is subtracted, `G44 H2`, where at least two other tools add
  /// theirs.
  bool subtractsOnce(const RuleContext &ctx) const;

private:
  /// Tools of a file.
  struct Lengths {
    std::set<int64_t> tools; ///< numbers of the T words
    std::set<int64_t> own;   ///< tools with an H of their own number
    std::set<int64_t> other; ///< tools with an H of another number
  };

  const Lengths &lengthsOf(const RuleContext &ctx) const;

  TextAnswers<FileId, Lengths> lengths_;
  TextAnswers<std::pair<FileId, int64_t>, bool> stations_;      ///< by T word: the only slip
  TextAnswers<std::pair<FileId, uint32_t>, bool> subtractions_; ///< by begin of the program
};

} // namespace ncvet
