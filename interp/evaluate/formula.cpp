// Evaluates the formulas of the tables on a block and the state before it.
#include "interp/evaluate/formula.h"

#include "formats/dialect/variable_key.h"
#include "interp/evaluate/block_words.h"
#include "interp/evaluate/expression.h"
#include "interp/evaluate/operators.h"
#include "interp/evaluate/tool_data.h"
#include "interp/state/modes.h"

#include <array>
#include <cmath>

namespace ncvet {

namespace {

/// Numbers that the table's writer means to be equal differ by rounding at most.
constexpr double tolerance = 1e-9;

/// The operator that a step is; none for operands.
constexpr auto formulaOperators = [] {
  constexpr std::pair<FormulaOp, Operator> known[] = {
      {FormulaOp::Add, Operator::Add},           {FormulaOp::Subtract, Operator::Subtract},
      {FormulaOp::Multiply, Operator::Multiply}, {FormulaOp::Divide, Operator::Divide},
      {FormulaOp::Negate, Operator::Negate},     {FormulaOp::Absolute, Operator::Absolute},
      {FormulaOp::Floor, Operator::Floor},       {FormulaOp::Sine, Operator::Sine},
      {FormulaOp::Cosine, Operator::Cosine},     {FormulaOp::SquareRoot, Operator::SquareRoot},
      {FormulaOp::Minimum, Operator::Minimum},   {FormulaOp::Maximum, Operator::Maximum},
      {FormulaOp::Less, Operator::Less},         {FormulaOp::LessEqual, Operator::LessEqual},
      {FormulaOp::Equal, Operator::Equal},       {FormulaOp::NotEqual, Operator::NotEqual},
      {FormulaOp::And, Operator::And},           {FormulaOp::Or, Operator::Or},
      {FormulaOp::Not, Operator::Not},           {FormulaOp::Select, Operator::Select},
  };
  std::array<std::optional<Operator>, size_t(FormulaOp::Select) + 1> table;
  for (const auto &[op, is] : known)
    table[size_t(op)] = is;
  return table;
}();

class FormulaEvaluator {
public:
  FormulaEvaluator(const CodeInfo &code, const ConditionContext &context)
      : code_(code), context_(context) {}

  Interval run(const Formula &formula) {
    names_ = formula.names;
    for (const FormulaStep &step : formula.steps)
      if (const auto known = formulaOperators[size_t(step.op)])
        stack_.apply(*known);
      else
        stack_.push(Value::of(operand(step)));
    return stack_.result().asNumber();
  }
  /// Whether all words that the formula names are there.
  bool complete(const Formula &formula) const {
    return llvm::all_of(formula.steps, [&](const FormulaStep &step) {
      return step.op == FormulaOp::Word       ? given(code_.words[step.index]) != Truth::No
             : step.op == FormulaOp::Address  ? address(step.index).has_value()
             : step.op == FormulaOp::Variable ? given(uint64_t(step.number)) != Truth::No
                                              : true;
    });
  }

private:
  Truth given(const WordSpec &spec) const {
    return wordFor(context_.block, spec) || kept(spec) ? Truth::Yes
                                                       : givenBefore(spec, context_.before);
  }
  /// The word that the active cycle keeps of an earlier block.
  std::optional<Interval> kept(const WordSpec &spec) const {
    if (!context_.keptWords || spec.variable)
      return std::nullopt;
    const CycleWords &words = context_.before.cycle;
    const uint64_t places = spec.position ? uint64_t(1) << (spec.position - 1) : spec.any;
    for (unsigned place = 0; place < words.value.size(); ++place)
      if (places & words.present & (1u << place))
        return std::isnan(words.value[place]) ? Interval::unknown()
                                              : Interval::exactly(words.value[place]);
    return std::nullopt;
  }
  /// The word with that address in the block, or kept of an earlier one.
  std::optional<Interval> address(uint16_t index) const {
    if (const Word *word = context_.block.find(AddressId(index)))
      return wordValue(*word, context_.block, context_.before);
    const CycleWords &words = context_.before.cycle;
    if (!context_.keptWords || index >= words.value.size() || !(words.present >> index & 1))
      return std::nullopt;
    return std::isnan(words.value[index]) ? Interval::unknown()
                                          : Interval::exactly(words.value[index]);
  }
  Truth given(uint64_t variable) const {
    return assigned(variable) ? Truth::Yes : context_.before.commons.given(variable);
  }
  Interval word(const WordSpec &spec) const {
    if (const Word *word = wordFor(context_.block, spec))
      return wordValue(*word, context_.block, context_.before);
    if (const auto before = kept(spec))
      return *before;
    if (spec.absent)
      return given(spec) == Truth::No ? Interval::exactly(*spec.absent) : Interval::unknown();
    if (!spec.variable)
      return Interval::unknown();
    const Value value = readVariable(context_.before, int64_t(spec.variable));
    return value.kind == Value::Kind::Number ? value.number : Interval::unknown();
  }
  Interval tool() const {
    const ToolData *tool = toolInUse(context_.machine, context_.before);
    const auto radius =
        tool && tool->radius
            ? tool->radius
            : compensationRadius(context_.dialect, context_.machine, context_.before);
    return radius ? Interval::exactly(*radius) : Interval::unknown();
  }

