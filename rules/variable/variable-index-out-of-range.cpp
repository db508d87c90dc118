// A variable or an element that the control does not have.
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/expression.h"

#include "llvm/ADT/StringExtras.h"

#include <cmath>
#include <set>

namespace ncvet {
namespace {

struct VariableIndexOutOfRangeMemory {
  std::set<std::string> spoken; ///< variables that were looked at, in capitals
};

class VariableIndexOutOfRange final : public StatefulRule<VariableIndexOutOfRangeMemory> {
public:
  void listen(Subscriptions &to) override {
    greatest_ = int64_t(to.dialect().facts->variables.greatest);
    reservedFrom_ = int64_t(to.dialect().facts->variables.reservedFrom);
    reservedTo_ = int64_t(to.dialect().facts->variables.reservedTo);
    numbered_ = to.dialect().facts->variables.numbered;
    gaps_ = to.dialect().facts->variables.gaps;
    frameParts_ = to.dialect().facts->variables.frameParts;
    named_ = greatest_ || to.dialect().lexical.commaSeparates;
    to.on(EventKind::Statement);
    to.onChange({EventKind::Block});
    if (reservedFrom_) // what nobody can write is read without a value
      to.on(EventKind::UnsetRead);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Block && gaps_.empty() && ctx.block().operations.empty())
      return sleepInShape();
    sleepAtBlock(); // unless it computes an index
    if (event.kind == EventKind::Block && !gaps_.empty())
      return inGaps(ctx);
    if (event.kind == EventKind::Block) {
      if (!frameParts_.empty())
        frames(ctx);
      return numbered_ ? numbersRead(ctx) : elements(ctx);
    }
    if (event.kind == EventKind::UnsetRead) {
      const auto begin = event.place();
      const llvm::StringRef name = ctx.source().text(begin, ctx.block().end).take_while([](char c) {
        return llvm::isAlnum(c);
      });
      return parameter(name, {ctx.source().id(), begin, uint32_t(begin + name.size())}, ctx);
    }
    const Item &item = ctx.block().items[event.item()];
    if (named_ && item.value != noExpression)
      settings(item, ctx);
    const SourceRange place{ctx.source().id(), item.nameBegin, item.nameEnd};
    if (item.kind == ItemKind::Assignment && numbered_)
      return numbered(item, ctx);
    if (!named_ || (item.kind != ItemKind::Assignment && item.kind != ItemKind::Input))
      return;
    parameter(ctx.text(place).rtrim(), place, ctx);
    if (item.nameEnd > item.nameBegin)
      memory().spoken.insert(ctx.text(place).rtrim().upper());
  }

private:
  /// `$P_UIFR[1,X,TX]`: the last index of a frame is one of its parts.
  void frames(RuleContext &ctx) const {
    const llvm::StringRef text =
        ctx.source().text(ctx.block().begin, ctx.block().end).split(';').first;
    for (size_t at = text.find("$P_"); at != llvm::StringRef::npos; at = text.find("$P_", at + 1)) {
      const llvm::StringRef rest = text.drop_front(at);
      const size_t open =
          rest.find_if_not([](char c) { return llvm::isAlnum(c) || c == '_' || c == '$'; });
      const llvm::StringRef name = rest.take_front(open);
      // The names of the control's frames end so.
      if (open == llvm::StringRef::npos || rest[open] != '[' ||
          !(name.endswith_insensitive("FR") || name.endswith_insensitive("FRAME")))
        continue;
      const auto length = lengthInBrackets(rest.drop_front(open + 1));
      if (!length)
        continue;
      llvm::SmallVector<llvm::StringRef, 3> indices;
      rest.substr(open + 1, *length).split(indices, ',');
      const llvm::StringRef part = indices.back().trim();
      const bool isName = (part.size() == 2 && llvm::all_of(part, llvm::isAlpha)) ||
                          ctx.dialect().keyword(part) != noCode;
      if (indices.size() < 2 || !isName ||
          llvm::any_of(frameParts_,
                       [&](llvm::StringRef one) { return part.equals_insensitive(one); }) ||
          ctx.index().definition(ctx.index().programAt(ctx.block().begin), part))
        continue;
      const auto begin = uint32_t(ctx.block().begin + at);
      if (auto finding = ctx.report(
              SourceRange{ctx.source().id(), begin, uint32_t(begin + open + *length + 2)}))
        finding.message("`{0}` is no part of a frame: they are {1}", part,
                        llvm::join(frameParts_, ", "));
    }
  }

