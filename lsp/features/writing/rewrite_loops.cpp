// Loops and repeats of selected blocks, written out.
#include "analyzer/program/flow_shape.h"
#include "lsp/features/writing/new_lines.h"
#include "lsp/features/writing/rewriter.h"
#include "lsp/features/writing/rewritings.h"

#include "llvm/ADT/DenseMap.h"
#include "llvm/ADT/DenseSet.h"

namespace ncvet::lsp {

namespace {

class Unroller : Rewriter {
public:
  explicit Unroller(Selection &selection) : Rewriter(selection, "Unroll the selection") {}

  Rewriting run() {
    if (dialect_.lexical.blocksSpanLines)
      result_.refused = "blocks of this control span lines";
    else if (isUnrollable(selection_.wholeRun(result_.refused)))
      write(selection_.wholeRun(result_.refused).visits.front());
    return finish();
  }

private:
  bool isUnrollable(const SelectionRun &run) {
    if (!result_.refused.empty())
      return false;
    if (selection_.blocks().empty() || run.visits.empty())
      return refuse("the program does not come to the selection");
    if (!run.visitsAreWhole || run.visits.front().size() > mostNewBlocks)
      return refuse("there would be too many blocks");
    for (const auto &visit : run.visits)
      if (visit != run.visits.front())
        return refuse("the selection is executed in several ways");
    const llvm::ArrayRef<SelectedStep> steps = run.visits.front();
    if (steps.front().begin != selection_.blocks().front().begin)
      return refuse("the program comes into the middle of the selection");
    llvm::DenseSet<uint32_t> seen;
    bool repeats = false;
    for (const SelectedStep &step : steps)
      repeats |= !step.decides && !seen.insert(step.begin).second;
    if (!repeats)
      return refuse("no block of the selection is executed more than once");
    if (llvm::none_of(steps, [](const SelectedStep &step) { return step.decides; }))
      return refuse("nothing of the selection says that it is executed more than once");
    return true;
  }

  void write(llvm::ArrayRef<SelectedStep> steps) {
    for (const Block &block : selection_.blocks())
      blocks_[block.begin] = &block;
    NewLines lines(selection_);
    llvm::DenseSet<uint32_t> written;
    uint32_t past = selection_.blocks().front().begin; // what comes before it is written
    for (const SelectedStep &step : steps) {
      const Block *const selected = blocks_.lookup(step.begin);
      if (!selected) // a label alone
        continue;
      const Block &block = *selected;
      // Comments and empty lines stay before the block that they are written before.
      if (block.begin > past)
        lines.keepText(afterBlockBefore(block, past), block.begin);
      past = std::max(past, block.next);
      if (step.decides) {
        if (!isAlone(block)) {
          result_.refused = selection_.lineOf(block.begin) + " does more than to say what is next";
          return;
        }
        lines.add(counting(block));
      } else if (written.insert(block.begin).second) {
        lines.keep(block);
      } else {
        lines.add(bareText(text_, block));
      }
      if (lines.blocks() > mostNewBlocks) {
        result_.refused = "there would be too many blocks";
        return;
      }
    }
    replaceBlocks(lines.text(result_.refused));
  }

  /// Begin of the comments and empty lines before `block`, from `past` on: after the last block
  /// with content.
  uint32_t afterBlockBefore(const Block &block, uint32_t past) const {
    uint32_t from = past;
    for (const Block &other : selection_.blocks())
      if (other.begin < block.begin)
        from = std::max(from, other.next);
    return std::min(from, block.begin);
  }

  /// Nothing but the statement that decides: what else a block does would be lost.
  bool isAlone(const Block &block) const {
    return !block.hasAny(selection_.dialect().axisWords) && block.items.size() <= 2 &&
           block.words.size() <= 2;
  }

  /// What a loop does with its counter: `R1=1` at the head of FOR, `R1=R1+1` at its end.
  std::string counting(const Block &block) {
    for (const Item &item : block.items) {
      if (item.kind != ItemKind::Structure)
        continue;
      if (item.structure == Structure::For)
        return expression(block, item.target) + "=" + expression(block, item.value);
      if (item.structure != Structure::EndFor)
        continue;
      const auto head = shape().back.find(block.begin);
      if (head == shape().back.end())
        return {};
      Block begin;
      selection_.snapshot().unit().reader->read(head->second, begin);
      for (const Item &other : begin.items)
        if (other.kind == ItemKind::Structure && other.structure == Structure::For) {
          const std::string counter = expression(begin, other.target);
          return counter + "=" + counter + "+1";
        }
    }
    return {};
  }

  std::string expression(const Block &block, uint16_t index) const {
    const Expression &one = block.expressions[index];
    return text_.slice(one.begin, one.end).trim().str();
  }

  const FlowShape &shape() {
    if (!shape_) {
      const ProgramInfo &program = selection_.snapshot().unit().index.programAt(selection_.begin());
      shape_ = readShape(*selection_.snapshot().unit().reader, program.begin, program.end);
    }
    return *shape_;
  }

  llvm::DenseMap<uint32_t, const Block *> blocks_;
  std::optional<FlowShape> shape_;
};

} // namespace

Rewriting unroll(Selection &selection) { return Unroller(selection).run(); }

} // namespace ncvet::lsp
