// Formulas of the tables: what must hold between the words of a code's format.
#include "formats/dialect/formula.h"

#include "formats/dialect/variable_key.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

namespace {

/// A table's formula is short; deeper nesting is a mistake.
constexpr unsigned maxNesting = 32;

/// Functions without arguments, which tell of the state.
constexpr std::pair<llvm::StringLiteral, FormulaOp> ofState[] = {
    {"toolRadius", FormulaOp::ToolRadius},
    {"tool", FormulaOp::Tool},
    {"edge", FormulaOp::Edge},
    {"level", FormulaOp::Level},
    {"feed", FormulaOp::Feed},
    {"speed", FormulaOp::Speed},
    {"note", FormulaOp::Note},
    {"origin", FormulaOp::Origin},
    {"index", FormulaOp::Index},
    {"increment", FormulaOp::Increment},
    {"unknown", FormulaOp::Unknown}};

class FormulaParser {
public:
  using Names = llvm::function_ref<std::optional<FormulaName>(llvm::StringRef)>;
  FormulaParser(llvm::StringRef text, Names names) : rest_(text), names_(names) {}

  bool parse() {
    if (!disjunction(0))
      return false;
    rest_ = rest_.ltrim();
    return rest_.empty() || fail("is not understood at \"" + rest_.str() + "\"");
  }
  Formula formula;
  std::string error;

private:
  bool fail(std::string what) {
    if (error.empty())
      error = std::move(what);
    return false;
  }
  /// A formula is asked for many tokens at each place.
  void skipBlanks() {
    if (!rest_.empty() && llvm::isSpace(rest_[0]))
      rest_ = rest_.ltrim();
  }
  bool take(llvm::StringRef token) {
    skipBlanks();
    return rest_.consume_front(token);
  }
  bool takeWord(llvm::StringRef word) {
    skipBlanks();
    if (!rest_.startswith(word) ||
        (rest_.size() > word.size() && isNameCharacter(rest_[word.size()])))
      return false;
    rest_ = rest_.drop_front(word.size());
    return true;
  }
  static bool isNameCharacter(char c) { return llvm::isAlnum(c) || c == '_'; }
  void emit(FormulaOp op, uint16_t index = 0, double number = 0) {
    formula.steps.push_back({op, index, number});
  }

