// Evaluates the formulas of the tables on a block and the state before it.
#include "interp/evaluate/formula.h"

#include "formats/dialect/variable_key.h"
#include "interp/evaluate/block_words.h"
#include "interp/evaluate/expression.h"
#include "interp/evaluate/tool_data.h"
#include "interp/state/modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ncvet {

namespace {

/// Numbers that the table's writer means to be equal differ by rounding at most.
constexpr double tolerance = 1e-9;

Interval numberOf(Truth truth) {
  return truth == Truth::Unknown ? Interval{0, 1} : Interval::exactly(truth == Truth::Yes);
}

Truth toTruth(const Interval &value) {
  if (value.isConstant())
    return value.value() != 0 ? Truth::Yes : Truth::No;
  return value.lo > 0 || value.hi < 0 ? Truth::Yes : Truth::Unknown;
}

Truth answer(bool yes, bool no) { return yes ? Truth::Yes : no ? Truth::No : Truth::Unknown; }

Truth negated(Truth truth) {
  return truth == Truth::Yes ? Truth::No : truth == Truth::No ? Truth::Yes : Truth::Unknown;
}

Interval absolute(const Interval &x) {
  if (x.lo >= 0)
    return x;
  if (x.hi <= 0)
    return x * -1;
  return {0, std::max(-x.lo, x.hi)};
}

class FormulaEvaluator {
public:
  FormulaEvaluator(const CodeInfo &code, const ConditionContext &context)
      : code_(code), context_(context) {}

