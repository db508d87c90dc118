// One pass over the blocks of a file.
#include "analyzer/facts/used_up_loops.h"

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

#include <map>
#include <set>

namespace ncvet {

namespace {

constexpr size_t mostLoops = 1000; // a file with more is made by a generator
constexpr uint64_t firstOfControl = 1000,
                   firstNamed = 100'000; // variables that change by themselves

class LoopReader {
public:
  LoopReader(const FileSummary &file, const Dialect &dialect) : file_(file), dialect_(dialect) {}

  std::vector<SourceRange> usedUp() {
    for (const Block &block : blocks(file_.reader)) {
      if (loops_.size() > mostLoops)
        return {};
      if (findCode(dialect_, block,
                   {Action::CallProgram, Action::CallLocal, Action::MacroCall, Action::MacroModal,
                    Action::Return}))
        leaves_.insert(block.begin);
      for (const Item &item : block.items)
        note(block, item);
    }
    std::vector<SourceRange> heads;
    for (const Loop &loop : loops_)
      if (isUsedUp(loop))
        heads.push_back(loop.head);
    return heads;
  }

private:
  static constexpr size_t none = ~size_t(0);

  struct Loop {
    SourceRange head;
    std::set<uint64_t> read; ///< what its condition looks at; empty: it is not known
    size_t parent = none;
    uint32_t begin = 0, end = 0; ///< of its blocks; 0: it is not closed
    uint32_t name = 0;           ///< label or number
    bool after = false;          ///< the test is at its end

    bool holds(uint32_t at) const { return begin <= at && at < end; }
  };

  void note(const Block &block, const Item &item) {
    switch (item.kind) {
    case ItemKind::Assignment:
      writes_.emplace(block.keyOf(item.target), block.begin);
      return;
    case ItemKind::While:
    case ItemKind::Do:
      return open(block, item, item.loop);
    case ItemKind::End:
      return close(block, item.loop);
    case ItemKind::Structure:
      return bracket(block, item);
    case ItemKind::If:
      return;
    default:
      leaves_.insert(block.begin);
    }
  }

  void bracket(const Block &block, const Item &item) {
    const auto isOpen = [&](size_t loop) {
      return loops_[loop].after && loops_[loop].name == item.label;
    };
    switch (item.structure) {
    case Structure::While:
      if (item.label && llvm::any_of(open_, isOpen))
        return close(block, item.label);
      return open(block, item, item.label);
    case Structure::Repeat:
    case Structure::Loop:
    case Structure::For:
    case Structure::Times:
      return open(block, item, item.label);
    case Structure::EndWhile:
    case Structure::EndLoop:
    case Structure::EndFor:
    case Structure::EndTimes:
    case Structure::Until:
      return close(block, item.label);
    case Structure::Break:
    case Structure::Continue:
    case Structure::Return:
      leaves_.insert(block.begin);
      return;
    default:
      return;
    }
  }

  void open(const Block &block, const Item &item, uint32_t name) {
    Loop loop;
    loop.head = {file_.source.id(), item.begin, item.end};
    loop.parent = open_.empty() ? none : open_.back();
    loop.begin = block.next;
    loop.name = name;
    loop.after = item.kind == ItemKind::Structure && item.structure == Structure::Repeat;
    if (item.kind == ItemKind::While ||
        (item.kind == ItemKind::Structure && item.structure == Structure::While))
      loop.read = variablesOf(block, item.condition);
    open_.push_back(loops_.size());
    loops_.push_back(std::move(loop));
  }

  void close(const Block &block, uint32_t name) {
    if (open_.empty() || loops_[open_.back()].name != name)
      return open_.clear(); // another rule says so
    loops_[open_.back()].end = block.begin;
    open_.pop_back();
  }

  static std::set<uint64_t> variablesOf(const Block &block, uint16_t index) {
    std::set<uint64_t> read;
    if (index >= block.expressions.size() || block.expressions[index].bad)
      return {};
    const Expression &condition = block.expressions[index];
    for (uint32_t i = 0; i < condition.count; ++i) {
      const ExpressionOp &op = block.operations[condition.first + i];
      const auto key = uint64_t(op.value);
      if (op.op == Op::Opaque || op.op == Op::VariableAt || op.op == Op::ElementAt ||
          op.op == Op::Unknown ||
          (op.op == Op::Variable && key >= firstOfControl && key < firstNamed))
        return {};
      if (op.op == Op::Variable)
        read.insert(key);
    }
    return read;
  }

  bool isUsedUp(const Loop &loop) const {
    if (loop.parent == none || loop.read.empty() || !loop.end || !loops_[loop.parent].end)
      return false;
    const Loop &parent = loops_[loop.parent];
    if (const auto leaves = leaves_.lower_bound(parent.begin);
        leaves != leaves_.end() && *leaves <= parent.end)
      return false;
    bool counts = false;
    for (const uint64_t key : loop.read)
      for (auto [at, end] = writes_.equal_range(key); at != end; ++at) {
        counts |= loop.holds(at->second);
        if (parent.holds(at->second) && !loop.holds(at->second))
          return false;
      }
    return counts;
  }

  const FileSummary &file_;
  const Dialect &dialect_;
  std::vector<Loop> loops_;
  std::vector<size_t> open_;
  std::multimap<uint64_t, uint32_t> writes_; ///< blocks, by the variable that they write
  std::set<uint32_t> leaves_;                ///< blocks from which control may go elsewhere
};

} // namespace

std::vector<SourceRange> usedUpLoops(const FileSummary &file, const Dialect &dialect) {
  return LoopReader(file, dialect).usedUp();
}

} // namespace ncvet