  bool disjunction(unsigned depth) {
    if (!conjunction(depth))
      return false;
    while (takeWord("or")) {
      if (!conjunction(depth))
        return false;
      emit(FormulaOp::Or);
    }
    return true;
  }
  bool conjunction(unsigned depth) {
    if (!negation(depth))
      return false;
    while (takeWord("and")) {
      if (!negation(depth))
        return false;
      emit(FormulaOp::And);
    }
    return true;
  }
  bool negation(unsigned depth) {
    if (depth > maxNesting)
      return fail("nests too deep");
    if (!takeWord("not"))
      return comparison(depth);
    if (!negation(depth + 1))
      return false;
    emit(FormulaOp::Not);
    return true;
  }
  bool comparison(unsigned depth) {
    if (!sum(depth))
      return false;
    struct Sign {
      const char *text;
      FormulaOp op;
      bool swapped; ///< x > y is y < x
    };
    static constexpr Sign signs[] = {
        {"<=", FormulaOp::LessEqual, false}, {">=", FormulaOp::LessEqual, true},
        {"==", FormulaOp::Equal, false},     {"!=", FormulaOp::NotEqual, false},
        {"<", FormulaOp::Less, false},       {">", FormulaOp::Less, true}};
    for (const Sign &sign : signs) {
      if (!take(sign.text))
        continue;
      const size_t right = formula.steps.size();
      if (!sum(depth))
        return false;
      if (sign.swapped) {
        // The right operand goes before the left one.
        const size_t left = leftOperand(right);
        std::rotate(formula.steps.begin() + ptrdiff_t(left),
                    formula.steps.begin() + ptrdiff_t(right), formula.steps.end());
      }
      emit(sign.op);
      return true;
    }
    return true;
  }
  /// First step of the operand that ends before step `end`.
  size_t leftOperand(size_t end) const {
    int wanted = 1;
    size_t at = end;
    while (wanted > 0 && at > 0) {
      --at;
      wanted += operands(formula.steps[at].op) - 1;
    }
    return at;
  }
  static int operands(FormulaOp op) {
    switch (op) {
    case FormulaOp::Number:
    case FormulaOp::Word:
    case FormulaOp::Address:
    case FormulaOp::Given:
    case FormulaOp::GivenAddress:
    case FormulaOp::Variable:
    case FormulaOp::GivenVariable:
    case FormulaOp::ToolRadius:
    case FormulaOp::Tool:
    case FormulaOp::Edge:
    case FormulaOp::Level:
    case FormulaOp::Feed:
    case FormulaOp::Speed:
    case FormulaOp::Length:
    case FormulaOp::Here:
    case FormulaOp::Bare:
    case FormulaOp::Note:
    case FormulaOp::Place:
    case FormulaOp::Origin:
    case FormulaOp::Index:
    case FormulaOp::Option:
    case FormulaOp::Unknown:
      return 0;
    case FormulaOp::Element:
    case FormulaOp::Negate:
    case FormulaOp::Absolute:
    case FormulaOp::Floor:
    case FormulaOp::Sine:
    case FormulaOp::Cosine:
    case FormulaOp::SquareRoot:
    case FormulaOp::Not:
      return 1;
    case FormulaOp::Select:
      return 3;
    default:
      return 2;
    }
  }
  bool sum(unsigned depth) {
    if (!product(depth))
      return false;
    for (;;) {
      const bool add = take("+");
      if (!add && !take("-"))
        return true;
      if (!product(depth))
        return false;
      emit(add ? FormulaOp::Add : FormulaOp::Subtract);
    }
  }
  bool product(unsigned depth) {
    if (!operand(depth))
      return false;
    for (;;) {
      const bool times = take("*");
      if (!times && !take("/"))
        return true;
      if (!operand(depth))
        return false;
      emit(times ? FormulaOp::Multiply : FormulaOp::Divide);
    }
  }
  bool operand(unsigned depth) {
    if (depth > maxNesting)
      return fail("nests too deep");
    if (take("-")) {
      if (!operand(depth + 1))
        return false;
      emit(FormulaOp::Negate);
      return true;
    }
    if (take("("))
      return disjunction(depth + 1) && (take(")") || fail("lacks a \")\""));
    rest_ = rest_.ltrim();
    if (!rest_.empty() && llvm::isDigit(rest_[0])) {
      const llvm::StringRef digits =
          rest_.take_while([](char c) { return llvm::isDigit(c) || c == '.'; });
      rest_ = rest_.drop_front(digits.size());
      double number = 0;
      if (digits.getAsDouble(number))
        return fail("has the bad number \"" + digits.str() + "\"");
      emit(FormulaOp::Number, 0, number);
      return true;
    }
    if (take("$")) {
      const llvm::StringRef name = takeName();
      if (take("[")) {
        const auto index = uint16_t(formula.names.size());
        formula.names.push_back(name.str());
        if (!disjunction(depth + 1) || !take("]"))
          return fail("lacks a \"]\"");
        emit(FormulaOp::Element, index);
        return true;
      }
      emit(FormulaOp::Variable, 0, keyOf(name));
      return true;
    }
    const llvm::StringRef name = rest_.take_while(isNameCharacter);
    rest_ = rest_.drop_front(name.size());
    if (name.empty())
      return fail("ends too early, or is not understood at \"" + rest_.str() + "\"");
    if (take("("))
      return function(name, depth);
    const std::optional<FormulaName> known = names_(name);
    if (!known)
      return fail("names \"" + name.str() + "\", which is no word of this code");
    emit(known->word, known->index);
    return true;
  }
  bool function(llvm::StringRef name, unsigned depth) {
    for (const auto &[known, op] : ofState)
      if (name == known) {
        emit(op);
        return take(")") || fail("lacks a \")\"");
      }
    if (name == "key") {
      emit(FormulaOp::Number, 0, double(variableKey(takeName())));
      return take(")") || fail("lacks a \")\"");
    }
    if (name == "option") {
      emit(FormulaOp::Option, uint16_t(formula.names.size()));
      formula.names.push_back(takeName().str());
      return take(")") || fail("lacks a \")\"");
    }
    if (name == "given" && take("$")) {
      emit(FormulaOp::GivenVariable, 0, keyOf(takeName()));
      return take(")") || fail("lacks a \")\"");
    }
    if (name == "given") {
      rest_ = rest_.ltrim();
      const llvm::StringRef word = rest_.take_while(isNameCharacter);
      rest_ = rest_.drop_front(word.size());
      const std::optional<FormulaName> known = names_(word);
      if (!known)
        return fail("names \"" + word.str() + "\", which is no word of this code");
      emit(known->word == FormulaOp::Word ? FormulaOp::Given : FormulaOp::GivenAddress,
           known->index);
      return take(")") || fail("lacks a \")\"");
    }
    if (name == "length" || name == "here" || name == "bare" || name == "place")
      return aboutWord(name);
    if (name == "select") {
      if (!disjunction(depth + 1) || !take(",") || !disjunction(depth + 1) || !take(",") ||
          !disjunction(depth + 1))
        return fail("has too few operands in \"select\"");
      emit(FormulaOp::Select);
      return take(")") || fail("lacks a \")\"");
    }
    constexpr std::pair<llvm::StringLiteral, FormulaOp> ofValues[] = {
        {"abs", FormulaOp::Absolute},   {"floor", FormulaOp::Floor}, {"sin", FormulaOp::Sine},
        {"cos", FormulaOp::Cosine},     {"min", FormulaOp::Minimum}, {"max", FormulaOp::Maximum},
        {"sqrt", FormulaOp::SquareRoot}};
    for (const auto &[known, op] : ofValues)
      if (name == known) {
        const bool two = operands(op) == 2;
        if (!disjunction(depth + 1) || (two && (!take(",") || !disjunction(depth + 1))))
          return fail("has too few operands in \"" + name.str() + "\"");
        emit(op);
        return take(")") || fail("lacks a \")\"");
      }
    return fail("has the unknown function \"" + name.str() + "\"");
  }

