// Canned cycles of drilling as moves, and moves as a cycle.
#include "lsp/features/writing/new_lines.h"
#include "lsp/features/writing/rewrite_words.h"
#include "lsp/features/writing/rewriter.h"
#include "lsp/features/writing/rewritings.h"

namespace ncvet::lsp {

namespace {

using KeptMove = SelectionRun::KeptMove;

/// Whether two coordinates of a program mean one place, mm.
bool isSamePlace(double a, double b) { return std::fabs(a - b) <= 1e-6; }

/// Spells blocks as the text around does.
class Spelling {
public:
  explicit Spelling(Selection &selection)
      : dialect_(selection.dialect()), padded_(isPadded(selection)), pointed_(hasPoints(selection)),
        rapid_(codeFor(dialect_, StandardGroup::Motion, Action::Rapid)),
        linear_(codeFor(dialect_, StandardGroup::Motion, Action::Linear)) {}

  bool isComplete() const { return rapid_ && linear_; }
  std::string code(const CodeInfo &code) const {
    return "G" + codeDigits(code, padded_ ? "00" : "");
  }
  std::string motion(MoveKind kind) const {
    return code(kind == MoveKind::Rapid ? *rapid_ : *linear_);
  }
  /// `X12.5`; empty: the control has no word for the axis.
  std::string coordinate(size_t axis, double value) const {
    const AddressId address = addressOf(dialect_, AddressKind::Axis, Axis(axis));
    if (address == noAddress)
      return {};
    return word(address, value);
  }
  std::string word(AddressId address, double value) const {
    return dialect_.addressName(address) + coordinateText(dialect_, address, value, pointed_);
  }

private:
  /// `G01` rather than `G1`.
  static bool isPadded(const Selection &selection) {
    return selection.snapshot().text().contains_insensitive("G0") &&
           (selection.snapshot().text().contains_insensitive("G00") ||
            selection.snapshot().text().contains_insensitive("G01"));
  }

  static bool hasPoints(const Selection &selection) {
    return llvm::any_of(selection.blocks(), [&](const Block &block) {
      return (block.pointed & selection.dialect().axisWords) != 0;
    });
  }

  const Dialect &dialect_;
  const bool padded_, pointed_;
  const CodeInfo *const rapid_, *const linear_;
};

class CycleExpander : Rewriter {
public:
  explicit CycleExpander(Selection &selection)
      : Rewriter(selection, "Write the cycles of the selection as moves"), spelling_(selection) {}

  Rewriting run() {
    if (dialect_.lexical.blocksSpanLines || !spelling_.isComplete())
      result_.refused = "the control has no blocks for single moves";
    else
      write();
    return finish();
  }

private:
  void refuse(const Block &block, const char *why) {
    Rewriter::refuse(selection_.lineOf(block.begin) + why);
  }

  void write() {
    const SelectionRun &run = selection_.run(result_.refused);
    if (!result_.refused.empty())
      return;
    NewLines lines(selection_);
    uint32_t past = selection_.blocks().empty() ? 0 : selection_.blocks().front().begin;
    bool runs = false;
    for (const Block &block : selection_.blocks()) {
      const Execution &execution = run.blocks.at(block.begin);
      lines.keepText(past, block.begin);
      past = block.next;
      if (!execution.runsCycle) {
        lines.keep(block);
        continue;
      }
      runs = true;
      if (execution.times != 1)
        return refuse(block, " is executed more than once");
      if (execution.distance == Action::Incremental)
        return refuse(block, " is given in distances");
      addMoves(block, execution, run.moves, lines);
      if (!result_.refused.empty())
        return;
    }
    if (!runs) {
      result_.refused = "no cycle of the selection runs";
      return;
    }
    replaceBlocks(lines.text(result_.refused));
  }

  /// Words of the block that count beside the cycle: modes of other groups, and the feed.
  std::string wordsBeside(const Block &block) {
    std::string words;
    const GroupIndex cycle = dialect_.group(StandardGroup::Cycle);
    const GroupIndex motion = dialect_.group(StandardGroup::Motion);
    for (const Word &word : block.words) {
      const CodeInfo *const code = gCodeOf(dialect_, word);
      const bool isBeside =
          code ? code->group != cycle && code->group != motion : word.address == letterAddress('F');
      if (isBeside)
        words += text_.slice(word.offset, block.endOf(word)).trim().str() + " ";
    }
    return words;
  }

