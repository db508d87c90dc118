// The outside of the work as the straight cuts of a program's text turn it.
#pragma once

#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/text_answers.h"

namespace ncvet {

/// Lengths are in units of the program, X is a diameter. What is left of the work at the end is
/// never larger than the material before it.
class TurnedShape {
public:
  TurnedShape(const FileIndex &index, const ProgramInfo &program, const Dialect &dialect);

  /// Between two stops of the program, at which the work may be turned round, everything counts
  /// that is cut there. `block` is the place that the question is asked for.
  struct At {
    uint32_t block = 0;
    double z = 0;
  };
  /// Greatest diameter that can be left there; none: the text does not tell.
  std::optional<double> diameter(At at) const;
  /// Whether anything is cut along Z there.
  bool isTurned(At at) const;
  /// Whether a tool is fed straight in as deep as `x`, not further than `near` from there.
  bool isOpened(At at, double x, double near) const;
  /// Z of the face that is cut down to the axis, as long as nothing is drilled into it: none where
  /// the block comes after the first cut along the axis, or nothing is faced before it.
  std::optional<double> faceBefore(uint32_t block) const;
  /// From where a tool is fed straight in to that place; none: it is not.
  std::optional<double> fedFrom(At at, double x) const;

private:
  friend class ShapeReader;
  struct Cut {
    unsigned section;
    double fromX, fromZ, toX, toZ;
    bool told; ///< false: it cuts there, and the text does not tell what
  };

  unsigned sectionOf(uint32_t block) const;

  std::vector<uint32_t> stops_;
  std::vector<Cut> along_;                          ///< cuts that go along Z
  std::vector<Cut> in_;                             ///< straight in, with X alone
  std::optional<std::pair<uint32_t, double>> face_; ///< block and Z of the first cut to the axis
  uint32_t drilled_ = ~0u;                          ///< the first block that cuts along the axis
};

/// The shapes of the programs that a rule asks for, each read once.
class TurnedShapes {
public:
  const TurnedShape &of(const RuleContext &ctx) const;

private:
  TextAnswers<std::pair<FileId, uint32_t>, std::shared_ptr<const TurnedShape>> known_;
};

/// The current move, in units of the program.
struct TurnedMove {
  double fromX, fromZ, toX, toZ;
  double unit; ///< mm
};
/// None where not all ends are known, or no work turns.
std::optional<TurnedMove> turnedMove(const RuleContext &ctx);

/// At rapid from outside of the work to below a diameter that is left there in the end.
std::optional<double> rapidIntoTurned(const TurnedShapes &shapes, const RuleContext &ctx);

/// At rapid along Z from outside of the work, and then outwards: a pass below a diameter that is
/// left there in the end.
std::optional<double> rapidPassInTurned(const TurnedShapes &shapes, const RuleContext &ctx);

/// At rapid along Z, or along both axes, from the bottom of a groove into its wall.
bool rapidOutOfGroove(const TurnedShapes &shapes, const RuleContext &ctx);

} // namespace ncvet
