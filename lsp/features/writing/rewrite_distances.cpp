// Coordinates of selected blocks as distances, or as places.
#include "lsp/features/writing/rewrite_words.h"
#include "lsp/features/writing/rewritings.h"

namespace ncvet::lsp {

namespace {

class DistanceRewriter {
public:
  DistanceRewriter(Selection &selection, bool incremental)
      : selection_(selection), dialect_(selection.dialect()), text_(selection.snapshot().text()),
        incremental_(incremental), wanted_(incremental ? Action::Incremental : Action::Absolute) {
    const GroupIndex group = dialect_.group(StandardGroup::Distance);
    // A lathe's G90 may be a cycle: its words for distances go before the codes.
    if (group == noGroup || (dialect_.isLathe() && dialect_.incrementWords))
      return;
    for (const CodeIndex index : dialect_.groups[group].members) {
      const CodeInfo &code = dialect_.codes[index];
      if (code.letter == 'G' && code.action == Action::Absolute && !absolute_)
        absolute_ = &code;
      if (code.letter == 'G' && code.action == Action::Incremental && !relative_)
        relative_ = &code;
    }
  }

  Rewriting run() {
    result_.title = incremental_ ? "Give the coordinates of the selection as distances"
                                 : "Give the coordinates of the selection as places";
    if (dialect_.lexical.blocksSpanLines)
      return refuse("blocks of this control span lines");
    run_ = &selection_.run(result_.refused);
    for (const Block &block : selection_.blocks())
      if (result_.refused.empty())
        rewrite(block, run_->blocks.at(block.begin));
    if (result_.refused.empty() && changes_ == 0)
      return refuse("no coordinate of the selection is given otherwise");
    if (result_.refused.empty() && byCode())
      bringModeBack();
    if (!result_.refused.empty())
      result_.edits.clear();
    selection_.prove(result_);
    return std::move(result_);
  }

private:
  bool byCode() const { return absolute_ && relative_; }
  Rewriting refuse(std::string why) {
    result_.edits.clear();
    result_.refused = std::move(why);
    return std::move(result_);
  }
  void edit(uint32_t begin, uint32_t end, std::string text) {
    result_.edits.push_back({{selection_.snapshot().source().id(), begin, end}, std::move(text)});
  }

  void rewrite(const Block &block, const Execution &execution) {
    if (execution.times != 1) {
      result_.refused = selection_.lineOf(block.begin) + " is executed more than once";
      return;
    }
    if (execution.leaves && byCode()) {
      result_.refused = selection_.lineOf(block.begin) + " leads elsewhere";
      return;
    }
    bool isNamed = false;
    for (const Word &word : block.words) {
      const CodeInfo *code = gCodeOf(dialect_, word);
      if (code && (code->action == Action::Absolute || code->action == Action::Incremental)) {
        isNamed = true;
        modeIsWanted_ = true;
        if (code->action == wanted_)
          continue;
        if (!byCode()) {
          result_.refused = selection_.lineOf(block.begin) + " says otherwise by a code";
          return;
        }
        const llvm::StringRef digits = digitsOf(text_, block, word, dialect_);
        const auto at = uint32_t(digits.begin() - text_.begin());
        edit(at, at + uint32_t(digits.size()),
             codeDigits(incremental_ ? *relative_ : *absolute_, digits));
      }
    }
    const bool isOther = byCode() && (execution.distance == Action::Incremental) != incremental_;
    if (byCode() && !isOther && !isNamed)
      modeIsWanted_ = true;
    if (isOther && !modeIsWanted_ && !isNamed && hasCoordinates(block)) {
      const CodeInfo &code = incremental_ ? *relative_ : *absolute_;
      const uint32_t at = block.words.front().offset;
      edit(at, at, "G" + codeDigits(code, "") + " ");
      modeIsWanted_ = true;
    }
    for (const Word &word : block.words)
      if (result_.refused.empty())
        coordinate(block, word, execution, isOther);
    llvm::stable_sort(result_.edits, [](const TextEdit &a, const TextEdit &b) {
      return a.range.begin < b.range.begin;
    });
  }

  bool hasCoordinates(const Block &block) const { return block.hasAny(dialect_.axisWords); }

  void coordinate(const Block &block, const Word &word, const Execution &execution, bool isOther) {
    const AddressInfo &info = dialect_.addresses[word.address];
    const bool isDistance = info.kind == AddressKind::Increment;
    if ((info.kind != AddressKind::Axis && !isDistance) || word.has(wordIncremental))
      return;
    if (byCode() ? isDistance || !isOther : isDistance == incremental_)
      return;
    const auto axis = size_t(info.axis);
    const double from = execution.before[axis], to = execution.after[axis];
    const double value = incremental_ ? to - from : to;
    if (!word.isNumber() || std::isnan(value) || execution.machineAxes >> axis & 1) {
      result_.refused = selection_.lineOf(block.begin) + ": the coordinate is not known";
      return;
    }
    AddressId address = word.address;
    if (!byCode())
      address =
          addressOf(dialect_, incremental_ ? AddressKind::Increment : AddressKind::Axis, info.axis);
    if (address == noAddress) {
      result_.refused = "the control has no word for it";
      return;
    }
    const llvm::StringRef digits = digitsOf(text_, block, word, dialect_);
    const auto end = uint32_t(digits.end() - text_.begin());
    const std::string number = coordinateText(dialect_, word, value / execution.unit);
    ++changes_;
    if (address == word.address)
      edit(end - uint32_t(digits.size()), end, number);
    else
      edit(word.offset, end, dialect_.addressName(address) + number);
  }

  /// After the selection the mode is the one that it was there before.
  void bringModeBack() {
    const Block &last = selection_.blocks().back();
    const Execution &left = run_->blocks.at(last.begin);
    if ((left.distance == Action::Incremental) == incremental_)
      return;
    Block next;
    const uint32_t at = selection_.end();
    if (at < text_.size()) {
      selection_.snapshot().unit().reader->read(at, next);
      for (const Word &word : next.words)
        if (const CodeInfo *code = gCodeOf(dialect_, word))
          if (code->action == Action::Absolute || code->action == Action::Incremental)
            return;
    }
    const CodeInfo &code = incremental_ ? *absolute_ : *relative_;
    const bool onOwnLine = at > 0 && (text_[at - 1] == '\n' || text_[at - 1] == '\r');
    edit(at, at, (onOwnLine ? "" : "\n") + ("G" + codeDigits(code, "")) + "\n");
  }

  Selection &selection_;
  const Dialect &dialect_;
  const llvm::StringRef text_;
  const bool incremental_;
  const Action wanted_;
  const CodeInfo *absolute_ = nullptr, *relative_ = nullptr;
  const SelectionRun *run_ = nullptr;
  bool modeIsWanted_ = false; ///< a block of the selection has said so
  unsigned changes_ = 0;
  Rewriting result_;
};

} // namespace

Rewriting toIncremental(Selection &selection) { return DistanceRewriter(selection, true).run(); }
Rewriting toAbsolute(Selection &selection) { return DistanceRewriter(selection, false).run(); }

} // namespace ncvet::lsp
