// A parameter is read that the program has not given a value.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include "llvm/ADT/StringExtras.h"

#include <set>

namespace ncvet {
namespace {

struct VariableReadBeforeWriteMemory {
  TextPlace known{FileId(~0u), ~0u}; ///< the program of which `main` is told
  bool main = false;
  std::set<int64_t> reported;
  std::set<std::string> names;
  std::set<uint64_t> bare; ///< keys of variables defined without a value, and not given one
};

class VariableReadBeforeWrite final : public StatefulRule<VariableReadBeforeWriteMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.flag("wanted")) {
      to.on(EventKind::UnsetRead);
      if (to.dialect().lexical.commaSeparates)
        to.on({EventKind::Statement, EventKind::Block});
    }
    numbered_ = to.flag("numbered");
    commons_ = to.flag("commons", true);
    if (numbered_)
      to.onChange({EventKind::Block});
    reservedFrom_ = int64_t(to.dialect().facts->variables.reservedFrom);
    greatest_ = int64_t(to.dialect().facts->variables.lastKept);
    reservedTo_ = int64_t(to.dialect().facts->variables.reservedTo);
    volatileFrom_ = int64_t(to.dialect().facts->variables.volatileFrom);
    for (const CodeInfo &code : to.dialect().codes)
      for (const Store &store : code.stores)
        stored_.insert(store.variable);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return statement(ctx.block().items[event.item()], ctx);
    if (event.kind == EventKind::Block)
      return numbered_ ? numbered(ctx) : bareReads(ctx);
    if (ctx.dialect().variableRanges.namedLocal)
      return named(event, ctx);
    const Dialect &dialect = ctx.dialect();
    // Where programs share their variables, that of the caller counts.
    if ((ctx.callDepth() > 0 && !dialect.facts->variables.sharedByPrograms) || !isMain(ctx) ||
        (!event.certain && ctx.before().may(Fact::UnknownCode)))
      return;
    const llvm::StringRef text = ctx.source().text(event.place(), ctx.block().end);
    const llvm::StringRef name =
        text.take_while([](char c) { return llvm::isAlnum(c) || c == '_'; });
    int64_t index = 0;
    // What a code of the control gives its value: without the code it has that of another program.
    if (stored_.count(variableKey(name)) || stored_.count(keyOf(name))) {
      if (!event.certain)
        return;
      const SourceRange range{ctx.source().id(), event.place(),
                              uint32_t(event.place() + name.size())};
      if (memory().reported.insert(-1).second)
        if (auto finding = ctx.report(range))
          finding.message("`{0}` is read, and nothing in the program has given it a value", name);
      return;
    }
    // Other names may be defined outside of the program.
    if (!(name.startswith("R") || name.startswith("r")) ||
        name.drop_front().getAsInteger(10, index))
      return;
    // Those that the program cannot have: variable-index-out-of-range speaks.
    if ((greatest_ && index > greatest_) || (reservedFrom_ <= index && index <= reservedTo_) ||
        (index < volatileFrom_ && isCounter(event.place(), ctx)) ||
        !memory().reported.insert(index).second)
      return;
    const SourceRange range{ctx.source().id(), event.place(),
                            uint32_t(event.place() + name.size())};
    if (auto finding = ctx.report(range, event.certain))
      finding.message(event.certain
                          ? "`{0}` is read before the program has given it a value: it holds what "
                            "an earlier program left there"
                          : "`{0}` is read here, and not every path to here gives it a value: it "
                            "may hold what an earlier program left there",
                      name);
  }