  /// Functions of a word, not of its value.
  bool aboutWord(llvm::StringRef function) {
    const llvm::StringRef word = takeName();
    const std::optional<FormulaName> known = names_(word);
    const bool address = function == "bare" || function == "place";
    if (!known || known->word != (address ? FormulaOp::Address : FormulaOp::Word))
      return fail("names \"" + word.str() + "\", which is no " + (address ? "address" : "word") +
                  " of this code");
    emit(function == "length" ? FormulaOp::Length
         : function == "here" ? FormulaOp::Here
         : function == "bare" ? FormulaOp::Bare
                              : FormulaOp::Place,
         known->index);
    return take(")") || fail("lacks a \")\"");
  }

  /// Key of a variable by its name, or by its number as in `#271`.
  static double keyOf(llvm::StringRef name) {
    int64_t number = 0;
    if (name.startswith("#") && !name.drop_front().getAsInteger(10, number))
      return double(elementKey(variableKey("#"), number));
    return double(variableKey(name));
  }

  /// A variable's name, perhaps with the marks of its type.
  llvm::StringRef takeName() {
    rest_ = rest_.ltrim();
    const llvm::StringRef name =
        rest_.take_while([](char c) { return isNameCharacter(c) || c == '%' || c == '#'; });
    rest_ = rest_.drop_front(name.size());
    return name;
  }

  llvm::StringRef rest_;
  Names names_;
};

} // namespace

std::optional<Formula>
parseFormula(llvm::StringRef text,
             llvm::function_ref<std::optional<FormulaName>(llvm::StringRef)> name,
             std::string &error) {
  FormulaParser parser(text, name);
  if (!parser.parse()) {
    error = parser.error;
    return std::nullopt;
  }
  return std::move(parser.formula);
}

} // namespace ncvet