  std::vector<std::string> frameParts_; ///< names
  std::vector<int> gaps_;               ///< first and last number of each range without variables

  /// `#50`, written or read, where the control has none of that number.
  void inGaps(RuleContext &ctx) const {
    const Block &block = ctx.block();
    const auto look = [&](uint32_t begin, llvm::StringRef digits) {
      digits = digits.take_while(llvm::isDigit);
      int64_t index = 0;
      if (digits.getAsInteger(10, index))
        return;
      for (size_t i = 0; i + 1 < gaps_.size(); i += 2) {
        if (index < gaps_[i] || index > gaps_[i + 1])
          continue;
        const SourceRange range{ctx.source().id(), begin, begin + 1 + uint32_t(digits.size())};
        if (auto finding = ctx.report(range))
          finding.severity(Severity::Warning)
              .message("`{0}`: the control has no variables #{1} to #{2}", ctx.text(range),
                       gaps_[i], gaps_[i + 1]);
      }
    };
    for (const Item &item : block.items)
      if (item.kind == ItemKind::Assignment && item.nameBegin > item.begin)
        look(item.begin, ctx.source().text(item.nameBegin, item.nameEnd));
    for (const ExpressionOp &op : block.operations) {
      llvm::StringRef digits = ctx.source().text(op.offset, block.end);
      const bool target = llvm::any_of(block.items, [&](const Item &item) {
        return item.kind == ItemKind::Assignment && item.begin <= op.offset &&
               op.offset < item.nameEnd;
      });
      if (op.op == Op::Variable && !target && digits.consume_front("#"))
        look(op.offset, digits);
    }
  }

  /// `FIELD[1]=SET(1,2,3)`: more values than the array has elements from there on.
  static void settings(const Item &item, RuleContext &ctx) {
    const SourceRange range{ctx.source().id(), ctx.block().expressions[item.value].begin, item.end};
    llvm::StringRef values = ctx.text(range).trim();
    if (!values.consume_front_insensitive("SET") || !(values = values.ltrim()).startswith("(") ||
        !values.endswith(")") || (item.kind == ItemKind::Definition && !item.arguments))
      return;
    values = values.drop_front().drop_back();
    int depth = 0;
    double count = 1;
    for (const char c : values) {
      depth += c == '(' || c == '[';
      depth -= c == ')' || c == ']';
      count += c == ',' && depth == 0;
    }
    const llvm::StringRef target =
        ctx.text(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd});
    const auto [array, rest] = target.split('[');
    int64_t first = 0;
    if (item.kind == ItemKind::Assignment &&
        (rest.empty() || rest.split(']').first.trim().getAsInteger(10, first)))
      return;
    const auto elements = elementsOf(array.trim(), ctx);
    if (!elements || double(first) + count <= *elements)
      return;
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("`{0}` has {1} values, and `{2}` has {3} elements from there on",
                   ctx.text(range), count, array.trim(), *elements - double(first));
  }

  /// Elements of an array of one dimension that the program defines with a number.
  static std::optional<double> elementsOf(llvm::StringRef array, RuleContext &ctx) {
    const Defined *defined =
        ctx.index().definition(ctx.index().programAt(ctx.block().begin), array);
    if (!defined || !defined->array)
      return std::nullopt;
    Block block;
    ctx.index().read(ctx.source().lines().lineBegin(defined->begin), block);
    for (const Item &definition : block.items) {
      if (definition.kind != ItemKind::Definition || definition.nameBegin != defined->begin)
        continue;
      const auto sizes = block.argumentsOf(definition);
      return sizes.size() == 1 ? block.numberIn(sizes[0].expression) : std::nullopt;
    }
    return std::nullopt;
  }

  /// `R2050`, one of the control's parameters.
  void parameter(llvm::StringRef name, SourceRange place, RuleContext &ctx) const {
    int64_t index = 0;
    if (!greatest_ || !name.startswith_insensitive("R") ||
        name.drop_front().getAsInteger(10, index))
      return;
    const bool reserved = reservedFrom_ <= index && index <= reservedTo_;
    if (index <= greatest_ && !reserved)
      return;
    auto finding = ctx.report(place);
    if (finding && reserved)
      finding.message("`{0}`: the control keeps R{1} to R{2} for itself", name, reservedFrom_,
                      reservedTo_);
    else if (finding)
      finding.message("`{0}`: the control has the parameters R0 to R{1}", name, greatest_);
  }