private:
  /// `R60=R60+1`: a variable that keeps its value at power-off counts on from the run before, where
  /// nothing else of the program reads it.
  static bool isCounter(uint32_t place, RuleContext &ctx) {
    const auto item = llvm::find_if(ctx.block().items, [&](const Item &i) {
      return i.kind == ItemKind::Assignment && i.begin < place && place < i.end;
    });
    if (item == ctx.block().items.end())
      return false;
    const uint64_t key = ctx.block().keyOf(item->target);
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    unsigned reads = 0;
    for (const Block &block : blocks(ctx.index(), program.body, program.end))
      for (const ExpressionOp &op : block.operations) {
        reads += op.op == Op::Variable && uint64_t(op.value) == key;
        if (reads > 1)
          return false;
      }
    const Expression &value = ctx.block().expressions[item->value];
    return llvm::any_of(
        llvm::makeArrayRef(ctx.block().operations).slice(value.first, value.count),
        [&](const ExpressionOp &op) { return op.op == Op::Variable && uint64_t(op.value) == key; });
  }

  /// `DEF REAL A` has no value of its own until the program gives it one; what is called may give
  /// values to any.
  void statement(const Item &item, RuleContext &ctx) const {
    std::set<uint64_t> &bare = memory().bare;
    if (item.kind == ItemKind::Call)
      return bare.clear();
    const uint64_t key = item.target == noExpression ? 0 : ctx.block().keyOf(item.target);
    if (!key)
      return;
    if (item.kind == ItemKind::Definition && item.value == noExpression && !item.arguments &&
        (item.type == VariableType::Real || item.type == VariableType::Integer))
      bare.insert(key);
    else
      bare.erase(key);
  }

  /// The words of the block that read such a variable.
  void bareReads(RuleContext &ctx) const {
    std::set<uint64_t> &bare = memory().bare;
    if (bare.empty() || !ctx.asked())
      return;
    for (const Word &word : ctx.block().words) {
      if (!word.has(wordExpression) || size_t(word.mantissa) >= ctx.block().expressions.size())
        continue;
      const Expression &e = ctx.block().expressions[size_t(word.mantissa)];
      for (uint32_t i = 0; i < e.count; ++i) {
        const ExpressionOp &op = ctx.block().operations[e.first + i];
        if (op.op != Op::Variable || !bare.erase(uint64_t(op.value)))
          continue;
        if (auto finding = ctx.report(word))
          finding.severity(Severity::Style)
              .message("`{0}` reads a variable that is defined without a value: it is 0",
                       ctx.text(word));
      }
    }
  }

  bool commons_ = true;   ///< those that keep their values are looked at too
  bool numbered_ = false; ///< variables have numbers after `#`

  /// A local variable of a main program, or a common one that the program writes further on, has no
  /// value yet.
  void numbered(RuleContext &ctx) const {
    const Block &block = ctx.block();
    if (block.operations.empty())
      return sleepInShape();
    if (ctx.callDepth() > 0 || ctx.before().may(Fact::UnknownCode))
      return sleepAtBlock();
    // A test for empty reads no value.
    if (llvm::any_of(block.operations, [](const ExpressionOp &op) {
          return op.op == Op::Vacant || (op.op == Op::Variable && op.value == 0);
        }))
      return;
    for (const ExpressionOp &op : block.operations) {
      const bool target = llvm::any_of(block.items, [&](const Item &item) {
        return item.kind == ItemKind::Assignment && item.begin <= op.offset &&
               op.offset < item.nameEnd;
      });
      if (op.op == Op::Variable && !target)
        look(op, ctx);
    }
  }

  void look(const ExpressionOp &op, RuleContext &ctx) const {
    constexpr int64_t lastLocal = 33, firstCommon = 100, lastCommon = 199;
    const auto index = int64_t(op.value);
    const auto key = uint64_t(op.value);
    const bool local = index > 0 && index <= lastLocal;
    const bool common = index >= firstCommon && index <= lastCommon;
    if (!(local && ctx.before().locals.given(key) == Truth::No) &&
        !(common && commons_ && ctx.before().commons.given(key) == Truth::No &&
          isWrittenLater(index, ctx)))
      return;
    if (!isMain(ctx) || !memory().reported.insert(index).second)
      return;
    const llvm::StringRef digits = ctx.source().text(op.offset + 1, ctx.block().end);
    const SourceRange range{ctx.source().id(), op.offset,
                            op.offset + 1 + uint32_t(digits.take_while(llvm::isDigit).size())};
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message(local ? "`{0}` is read, and the program has given it no value"
                         : "`{0}` is read before the program gives it its value: it holds what an "
                           "earlier program left there",
                   ctx.text(range));
  }

  static bool isWrittenLater(int64_t index, const RuleContext &ctx) {
    constexpr unsigned readable = 5000; // blocks
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block : blocks(ctx.index(), ctx.block().next, program.end, readable))
      for (const Item &item : block.items)
        if (item.kind == ItemKind::Assignment && int64_t(block.keyOf(item.target)) == index)
          return true;
    return false;
  }

  /// `#<name>` does not exist before it has been given a value.
  void named(const Event &event, RuleContext &ctx) const {
    // A remapped code or a caller in another file may have given it one.
    if (ctx.before().may(Fact::UnknownCode) || !event.certain)
      return;
    const auto begin = event.place();
    const llvm::StringRef text = ctx.source().text(begin, ctx.block().end);
    const size_t close = text.find('>');
    if (close == llvm::StringRef::npos ||
        !memory().names.insert(text.take_front(close).upper()).second)
      return;
    const SourceRange range{ctx.source().id(), begin, uint32_t(begin + close + 1)};
    auto finding = ctx.report(range, event.certain);
    if (!finding)
      return;
    const std::string name = "#" + ctx.text(range).str();
    if (const auto given = givenToCaller(name, ctx)) {
      finding
          .message(
              "`{0}` is read in a subprogram, and it is its caller's: a name is known to other "
              "programs when it begins with `_`",
              name)
          .note(*given, "it is given its value here");
      return;
    }
    finding.message("`{0}` is read, and nothing in the program has given it a value", name);
  }

  /// Where the text before a called subprogram gives the name a value; of the first names alone.
  std::optional<SourceRange> givenToCaller(llvm::StringRef name, const RuleContext &ctx) const {
    constexpr size_t most = 20; // names, each of which is looked for in the whole text
    if (ctx.callDepth() == 0 || memory().names.size() > most)
      return std::nullopt;
    const llvm::StringRef before = ctx.source().text().take_front(ctx.block().begin);
    for (size_t at = before.find_insensitive(name); at != llvm::StringRef::npos;
         at = before.find_insensitive(name, at + 1)) {
      const llvm::StringRef line = before.take_front(at).rsplit('\n').second;
      if (line.trim().empty() && before.substr(at + name.size()).ltrim(" \t").startswith("="))
        return SourceRange{ctx.source().id(), uint32_t(at), uint32_t(at + name.size())};
    }
    return std::nullopt;
  }

  /// Key of a variable with a number after its letter.
  static uint64_t keyOf(llvm::StringRef name) {
    int64_t index = 0;
    return name.size() > 1 && !name.drop_front().getAsInteger(10, index)
               ? elementKey(variableKey(name.take_front()), index)
               : 0;
  }

  /// Whether the program with which the run began ends as a main program does, and is in a file of
  /// its own name.
  bool isMain(RuleContext &ctx) const {
    const CallSite *first = ctx.caller();
    while (first && first->before)
      first = first->before;
    if (first && !first->unit)
      return false;
    const FileIndex &index = first ? first->unit->index : ctx.index();
    const ProgramInfo &program = first ? *first->program : index.programAt(ctx.block().begin);
    const TextPlace place{index.source().id(), program.begin};
    if (program.kind == ProgramKind::Subprogram)
      return false;
    if (place == memory().known)
      return memory().main;
    memory().known = place;
    memory().main = false;
    constexpr uint32_t readable = 1u << 20;
    const uint32_t end = std::min(program.end, program.body + readable);
    for (const Block &block : blocks(index, program.body, end)) {
      if (llvm::any_of(block.items, [](const Item &i) { return i.kind == ItemKind::Parameters; }))
        return false;
      memory().main |=
          findCode(ctx.dialect(), block, {Action::ProgramEnd, Action::ProgramEndRewind}) != nullptr;
      if (findCode(ctx.dialect(), block, {Action::Return}))
        return memory().main = false;
    }
    return memory().main;
  }

  int64_t greatest_ = 0; ///< number of the last parameter; 0: not limited
  int64_t reservedFrom_ = 0, reservedTo_ = -1;
  int64_t volatileFrom_ = 0;  ///< parameters below it keep their values; 0: it is not known
  std::set<uint64_t> stored_; ///< keys of variables that codes give a value
};

} // namespace
NCVET_RULE(VariableReadBeforeWrite, variable_read_before_write)
} // namespace ncvet
