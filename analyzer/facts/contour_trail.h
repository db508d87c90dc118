// The elements of the compensated contour that the blocks executed so far have made.
#pragma once

#include "analyzer/rule/rule.h"
#include "interp/path/compensated_path.h"
#include "interp/path/corner_path.h"

namespace ncvet {

/// Follows a compensated contour block by block, through calls and loops, its corners put in. For
/// each element it tells what is before and after, as soon as that is known.
class ContourTrail {
public:
  struct Element {
    ContourElement line;  ///< or arc
    SourceRange range;    ///< the words of its block, or the one that asks for it
    bool corner = false;  ///< a chamfer or rounding after the block's own move
    bool certain = false; ///< on every path that the state represents
    bool entry = false;   ///< the path on, where that is an element as others
    double left = 0;      ///< mm from it to the tool's centre, below zero on its right
    Origin tool;          ///< where the tool was called
  };
  /// `neighbours` tells of the same corners as `corners`.
  using Judge = llvm::function_ref<void(const Element &, const Neighbours &neighbours,
                                        const ElementCorners &corners)>;

  ContourTrail(const Dialect &dialect, const MachineProfile &machine);

  /// Takes the motion of the current block. A block that does not go on where the last one ended
  /// begins a trail of its own.
  void take(const RuleContext &ctx, bool certain, Judge judge);

  /// Between contours nothing of it counts.
  bool isIdle() const { return !path_; }

private:
  bool isInPlace(const RuleContext &ctx) const;
  bool goesOn(const RuleContext &ctx) const;
  double centreLeft(const RuleContext &ctx) const;
  void begin(const RuleContext &ctx);
  void end(bool leaves, Judge judge);
  bool takePlain(const RuleContext &ctx, bool certain, Judge judge);
  void resume(const RuleContext &ctx);
  void add(uint64_t tag, const Move &move, Judge judge);
  void append(const Element &element, const Vector &in, const Vector &out, Judge judge);
  void breakOff(bool approach, Judge judge);
  CornerFit cornerTo(const ContourElement &next, const Vector &in, double left) const;
  void judgeLast(const ContourElement *after, bool unknownAfter, Judge judge);
  void keepPlace(const RuleContext &ctx);

  const Dialect &dialect_;
  const CompensationHabits habits_;
  const CornerWords corners_;
  AddressMask cornerWords_;
  std::optional<CornerPath> path_; ///< absent between contours
  bool incomplete_ = false;        ///< plain moves were not added to it
  std::array<Axis, 2> plane_{Axis::X, Axis::Y};
  ContourPlane coordinates_;           ///< in that plane
  std::array<Interval, 2> programmed_; ///< where the last block ended, as the state has it
  std::array<Interval, 2> plainFrom_;  ///< where the last plain move began
  Place from_;                         ///< where the next element begins
  FrameStack frames_;                  ///< under which the last block ran
  // What the tool's distance depends on.
  uint64_t planeCodes_ = 0, sideCodes_ = 0;
  Action side_ = Action::None;
  std::array<int32_t, 3> tool_{};
  Variables commons_;
  /// What is known of a block's elements before their lines are.
  struct BlockElements {
    uint64_t tag = 0;
    Element element;
    SourceRange cornerRange;
    bool approach = false; ///< compensation is built up along its move
  };
  BlockElements block_, blockBefore_;    ///< the current one, and the one that its corner waits for
  uint64_t lastTag_ = 0;                 ///< of the block whose element came last
  std::optional<ContourElement> before_; ///< of the last one; none: the path on, or not known
  std::optional<Element> last_;
  Vector lastOut_{0, 0}; ///< direction of travel at the last one's end
  ElementCorners ends_;  ///< of the last one, as far as they are known
  llvm::SmallVector<Move, 8> moves_;
};

} // namespace ncvet