  /// `#5603 = 1` of a control with fewer variables.
  void numbered(const Item &item, RuleContext &ctx) const {
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const llvm::StringRef name = ctx.text(range);
    int64_t index = 0;
    if (name.getAsInteger(10, index) || (index > 0 && index <= greatest_))
      return;
    if (auto finding = ctx.report(range))
      finding.message("`#{0}`: the control has the variables #1 to #{1}", name, greatest_);
  }

  /// `X#6000`, anywhere but on the left of `=`.
  void numbersRead(RuleContext &ctx) const {
    const Block &block = ctx.block();
    for (const ExpressionOp &op : block.operations) {
      llvm::StringRef digits = ctx.source().text(op.offset, block.end);
      int64_t index = 0;
      if (op.op != Op::Variable || !digits.consume_front("#"))
        continue;
      digits = digits.take_while(llvm::isDigit);
      const bool assigned = llvm::any_of(block.items, [&](const Item &item) {
        return item.kind == ItemKind::Assignment && item.begin <= op.offset &&
               op.offset < item.nameEnd;
      });
      if (assigned || digits.getAsInteger(10, index) || (index > 0 && index <= greatest_))
        continue;
      const SourceRange range{ctx.source().id(), op.offset,
                              op.offset + 1 + uint32_t(digits.size())};
      if (auto finding = ctx.report(range))
        finding.message("`{0}`: the control has the variables #1 to #{1}", ctx.text(range),
                        greatest_);
    }
  }

  /// Whatever the block's calculations name: `R300` where there are fewer, `FIELD[2,5]` of a
  /// smaller array.
  void elements(RuleContext &ctx) const {
    if (!ctx.dialect().lexical.commaSeparates)
      return;
    for (const Expression &expression : ctx.block().expressions)
      for (uint32_t i = 0; i < expression.count; ++i)
        operation(expression, i, ctx);
  }

  void operation(const Expression &expression, uint32_t place, RuleContext &ctx) const {
    const ExpressionOp &op = operationsOf(ctx.block(), expression)[place];
    if (op.op != Op::Variable && op.op != Op::ElementAt && op.op != Op::ElementKey &&
        op.op != Op::Opaque)
      return;
    const llvm::StringRef rest =
        ctx.text(SourceRange{ctx.source().id(), op.offset, ctx.block().end});
    const llvm::StringRef name =
        rest.take_while([](char c) { return llvm::isAlnum(c) || c == '_'; });
    if (name.empty() || llvm::isDigit(name[0]))
      return;
    if (op.op == Op::Variable) {
      // Where some are the control's own, reading is looked at apart. One place is enough.
      if (greatest_ && !reservedFrom_ && memory().spoken.insert(name.upper()).second)
        parameter(name, {ctx.source().id(), op.offset, op.offset + uint32_t(name.size())}, ctx);
      return;
    }
    if (!rest.drop_front(name.size()).startswith("["))
      return;
    std::optional<double> index;
    if (op.op != Op::Opaque)
      if (const Value value = operandOf(ctx.block(), expression, place, ctx.before());
          value.isConstant())
        index = value.number.value();
    if (greatest_ && index && name.equals_insensitive("R"))
      return computed(std::llround(*index), op.offset, rest.drop_front(name.size() + 1), ctx);
    element(op.offset, name, index, rest.drop_front(name.size() + 1), ctx);
  }

