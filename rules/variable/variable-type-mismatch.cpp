// A text where a number is due, or a number where a text is.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/text/number_text.h"
#include "interp/evaluate/expression.h"

#include "llvm/ADT/StringMap.h"

#include <cmath>

namespace ncvet {
namespace {

class VariableTypeMismatch final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::Statement, EventKind::FlowIssue});
    to.onChange({EventKind::Block});
    for (const std::string &name : to.dialect().variableNames) {
      marked_ |= llvm::StringRef(name).startswith("%");
      types_[llvm::StringRef(name).ltrim('%')] = name;
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::FlowIssue) {
      if (event.flowIssue() == FlowIssue::ArgumentType)
        if (auto finding = ctx.report(ctx.flowRange(), event.certain))
          finding
              .message("`{0}` gives a text where the program takes a number",
                       ctx.text(ctx.flowRange()))
              .note(ctx.flowRelated(), "what the program takes");
      return;
    }
    if (event.kind == EventKind::Block) {
      if (ctx.block().expressions.empty())
        return sleepInShape();
      sleepAtBlock(); // unless it reads a variable
      truncated(ctx);
      return inWords(ctx);
    }
    sleepAtBlock();
    if (marked_)
      mark(ctx.block().items[event.item()], ctx);
    const Block &block = ctx.block();
    const Item &item = block.items[event.item()];
    if ((item.kind != ItemKind::Assignment && item.kind != ItemKind::Definition) ||
        item.value == noExpression || (item.kind == ItemKind::Definition && item.arguments))
      return;
    const SourceRange name{ctx.source().id(), item.nameBegin, item.nameEnd};
    VariableType type = item.type;
    if (item.kind == ItemKind::Assignment)
      type = typeOf(ctx.text(name), ctx);
    const Expression &value = block.expressions[item.value];
    const SourceRange range = ctx.range(value);
    const bool text = !value.bad && value.count == 1 && ctx.text(range).startswith("\"");
    const bool number = block.numberIn(item.value) && ctx.dialect().lexical.commaSeparates &&
                        !ctx.text(range).startswith("\"");
    const bool takesNumber = isNumber(type);
    const bool takesText = type == VariableType::String || type == VariableType::Axis;
    if (takesNumber && !text && operands(value, ctx.text(name), ctx))
      return;
    if (takesNumber && !text && textIn(range, ctx))
      return;
    if (takesText && !value.bad && value.count == 1 &&
        block.operations[value.first].op == Op::Variable &&
        isNumber(typeOf(ctx.text(range), ctx))) {
      if (auto finding = ctx.report(range))
        finding.message("`{0}` holds a number, and `{1}` takes none", ctx.text(range),
                        ctx.text(name));
      return;
    }
    if (!(text && takesNumber) && !(number && takesText))
      return;
    if (auto finding = ctx.report(range))
      finding.message(text ? "`{0}` is a text, and `{1}` holds numbers"
                           : "`{0}` is a number, and `{1}` holds none",
                      ctx.text(range), ctx.text(name));
  }

