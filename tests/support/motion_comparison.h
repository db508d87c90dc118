// Compares the motions that ncvet traces with those that LinuxCNC's interpreter asks for.
#pragma once

#include "analyzer/trace/trace.h"
#include "tests/support/rs274.h"

#include "llvm/Support/Format.h"

namespace ncvet::test {

/// Keeps the motions of a trace with the lines that they come from.
class TracedMoves : public TraceSink {
public:
  struct Entry {
    Move move;
    std::string file;
    uint32_t line;
    bool zero; ///< it leads to where the one before ended
  };
  std::vector<Entry> entries;
  std::string lostAt; ///< why the trace ends early; empty: it does not

  void moved(const TracedMove &traced) override {
    const MoveKind kind = traced.move.kind;
    if (kind == MoveKind::Tool || kind == MoveKind::Spindle || kind == MoveKind::End)
      return;
    const bool zero = kind == MoveKind::Dwell
                          ? traced.move.value == Interval::exactly(0)
                          : !entries.empty() &&
                                (kind == MoveKind::Rapid || kind == MoveKind::Linear) &&
                                entries.back().move.to == traced.move.to;
    entries.push_back({traced.move,
                       std::filesystem::path(traced.unit->source.display()).filename().string(),
                       traced.unit->source.lines().lineOf(traced.begin), zero});
  }
  void lost(const FileUnit &unit, SourceRange where, llvm::StringRef why) override {
    lostAt = "line " + std::to_string(unit.source.lines().lineOf(where.begin)) + ": " + why.str();
  }
};

/// What is different, one line for each difference.
class MotionComparison {
public:
  static std::vector<std::string> differences(const TracedMoves &traced, const Rs274Run &run) {
    MotionComparison comparison(traced, run);
    comparison.compare();
    return std::move(comparison.list_);
  }

private:
  MotionComparison(const TracedMoves &traced, const Rs274Run &run)
      : traced_(traced.entries), canonical_(run.moves), lost_(traced.lostAt) {}

  void compare() {
    size_t i = 0, j = 0;
    while (list_.size() < mostDifferences) {
      const bool more = i < traced_.size(), moreCanonical = j < canonical_.size();
      if (!more && !moreCanonical)
        break;
      if (more && moreCanonical && difference(traced_[i].move, canonical_[j]).empty()) {
        ++i;
        ++j;
      } else if (more && traced_[i].zero) {
        ++i;
      } else if (moreCanonical && isZero(j)) {
        ++j;
      } else if (!more) {
        list_.push_back((lost_.empty() ? "the trace ends before "
                                       : "the trace is lost at " + lost_ + "; next ") +
                        canonical_[j].text);
        break;
      } else if (!moreCanonical) {
        list_.push_back(where(i) + "not asked for: " + describe(traced_[i].move));
        break;
      } else {
        list_.push_back(where(i) + difference(traced_[i].move, canonical_[j]) + ": " +
                        describe(traced_[i].move) + " and " + canonical_[j].text);
        ++i;
        ++j;
      }
    }
  }

  /// Half a unit of the last printed digit more than what is asked for.
  static constexpr double tolerance = 0.0001 + 0.000051;
  static constexpr size_t mostDifferences = 8;

  static std::string difference(const Move &move, const CanonicalMove &canonical) {
    static constexpr MoveKind kinds[] = {MoveKind::Rapid,  MoveKind::Linear, MoveKind::Arc,
                                         MoveKind::Linear, MoveKind::Thread, MoveKind::Linear,
                                         MoveKind::Dwell};
    if (move.kind != kinds[canonical.kind])
      return "another kind";
    if (canonical.kind == CanonicalMove::Curve) // its points are not printed
      return "";
    if (canonical.kind == CanonicalMove::Dwell)
      return agree(move.value, canonical.seconds, 1) ? "" : "another time";
    const double unit = canonical.inch ? 25.4 : 1;
    for (size_t i = 0; i < canonical.to.size(); ++i)
      if (move.machineAxes >> i & 1 || !agree(move.to[i], canonical.to[i], i < 3 ? unit : 1))
        // Where a probe stops, only the run decides.
        if (canonical.kind != CanonicalMove::Probe || move.to[i].isConstant())
          return std::string(move.to[i].isConstant() ? "another " : "unknown ") + "XYZABC"[i];
    if (canonical.kind != CanonicalMove::Arc)
      return "";
    if (move.plane != canonical.plane)
      return "another plane";
    for (size_t i = 0; i < 2; ++i)
      if (!agree(move.centre[i], canonical.centre[i], unit))
        return "another centre";
    if (move.clockwise != (canonical.turns < 0))
      return "another direction";
    // Up to so many: the last turn may be a tiny arc or a whole one.
    constexpr double slack = 1e-4;
    const double turns = move.turns.isConstant() ? move.turns.value() : -1;
    if (turns < std::abs(canonical.turns) - 1 - slack || turns > std::abs(canonical.turns) + slack)
      return "other turns";
    return "";
  }
  static bool agree(const Interval &value, double canonical, double unit) {
    return value.isConstant() && std::fabs(value.value() / unit - canonical) <= tolerance;
  }

  /// Whether a straight move leads to where the one before ended.
  bool isZero(size_t j) const {
    const CanonicalMove &move = canonical_[j];
    if (move.kind == CanonicalMove::Dwell)
      return move.seconds == 0;
    if (j == 0 || (move.kind != CanonicalMove::Rapid && move.kind != CanonicalMove::Linear))
      return false;
    const CanonicalMove &before = canonical_[j - 1];
    return before.kind != CanonicalMove::Curve && before.kind != CanonicalMove::Dwell &&
           (before.inch == move.inch ? before.to == move.to : isSamePlace(before, move));
  }

  /// In two units.
  static bool isSamePlace(const CanonicalMove &a, const CanonicalMove &b) {
    constexpr double printed = 0.0001 * 25.4; // of an inch
    for (size_t i = 0; i < a.to.size(); ++i) {
      const double inA = i < 3 && a.inch ? 25.4 : 1, inB = i < 3 && b.inch ? 25.4 : 1;
      if (std::fabs(a.to[i] * inA - b.to[i] * inB) > printed)
        return false;
    }
    return true;
  }

  std::string where(size_t i) const {
    return traced_[i].file + ":" + std::to_string(traced_[i].line) + ": ";
  }
  static std::string describe(const Move &move) {
    static constexpr const char *kinds[] = {"rapid", "linear", "arc",     "thread",
                                            "dwell", "tool",   "spindle", "end"};
    std::string text = kinds[size_t(move.kind)];
    llvm::raw_string_ostream out(text);
    const auto number = [&](const Interval &value) {
      if (value.isConstant())
        out << llvm::format("%.4f", value.value());
      else
        out << "?";
    };
    if (move.kind == MoveKind::Dwell) {
      out << ' ';
      number(move.value);
      return out.str();
    }
    for (size_t i = 0; i < 6; ++i) {
      out << ' ' << (move.machineAxes >> i & 1 ? "m" : "") << "XYZABC"[i];
      number(move.to[i]);
    }
    if (move.kind == MoveKind::Arc) {
      out << (move.clockwise ? " cw " : " ccw ");
      number(move.centre[0]);
      out << '/';
      number(move.centre[1]);
      out << " turns ";
      number(move.turns);
    }
    return out.str();
  }

  const std::vector<TracedMoves::Entry> &traced_;
  const std::vector<CanonicalMove> &canonical_;
  const std::string &lost_;
  std::vector<std::string> list_;
};

} // namespace ncvet::test