  /// Number of the work offset in force, when its code has it after the point.
  Interval origin() const {
    const CodeInfo *code = context_.before.activeCode(context_.dialect, StandardGroup::WorkOffset);
    int number = 0;
    if (!code || llvm::StringRef(code->name).rsplit('.').second.getAsInteger(10, number))
      return Interval::unknown();
    return Interval::exactly(number);
  }

  /// The block's own assignment to a variable, or null.
  const Item *assigned(uint64_t key) const {
    const Item *last = nullptr;
    for (const Item &item : context_.block.items)
      if (item.kind == ItemKind::Assignment && context_.block.keyOf(item.target) == key)
        last = &item;
    return last;
  }
  Value variable(uint64_t key) const {
    if (const Item *item = assigned(key))
      return evaluateInBlock(context_.block, item->value, context_.before);
    return readVariable(context_.before, int64_t(key));
  }

  /// Length of the block's comment for the operator, without its brackets; 0: there is none.
  double note() const {
    constexpr unsigned brackets = 2;
    for (const Comment &comment : context_.block.comments)
      if (comment.shown)
        return comment.end - comment.begin - brackets;
    return 0;
  }
  /// Where the axis is before the block; not known in machine coordinates.
  Interval place(Axis axis) const {
    return axis == Axis::Count || context_.before.inMachineCoordinates(axis)
               ? Interval::unknown()
               : context_.before.at(axis);
  }
  static Interval numberIn(const Value &value) {
    return value.kind == Value::Kind::Number ? value.number : Interval::unknown();
  }
  /// The variable of several with one name that the place on top of the stack means.
  Interval element(const std::string &list) {
    const Interval place = stack_.pop().asNumber();
    if (!place.isConstant())
      return Interval::unknown();
    return numberIn(readVariable(context_.before, int64_t(elementOf(list, place.value()))));
  }

  Interval operand(const FormulaStep &step) {
    switch (step.op) {
    case FormulaOp::Number:
      return Interval::exactly(step.number);
    case FormulaOp::Word:
      return word(code_.words[step.index]);
    case FormulaOp::Address:
      return address(step.index).value_or(Interval::unknown());
    case FormulaOp::Given:
      return numberOf(given(code_.words[step.index]));
    case FormulaOp::GivenAddress:
      return Interval::exactly(address(step.index).has_value());
    case FormulaOp::Variable:
      return numberIn(variable(uint64_t(step.number)));
    case FormulaOp::GivenVariable:
      return numberOf(given(uint64_t(step.number)));
    case FormulaOp::Element:
      return element(names_[step.index]);
    case FormulaOp::Here:
      return Interval::exactly(wordFor(context_.block, code_.words[step.index]) != nullptr);
    case FormulaOp::Bare: {
      const Word *word = context_.block.find(AddressId(step.index));
      return Interval::exactly(word && word->has(wordNoValue));
    }
    case FormulaOp::Length: {
      const Word *word = wordFor(context_.block, code_.words[step.index]);
      return word ? Interval::exactly(context_.block.endOf(*word) - word->offset)
                  : Interval::unknown();
    }
    case FormulaOp::Note:
      return Interval::exactly(note());
    case FormulaOp::Index:
      return Interval::exactly(context_.index);
    case FormulaOp::Option: {
      const auto number = context_.machine.number(names_[step.index]);
      return number ? Interval::exactly(*number) : Interval::unknown();
    }
    default:
      return ofState(step);
    }
  }