  void addMoves(const Block &block, const Execution &execution, llvm::ArrayRef<KeptMove> moves,
                NewLines &lines) {
    if (!block.items.empty() || block.hasAny(maskOf('M') | maskOf('S') | maskOf('T')))
      return refuse(block, " does more than to run a cycle");
    for (const Comment &comment : block.comments)
      lines.keepText(comment.begin, comment.end);
    std::string beside = wordsBeside(block);
    std::array<double, axisCount> at = execution.before;
    std::optional<MoveKind> kind;
    for (const KeptMove &move : moves) {
      if (move.begin != block.begin || !move.inFile)
        continue;
      if (move.kind != MoveKind::Rapid && move.kind != MoveKind::Linear)
        return refuse(block, ": not all that the cycle does are moves");
      std::string line = std::exchange(beside, "");
      if (kind != move.kind)
        line += spelling_.motion(move.kind) + " ";
      kind = move.kind;
      for (size_t axis = 0; axis < axisCount; ++axis) {
        const double to = move.to[axis];
        if (std::isnan(to) || (!std::isnan(at[axis]) && isSamePlace(at[axis], to)))
          continue;
        const double unit = axis < 3 ? execution.unit : 1;
        line += spelling_.coordinate(axis, to / unit) + " ";
        at[axis] = to;
      }
      lines.add(llvm::StringRef(line).rtrim().str());
    }
    if (!beside.empty())
      refuse(block, ": its moves are not known");
  }

  const Spelling spelling_;
};

/// A hole: to its place, down to the retract level, down at feed, and up again.
struct Hole {
  double x = 0, y = 0, retract = 0, depth = 0, up = 0;
};

class CycleMaker : Rewriter {
public:
  explicit CycleMaker(Selection &selection)
      : Rewriter(selection, "Make the holes of the selection a cycle"), spelling_(selection) {}

  Rewriting run() {
    findCodes();
    if (!drill_ || !cancel_ || dialect_.lexical.blocksSpanLines || dialect_.isLathe())
      result_.refused = "the control has no cycle of that kind";
    else if (readHoles())
      write();
    return finish();
  }

private:
  void findCodes() {
    for (const CodeInfo &code : dialect_.codes) {
      if (code.letter != 'G')
        continue;
      const auto takes = [&](char letter, Role role) {
        return llvm::any_of(code.words, [&](const WordSpec &word) {
          return word.role == role && word.any & maskOf(letter);
        });
      };
      if (!drill_ && code.cycle == CycleKind::Drill && takes('Z', Role::Depth) &&
          takes('R', Role::Retract))
        drill_ = &code;
    }
    if (drill_)
      cancel_ = codeFor(dialect_, StandardGroup::Cycle, Action::CycleCancel);
    toLevel_ = codeFor(dialect_, StandardGroup::ReturnLevel, Action::ReturnR);
    toStart_ = codeFor(dialect_, StandardGroup::ReturnLevel, Action::ReturnInitial);
  }

  /// Whether a block is a plain move, with F at most beside it.
  bool isPlain(const Block &block) const {
    const AddressMask moves = dialect_.axisWords | maskOf('F') | maskOf('G');
    return block.items.empty() && block.skip < 0 && !(block.addresses & ~moves) &&
           llvm::all_of(block.words, [&](const Word &word) {
             const CodeInfo *const code = gCodeOf(dialect_, word);
             return word.address != letterAddress('G') ||
                    (code && (code->action == Action::Rapid || code->action == Action::Linear));
           });
  }

  bool refuseMove(const Block &block) {
    return refuse(selection_.lineOf(block.begin) + " is not the move of a hole");
  }