  Interval run(const Formula &formula) {
    names_ = formula.names;
    for (const FormulaStep &step : formula.steps)
      this->step(step);
    return stack_.size() == 1 ? stack_.back() : Interval::unknown();
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
  Interval pop() { return stack_.empty() ? Interval::unknown() : stack_.pop_back_val(); }
  void push(const Interval &value) { stack_.push_back(value); }

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

  void step(const FormulaStep &step) {
    switch (step.op) {
    case FormulaOp::Number:
      return push(Interval::exactly(step.number));
    case FormulaOp::Word:
      return push(word(code_.words[step.index]));
    case FormulaOp::Address:
      return push(address(step.index).value_or(Interval::unknown()));
    case FormulaOp::Given:
      return push(numberOf(given(code_.words[step.index])));
    case FormulaOp::GivenAddress:
      return push(Interval::exactly(address(step.index).has_value()));
    case FormulaOp::Variable: {
      const Value value = variable(uint64_t(step.number));
      return push(value.kind == Value::Kind::Number ? value.number : Interval::unknown());
    }
    case FormulaOp::GivenVariable:
      return push(numberOf(given(uint64_t(step.number))));
    case FormulaOp::ToolRadius:
      return push(tool());
    case FormulaOp::Tool:
      return push(context_.before.tool >= 0 ? Interval::exactly(context_.before.tool)
                                            : Interval::unknown());
    case FormulaOp::Level: {
      const Axis axis = toolAxis(context_.dialect, context_.before);
      return push(context_.before.inMachineCoordinates(axis) ? Interval::unknown()
                                                             : context_.before.at(axis));
    }
    case FormulaOp::Feed:
      return push(context_.before.feed);
    case FormulaOp::Speed:
      return push(context_.before.speed);
    case FormulaOp::Here:
      return push(Interval::exactly(wordFor(context_.block, code_.words[step.index]) != nullptr));
    case FormulaOp::Bare: {
      const Word *word = context_.block.find(AddressId(step.index));
      return push(Interval::exactly(word && word->has(wordNoValue)));
    }
    case FormulaOp::Note: {
      const auto note =
          llvm::find_if(context_.block.comments, [](const Comment &c) { return c.shown; });
      constexpr unsigned brackets = 2;
      return push(Interval::exactly(
          note == context_.block.comments.end() ? 0 : note->end - note->begin - brackets));
    }
    case FormulaOp::Place: {
      const Axis axis = context_.dialect.addresses[step.index].axis;
      return push(axis == Axis::Count || context_.before.inMachineCoordinates(axis)
                      ? Interval::unknown()
                      : context_.before.at(axis));
    }
    case FormulaOp::Origin:
      return push(origin());
    case FormulaOp::Length: {
      const Word *word = wordFor(context_.block, code_.words[step.index]);
      return push(word ? Interval::exactly(context_.block.endOf(*word) - word->offset)
                       : Interval::unknown());
    }
    case FormulaOp::Floor: {
      const Interval x = pop(); // of a number that is whole but for its rounding, the number
      return push({std::floor(x.lo + tolerance), std::floor(x.hi + tolerance)});
    }
    case FormulaOp::Index:
      return push(Interval::exactly(context_.index));
    case FormulaOp::Unknown:
      return push(Interval::unknown());
    case FormulaOp::SquareRoot: {
      const Interval x = pop();
      return push(x.isConstant() && x.value() >= 0 ? Interval::exactly(std::sqrt(x.value()))
                                                   : Interval::unknown());
    }
    case FormulaOp::Option: {
      const auto number = context_.machine.number(names_[step.index]);
      return push(number ? Interval::exactly(*number) : Interval::unknown());
    }
    case FormulaOp::Sine:
    case FormulaOp::Cosine: {
      const Interval degrees = pop();
      if (!degrees.isConstant())
        return push(Interval::unknown());
      const double angle = degrees.value() * std::numbers::pi / 180;
      return push(
          Interval::exactly(step.op == FormulaOp::Sine ? std::sin(angle) : std::cos(angle)));
    }
    case FormulaOp::Element: {
      const Interval place = pop();
      if (!place.isConstant())
        return push(Interval::unknown());
      const Value value =
          readVariable(context_.before, int64_t(elementOf(names_[step.index], place.value())));
      return push(value.kind == Value::Kind::Number ? value.number : Interval::unknown());
    }
    case FormulaOp::Negate:
      return push(pop() * -1);
    case FormulaOp::Absolute:
      return push(absolute(pop()));
    case FormulaOp::Not:
      return push(numberOf(negated(toTruth(pop()))));
    default:
      break;
    }
    const Interval b = pop(), a = pop();
    if (step.op == FormulaOp::Select) {
      const Truth holds = toTruth(pop());
      return push(holds == Truth::Yes ? a : holds == Truth::No ? b : join(a, b));
    }
    switch (step.op) {
    case FormulaOp::Add:
      return push(a + b);
    case FormulaOp::Subtract:
      return push(a - b);
    case FormulaOp::Multiply:
      return push(b.isConstant()   ? a * b.value()
                  : a.isConstant() ? b * a.value()
                                   : Interval::unknown());
    case FormulaOp::Divide:
      return push(b.isConstant() && b.value() != 0 ? a * (1 / b.value()) : Interval::unknown());
    case FormulaOp::Minimum:
      return push({std::min(a.lo, b.lo), std::min(a.hi, b.hi)});
    case FormulaOp::Maximum:
      return push({std::max(a.lo, b.lo), std::max(a.hi, b.hi)});
    case FormulaOp::Less:
      return push(numberOf(answer(a.hi < b.lo - tolerance, a.lo >= b.hi - tolerance)));
    case FormulaOp::LessEqual:
      return push(numberOf(answer(a.hi <= b.lo + tolerance, a.lo > b.hi + tolerance)));
    case FormulaOp::Equal:
    case FormulaOp::NotEqual: {
      const bool apart = a.hi < b.lo - tolerance || b.hi < a.lo - tolerance;
      const bool same = a.isConstant() && b.isConstant() && !apart;
      return push(
          numberOf(step.op == FormulaOp::Equal ? answer(same, apart) : answer(apart, same)));
    }
    case FormulaOp::And: {
      const Truth x = toTruth(a), y = toTruth(b);
      return push(
          numberOf(answer(x == Truth::Yes && y == Truth::Yes, x == Truth::No || y == Truth::No)));
    }
    case FormulaOp::Or: {
      const Truth x = toTruth(a), y = toTruth(b);
      return push(
          numberOf(answer(x == Truth::Yes || y == Truth::Yes, x == Truth::No && y == Truth::No)));
    }
    default:
      return push(Interval::unknown());
    }
  }

  const CodeInfo &code_;
  const ConditionContext &context_;
  llvm::SmallVector<Interval, 8> stack_;
  llvm::ArrayRef<std::string> names_; ///< of the current formula
};

} // namespace

uint64_t elementOf(llvm::StringRef list, double place) {
  return variableKey((list + "[" + llvm::Twine(std::llround(place)) + "]").str());
}

Truth truthOf(const Formula &formula, const CodeInfo &code, const ConditionContext &context) {
  return toTruth(FormulaEvaluator(code, context).run(formula));
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