  /// The least increment of a length in the program's unit.
  Interval increment() const {
    const MachineState &before = context_.before;
    const VariableRanges &ranges = context_.dialect.variableRanges;
    const uint64_t set = ranges.units == noGroup ? groupUnset : before.group(ranges.units);
    constexpr double metric = 0.001, inch = 0.0001;
    if (!(set & ranges.inch))
      return Interval::exactly(metric);
    return set & ~ranges.inch ? Interval::unknown() : Interval::exactly(inch);
  }

  /// The offset in force. One that was switched off before the tool was changed is not that of the
  /// new tool: the change brings its first edge.
  Interval edge() const {
    const MachineState &before = context_.before;
    const Origin &off = before.origin.of(StatePart::RadiusOffset);
    const Origin &tool = before.origin.of(StatePart::Tool);
    if (before.radiusOffset < 0 || (before.radiusOffset == 0 && off.known() && tool.known() &&
                                    off.file == tool.file && off.begin < tool.begin))
      return Interval::unknown();
    return Interval::exactly(before.radiusOffset);
  }

  /// What the state before the block says.
  Interval ofState(const FormulaStep &step) const {
    const MachineState &before = context_.before;
    switch (step.op) {
    case FormulaOp::ToolRadius:
      return tool();
    case FormulaOp::Tool:
      return before.tool >= 0 ? Interval::exactly(before.tool) : Interval::unknown();
    case FormulaOp::Edge:
      return edge();
    case FormulaOp::Level:
      return place(toolAxis(context_.dialect, before));
    case FormulaOp::Feed:
      return before.feed;
    case FormulaOp::Speed:
      return before.speed;
    case FormulaOp::Place:
      return place(context_.dialect.addresses[step.index].axis);
    case FormulaOp::Origin:
      return origin();
    case FormulaOp::Increment:
      return increment();
    default:
      return Interval::unknown();
    }
  }

  const CodeInfo &code_;
  const ConditionContext &context_;
  OperatorStack stack_{{tolerance, /*strict=*/false}};
  llvm::ArrayRef<std::string> names_; ///< of the current formula
};

} // namespace

uint64_t elementOf(llvm::StringRef list, double place) {
  if (list == "#" && place >= 0) // the variables that have a number alone
    return uint64_t(std::llround(place));
  return variableKey((list + "[" + llvm::Twine(std::llround(place)) + "]").str());
}

Truth truthOf(const Formula &formula, const CodeInfo &code, const ConditionContext &context) {
  return truthOf(FormulaEvaluator(code, context).run(formula));
}

Interval levelOf(const Formula &formula, const CodeInfo &code, const ConditionContext &context) {
  return FormulaEvaluator(code, context).run(formula);
}

std::optional<Interval> valueOf(const Formula &formula, const CodeInfo &code,
                                const ConditionContext &context) {
  FormulaEvaluator evaluator(code, context);
  if (!evaluator.complete(formula))
    return std::nullopt;
  return evaluator.run(formula);
}

std::optional<Interval> valueOfGiven(const Formula &formula, const CodeInfo &code,
                                     const ConditionContext &context) {
  FormulaEvaluator evaluator(code, context);
  const Interval value = evaluator.run(formula);
  if (value.isUnknown() && !evaluator.complete(formula))
    return std::nullopt;
  return value;
}

} // namespace ncvet