  /// `R[R2+1]` whose number is known; `rest` begins after the bracket.
  void computed(int64_t number, uint32_t offset, llvm::StringRef rest, RuleContext &ctx) const {
    const std::optional<size_t> close = lengthInBrackets(rest);
    if (!close || (number >= 0 && number <= greatest_))
      return;
    const SourceRange range{ctx.source().id(), offset, offset + uint32_t(*close) + 3};
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is R{1}: the control has the parameters R0 to R{2}", ctx.text(range),
                      number, greatest_);
  }

  /// Length of what is up to the bracket that closes.
  static std::optional<size_t> lengthInBrackets(llvm::StringRef rest) {
    unsigned open = 1;
    for (size_t i = 0; i < rest.size() && rest[i] != '\r' && rest[i] != '\n' && rest[i] != ';'; ++i)
      if (rest[i] == '[')
        ++open;
      else if (rest[i] == ']' && --open == 0)
        return i;
    return std::nullopt;
  }

  /// Whether the expression has the variable, other than as the index of an array.
  static bool reads(const Block &block, uint16_t index, uint64_t key) {
    if (index >= block.expressions.size())
      return false;
    const auto operations = operationsOf(block, block.expressions[index]);
    for (size_t i = 0; i < operations.size(); ++i)
      if (operations[i].op == Op::Variable && uint64_t(operations[i].value) == key &&
          (i + 1 == operations.size() || operations[i + 1].op != Op::ElementAt))
        return true;
    return false;
  }

  /// Whether the index is a variable that counts passes (`B=B+1`), and neither a condition nor a
  /// FOR around the block is made with it: something else decides how many passes there are.
  static bool countsUndecided(llvm::StringRef name, const ProgramInfo &program,
                              const RuleContext &ctx) {
    if (name.empty() || !llvm::all_of(name, [](char c) { return llvm::isAlnum(c) || c == '_'; }))
      return false;
    const uint64_t key = variableKey(name);
    bool counts = false;
    std::vector<bool> loops; // the FORs that are open, and whether each counts with the variable
    for (const Block &block : blocks(ctx.index(), program.body, program.end)) {
      if (block.begin == ctx.block().begin && llvm::is_contained(loops, true))
        return false;
      for (const Item &item : block.items) {
        const bool own = item.target != noExpression && block.keyOf(item.target) == key;
        if (reads(block, item.condition, key))
          return false;
        counts |= own && item.kind == ItemKind::Assignment && reads(block, item.value, key);
        if (item.kind == ItemKind::Structure && item.structure == Structure::For)
          loops.push_back(own);
        else if (item.kind == ItemKind::Structure && item.structure == Structure::EndFor &&
                 !loops.empty())
          loops.pop_back();
      }
    }
    return counts;
  }

  /// `FIELD[2,5]`: `rest` begins after the bracket. Of several indices only numbers are looked at;
  /// one alone may be computed: `computed`.
  static void element(uint32_t offset, llvm::StringRef array, std::optional<double> computed,
                      llvm::StringRef rest, RuleContext &ctx) {
    const std::optional<size_t> close = lengthInBrackets(rest);
    if (!close)
      return;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const Defined *defined = ctx.index().definition(program, array);
    if (!defined || !defined->array)
      return;
    llvm::SmallVector<llvm::StringRef, 3> indices;
    rest.take_front(*close).split(indices, ',');
    Block block;
    ctx.index().read(ctx.source().lines().lineBegin(defined->begin), block);
    for (const Item &definition : block.items) {
      if (definition.kind != ItemKind::Definition || definition.nameBegin != defined->begin)
        continue;
      const auto sizes = block.argumentsOf(definition);
      for (size_t i = 0; i < indices.size() && i < sizes.size(); ++i) {
        int64_t index = 0;
        const bool written = !indices[i].trim().getAsInteger(10, index);
        if (!written && (sizes.size() > 1 || !computed))
          continue;
        if (!written)
          index = std::llround(*computed);
        const auto elements = block.numberIn(sizes[i].expression);
        if (!elements || *elements <= 0 || (index >= 0 && double(index) < *elements))
          continue;
        const SourceRange range{ctx.source().id(), offset,
                                offset + uint32_t(array.size() + *close + 2)};
        const bool counts = !written && countsUndecided(indices[i].trim(), program, ctx);
        if (auto finding = ctx.report(range))
          finding.severity(counts ? std::optional(Severity::Style) : std::nullopt)
              .message(sizes.size() == 1
                           ? "`{0}`: the elements of `{1}` are numbered 0 to {2}"
                           : "`{0}`: the elements of `{1}` are numbered 0 to {2} in place {3}",
                       ctx.text(range), array, int64_t(*elements) - 1, i + 1)
              .note(ctx.range(definition),
                    written ? std::string("it is defined here")
                            : formatted("it is defined here; the index is {0}", index));
        return;
      }
    }
  }

  int64_t greatest_ = 0;
  bool named_ = false;    ///< the control has parameters with a letter, or arrays
  bool numbered_ = false; ///< variables have numbers after `#`
  int64_t reservedFrom_ = 0, reservedTo_ = -1; ///< of the control itself
};

} // namespace
NCVET_RULE(VariableIndexOutOfRange, variable_index_out_of_range)
} // namespace ncvet