private:
  /// The mark of the type is a part of the name: `%` whole numbers, `%%` long ones.
  void mark(const Item &item, RuleContext &ctx) const {
    if (item.kind != ItemKind::Assignment)
      return;
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const llvm::StringRef name = ctx.text(range);
    const auto known = types_.find(name.ltrim('%'));
    if (known == types_.end() || name == known->second)
      return;
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("`{0}` is written `{1}`: the mark says what numbers it holds", name,
                   known->second)
          .fix(FixSafety::Unsafe, "write `" + known->second + "`",
               ctx.replace(range, known->second));
  }

  static bool isNumber(VariableType type) {
    return type == VariableType::Integer || type == VariableType::Real ||
           type == VariableType::Boolean;
  }

  /// Variables of texts, axes and frames among the operands of a calculation with numbers; true
  /// when one was reported. What compares or puts texts together is no such calculation.
  static bool operands(const Expression &e, llvm::StringRef taker, RuleContext &ctx) {
    if (e.bad || !ctx.dialect().lexical.commaSeparates)
      return false;
    const auto operations = llvm::makeArrayRef(ctx.block().operations).slice(e.first, e.count);
    for (const ExpressionOp &op : operations)
      if (op.op >= Op::Equal && op.op <= Op::Not)
        return false;
      else if (op.op == Op::Opaque || op.op == Op::Unknown || op.op == Op::VariableAt)
        return false;
    for (const ExpressionOp &op : operations) {
      if (op.op != Op::Variable && op.op != Op::ElementAt)
        continue;
      const llvm::StringRef name = nameAt(op.offset, ctx);
      const VariableType type = typeOf(name, ctx);
      if (type != VariableType::String && type != VariableType::Axis && type != VariableType::Frame)
        continue;
      if (auto finding = ctx.report(
              SourceRange{ctx.source().id(), op.offset, op.offset + uint32_t(name.size())}))
        finding.message("`{0}` holds {1}, and `{2}` takes a number", name,
                        type == VariableType::String ? "a text"
                        : type == VariableType::Axis ? "the name of an axis"
                                                     : "a frame",
                        taker);
      return true;
    }
    return false;
  }

  /// A variable that holds TRUE or FALSE gives a coordinate.
  static void truth(const Expression &value, const Word &word, RuleContext &ctx) {
    if (value.bad || value.count != 1 || ctx.block().operations[value.first].op != Op::Variable ||
        ctx.dialect().addresses[word.address].kind != AddressKind::Axis ||
        typeOf(ctx.text(ctx.range(value)), ctx) != VariableType::Boolean)
      return;
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Warning)
          .message("`{0}` holds TRUE or FALSE, and `{1}` takes a coordinate",
                   ctx.text(ctx.range(value)), ctx.text(word));
  }

  /// `5+"A"`: a text that is no argument of a function, and neither compared nor put together with
  /// another one.
  static bool textIn(SourceRange value, RuleContext &ctx) {
    const llvm::StringRef text = ctx.text(value);
    if (!ctx.dialect().lexical.commaSeparates || !text.contains('"') || text.contains("<<") ||
        text.contains('=') || text.contains("<>"))
      return false;
    int depth = 0;
    for (size_t i = 0; i < text.size(); ++i) {
      depth += text[i] == '(' || text[i] == '[';
      depth -= text[i] == ')' || text[i] == ']';
      if (text[i] != '"')
        continue;
      const size_t end = text.find('"', i + 1);
      if (end == llvm::StringRef::npos)
        return false;
      if (depth == 0) {
        const SourceRange range{value.file, uint32_t(value.begin + i),
                                uint32_t(value.begin + end + 1)};
        if (auto finding = ctx.report(range))
          finding.message("`{0}` is a text, and a number is due", ctx.text(range));
        return true;
      }
      i = end;
    }
    return false;
  }

  static llvm::StringRef nameAt(uint32_t offset, RuleContext &ctx) {
    return ctx.text(SourceRange{ctx.source().id(), offset, ctx.block().end}).take_while([](char c) {
      return llvm::isAlnum(c) || c == '_';
    });
  }

  /// Coordinates, feeds and the like that a variable of another type gives. A tool has a name too.
  static void inWords(RuleContext &ctx) {
    const Block &block = ctx.block();
    if (block.expressions.empty() || !ctx.dialect().lexical.commaSeparates)
      return;
    for (const Word &word : block.words) {
      if (!word.has(wordExpression) || word.address >= ctx.dialect().addresses.size() ||
          word.address == letterAddress('T'))
        continue;
      const AddressKind kind = ctx.dialect().addresses[word.address].kind;
      if (kind == AddressKind::Axis || kind == AddressKind::Increment ||
          kind == AddressKind::Parameter || kind == AddressKind::Polar) {
        const Expression &value = block.expressions[size_t(word.mantissa)];
        if (!operands(value, ctx.text(word), ctx) && !textIn(ctx.range(value), ctx))
          truth(value, word, ctx);
      }
    }
  }

  /// `T<FTL(R1)>`: what a fraction is cut off from names another tool or code.
  static void truncated(RuleContext &ctx) {
    constexpr AddressMask whole = lettersMask("GMT");
    if (ctx.block().expressions.empty() || !(ctx.block().addresses & whole))
      return;
    for (const Word &word : ctx.block().words) {
      if (!(whole & maskOf(word.address)) || !word.has(wordExpression))
        continue;
      const Expression &e = ctx.block().expressions[size_t(word.mantissa)];
      if (e.bad || e.count < 2 || ctx.block().operations[e.first + e.count - 1].op != Op::Truncate)
        continue;
      Block inner = ctx.block(); // the expression without its function
      --inner.expressions[size_t(word.mantissa)].count;
      // The assignments of the block itself come first.
      const Interval value = assignedWordValue(word, inner, ctx.after());
      if (!value.isConstant() || value.value() == std::floor(value.value()))
        continue;
      if (auto finding = ctx.report(word))
        finding.severity(Severity::Warning)
            .message("`{0}` cuts the fraction of {1} off", ctx.text(word),
                     shortNumber(value.value()));
    }
  }

  bool marked_ = false;                ///< names of variables have marks of their type
  llvm::StringMap<std::string> types_; ///< by name without its mark: with it

  static VariableType typeOf(llvm::StringRef name, RuleContext &ctx) {
    name = name.split('[').first.trim();
    int64_t index = 0;
    if ((name.startswith("R") || name.startswith("r")) &&
        !name.drop_front().getAsInteger(10, index))
      return VariableType::Real;
    const Defined *defined = ctx.index().definition(ctx.index().programAt(ctx.block().begin), name);
    return defined && defined->kind == ItemKind::Definition ? defined->type : VariableType::None;
  }
};

} // namespace
NCVET_RULE(VariableTypeMismatch, variable_type_mismatch)
} // namespace ncvet
