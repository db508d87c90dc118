// Selected blocks mirrored, shifted or scaled.
#include "lsp/features/writing/rewrite_words.h"
#include "lsp/features/writing/rewritings.h"

namespace ncvet::lsp {

namespace {

/// Lengths of scaled text are rounded to so many mm.
constexpr double roundedLength = 1e-3;

class Transformer {
public:
  Transformer(Selection &selection, const AxisChanges &changes)
      : selection_(selection), dialect_(selection.dialect()), text_(selection.snapshot().text()),
        changes_(changes) {
    for (const AxisChange &change : changes)
      mirrors_ ^= change.factor < 0;
  }

  Rewriting run(std::string title) {
    result_.title = std::move(title);
    const SelectionRun &run = selection_.run(result_.refused);
    for (const Block &block : selection_.blocks())
      if (result_.refused.empty())
        rewrite(block, run.blocks.at(block.begin));
    if (result_.refused.empty() && result_.edits.empty())
      result_.refused = "the selection has no coordinate that changes";
    const bool scales =
        llvm::any_of(changes_, [](const AxisChange &one) { return std::fabs(one.factor) != 1; });
    selection_.prove(result_, changes_, scales ? roundedLength : 1e-6);
    if (!result_.refused.empty())
      result_.edits.clear();
    return std::move(result_);
  }

private:
  void rewrite(const Block &block, const Execution &execution) {
    if (!execution.isAlike) {
      result_.refused = selection_.lineOf(block.begin) + " is executed in different modes";
      return;
    }
    for (const Word &word : block.words) {
      if (const CodeInfo *code = gCodeOf(dialect_, word)) {
        if (mirrors_)
          turnRound(block, word, *code);
        continue;
      }
      if (const auto change = changeOf(word, execution); change && !change->isNone())
        number(block, word, *change, execution);
    }
  }

  /// How the number of a word changes; none: it is no length of the path.
  std::optional<AxisChange> changeOf(const Word &word, const Execution &execution) const {
    const AddressInfo &info = dialect_.addresses[word.address];
    if (info.kind == AddressKind::Axis || info.kind == AddressKind::Increment) {
      AxisChange change = changes_[size_t(info.axis)];
      if (info.kind == AddressKind::Increment || word.has(wordIncremental) ||
          execution.distance == Action::Incremental)
        change.shift = 0;
      return change;
    }
    if (!isArc(execution.motion))
      return std::nullopt;
    if (word.address == dialect_.arcRadius)
      return AxisChange{std::fabs(changes_[0].factor), 0};
    const char centres[] = {'I', 'J', 'K'};
    for (size_t axis = 0; axis < 3; ++axis)
      if (word.address == letterAddress(centres[axis])) {
        AxisChange change = changes_[axis];
        if (execution.arcDistance != Action::ArcAbsolute)
          change.shift = 0;
        return change;
      }
    return std::nullopt;
  }

  void number(const Block &block, const Word &word, const AxisChange &change,
              const Execution &execution) {
    if (!word.isNumber()) {
      result_.refused = selection_.lineOf(block.begin) + ": a value is computed";
      return;
    }
    const llvm::StringRef digits = digitsOf(text_, block, word, dialect_);
    const auto at = uint32_t(digits.begin() - text_.begin());
    // A number without a point may count in thousandths: what is written has one.
    const double unit = unitOf(word, dialect_.addresses[word.address], execution);
    const double value = change.factor * word.value() * unit + change.shift / execution.unit;
    result_.edits.push_back(
        {{selection_.snapshot().source().id(), at, at + uint32_t(digits.size())},
         coordinateText(dialect_, word, value)});
  }

  /// Units of one of the word's number: 1, or less where it has no point and the control counts
  /// such in its smallest ones.
  static double unitOf(const Word &word, const AddressInfo &info, const Execution &execution) {
    if (word.has(wordPoint) || !info.pointAdvised || info.kind != AddressKind::Axis ||
        execution.distance == Action::Incremental || word.mantissa == 0)
      return 1;
    const double place = execution.after[size_t(info.axis)] / execution.unit;
    return std::isnan(place) ? 1 : place / word.value();
  }

  void turnRound(const Block &block, const Word &word, const CodeInfo &code) {
    const Action other = code.action == Action::ArcCw               ? Action::ArcCcw
                         : code.action == Action::ArcCcw            ? Action::ArcCw
                         : code.action == Action::CompensationLeft  ? Action::CompensationRight
                         : code.action == Action::CompensationRight ? Action::CompensationLeft
                                                                    : Action::None;
    const CodeInfo *const turned =
        other == Action::None ? nullptr : counterpart(dialect_, code, other);
    if (!turned)
      return;
    const llvm::StringRef digits = digitsOf(text_, block, word, dialect_);
    const auto at = uint32_t(digits.begin() - text_.begin());
    result_.edits.push_back(
        {{selection_.snapshot().source().id(), at, at + uint32_t(digits.size())},
         codeDigits(*turned, digits)});
  }

  Selection &selection_;
  const Dialect &dialect_;
  const llvm::StringRef text_;
  const AxisChanges changes_;
  bool mirrors_ = false;
  Rewriting result_;
};

} // namespace

Rewriting transform(Selection &selection, const AxisChanges &changes, std::string title) {
  return Transformer(selection, changes).run(std::move(title));
}

} // namespace ncvet::lsp