  /// One block after the other: across, down by rapid where the tool is not there yet, down at
  /// feed, up by rapid.
  bool readHoles() {
    const SelectionRun &run = selection_.run(result_.refused);
    if (!result_.refused.empty())
      return false;
    enum class Next : uint8_t { Across, Down, Up } next = Next::Across;
    for (const Block &block : selection_.blocks()) {
      const Execution &execution = run.blocks.at(block.begin);
      unit_ = execution.unit;
      const std::optional<Step> step = stepOf(block, execution);
      if (!step)
        return refuseMove(block);
      if (next == Next::Across) {
        if (step->feeds || step->isAlong)
          return refuseMove(block);
        holes_.push_back({execution.after[0], execution.after[1], step->z, 0, 0});
        next = Next::Down;
      } else if (!step->isAlong) {
        return refuseMove(block);
      } else if (next == Next::Down && !step->feeds) {
        holes_.back().retract = step->z;
      } else if (next == Next::Down) {
        holes_.back().depth = step->z;
        if (feed_.empty() && block.find('F'))
          feed_ = feedText(block);
        next = Next::Up;
      } else if (step->feeds) {
        return refuseMove(block);
      } else {
        holes_.back().up = step->z;
        next = Next::Across;
      }
    }
    if (next != Next::Across || holes_.size() < 2)
      return refuse("a row has two holes at least");
    return areAlike();
  }

  struct Step {
    bool feeds = false, isAlong = false; ///< along the tool's axis, Z
    double z = 0;                        ///< where it ends
  };
  /// What a block moves; none: it is not a plain move in X and Y or in Z, to places that are known.
  std::optional<Step> stepOf(const Block &block, const Execution &execution) const {
    if (!isPlain(block) || execution.times != 1 || execution.machineAxes ||
        execution.distance == Action::Incremental ||
        (execution.motion != Action::Rapid && execution.motion != Action::Linear))
      return std::nullopt;
    std::array<bool, 3> moves{};
    for (size_t axis = 0; axis < moves.size(); ++axis) {
      const double from = execution.before[axis], to = execution.after[axis];
      if (std::isnan(from) || std::isnan(to))
        return std::nullopt;
      moves[axis] = !isSamePlace(from, to);
    }
    if (moves[2] == (moves[0] || moves[1]))
      return std::nullopt;
    return Step{execution.motion == Action::Linear, moves[2], execution.after[2]};
  }

  std::string feedText(const Block &block) const {
    const Word &word = *block.find('F');
    return " " + selection_.snapshot().text().slice(word.offset, block.endOf(word)).trim().str();
  }

  bool areAlike() {
    for (const Hole &hole : holes_)
      if (!isSamePlace(hole.retract, holes_[0].retract) ||
          !isSamePlace(hole.depth, holes_[0].depth) || !isSamePlace(hole.up, holes_[0].up))
        return refuse("the holes are not alike");
    return true;
  }

  void write() {
    const Hole &first = holes_.front();
    const CodeInfo *const level = isSamePlace(first.up, first.retract) ? toLevel_ : toStart_;
    NewLines lines(selection_);
    const auto place = [&](const Hole &hole) {
      return spelling_.coordinate(0, hole.x / unit_) + " " +
             spelling_.coordinate(1, hole.y / unit_);
    };
    lines.add((level ? spelling_.code(*level) + " " : "") + spelling_.code(*drill_) + " " +
              place(first) + " " + spelling_.coordinate(2, first.depth / unit_) + " " +
              spelling_.word(letterAddress('R'), first.retract / unit_) + feed_);
    for (const Hole &hole : llvm::makeArrayRef(holes_).drop_front())
      lines.add(place(hole));
    lines.add(spelling_.code(*cancel_));
    replaceBlocks(lines.text(result_.refused));
  }

  const Spelling spelling_;
  const CodeInfo *drill_ = nullptr, *cancel_ = nullptr, *toLevel_ = nullptr, *toStart_ = nullptr;
  std::vector<Hole> holes_;
  double unit_ = 1;
  std::string feed_;
};

} // namespace

Rewriting cyclesToMoves(Selection &selection) { return CycleExpander(selection).run(); }
Rewriting movesToCycle(Selection &selection) { return CycleMaker(selection).run(); }

} // namespace ncvet::lsp
