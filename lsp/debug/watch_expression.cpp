// Expressions that the user writes while a program is stopped.
#include "lsp/debug/watch_expression.h"

#include "formats/readers/select/make_reader.h"
#include "formats/text/failure.h"
#include "interp/evaluate/expression.h"
#include "interp/execute/execute.h"

#include "llvm/Support/Format.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet::dap {

namespace {

/// A longer text is no expression that somebody wrote.
constexpr size_t longestText = 1000;

/// Blocks in which the grammars have an expression: the text comes between both parts.
constexpr std::pair<llvm::StringLiteral, llvm::StringLiteral> frames[] = {
    {"#1=", ""},       {"#1=[", "]"},        {"R1=", ""},      {"R1=(", ")"},
    {"IF[", "]GOTO1"}, {"IF ", " GOTOF N1"}, {"o1 if [", "]"}, {"IF(", ") THEN GOTO 1"},
};

/// Words for signs that a control may not have.
constexpr std::pair<llvm::StringLiteral, llvm::StringLiteral> words[] = {
    {">=", " GE "},  {"<=", " LE "}, {"==", " EQ "}, {"!=", " NE "}, {"<>", " NE "},
    {"&&", " AND "}, {"||", " OR "}, {">", " GT "},  {"<", " LT "},  {"=", " EQ "}};

/// Signs as words; those within `#<name>` are brackets of a name.
std::string inWords(llvm::StringRef text) {
  std::string spelled;
  while (!text.empty()) {
    if (text.startswith("#<")) {
      const size_t end = std::min(text.find('>'), text.size() - 1) + 1;
      spelled += text.take_front(end);
      text = text.drop_front(end);
      continue;
    }
    const auto *const word =
        llvm::find_if(words, [&](const auto &one) { return text.startswith(one.first); });
    spelled += word == std::end(words) ? text.take_front() : llvm::StringRef(word->second);
    text = text.drop_front(word == std::end(words) ? 1 : word->first.size());
  }
  return spelled;
}

/// Reads one block from a text that holds no other.
bool readWhole(const FileUnit &unit, llvm::StringRef text, Block &block) {
  const std::unique_ptr<Reader> reader = makeReader(*unit.dialect, text);
  reader->setHidesProgram([&](llvm::StringRef name) { return unit.reader->isHidden(name); });
  reader->read(0, block);
  return block.issues.empty() && block.comments.empty() && block.next >= text.size();
}

/// The expression of the block that covers [begin, end).
std::optional<uint16_t> expressionOver(const Block &block, uint32_t begin, uint32_t end) {
  const auto covers = [&](uint16_t index) {
    if (index >= block.expressions.size())
      return false;
    const Expression &one = block.expressions[index];
    return !one.bad && one.count > 0 && one.begin <= begin && one.end >= end;
  };
  for (const Item &item : block.items)
    for (const uint16_t index : {item.value, item.condition})
      if (covers(index))
        return index;
  return std::nullopt;
}

bool isWithinBounds(llvm::StringRef text) {
  return !text.empty() && text.size() <= longestText && text.find_first_of("\r\n") == text.npos;
}

} // namespace

llvm::Expected<WatchExpression> WatchExpression::parse(const FileUnit &unit, llvm::StringRef text) {
  text = text.trim();
  if (isWithinBounds(text))
    for (const std::string &spelled : {text.str(), llvm::StringRef(inWords(text)).trim().str()})
      for (const auto &[before, after] : frames) {
        Block block;
        const auto begin = uint32_t(before.size()), end = uint32_t(begin + spelled.size());
        if (!readWhole(unit, (before + spelled + after).str(), block))
          continue;
        if (const auto index = expressionOver(block, begin, end))
          return WatchExpression(std::move(block), *index);
      }
  return failure("`" + text.take_front(80) + "` is no expression of this control");
}

Value WatchExpression::evaluate(const MachineState &state) const {
  return ncvet::evaluate(block_, index_, state, nullptr);
}

llvm::Error assign(const FileUnit &unit, MachineState &state, llvm::StringRef name,
                   llvm::StringRef value) {
  const std::string text = (name.trim() + "=" + value.trim()).str();
  Block block;
  if (!isWithinBounds(text) || !readWhole(unit, text, block) || block.items.size() != 1 ||
      block.items[0].kind != ItemKind::Assignment)
    return failure("`" + llvm::StringRef(text).take_front(80) +
                   "` is no assignment to a variable of this control");
  MachineState after = state;
  Outcome outcome;
  unit.executor().execute(block, state, after, outcome);
  if (!(outcome.kinds & bitOf(EventKind::Assignment)))
    return failure("`" + name.trim() + "` cannot be written");
  state.locals = after.locals;
  state.commons = after.commons;
  return llvm::Error::success();
}

std::string valueText(const Interval &value) {
  const auto number = [](double one) {
    std::string text;
    llvm::raw_string_ostream(text) << llvm::format("%.10g", one + 0.0);
    return text;
  };
  if (value.isUnknown())
    return "unknown";
  if (value.isConstant())
    return number(value.value());
  if (!std::isfinite(value.lo))
    return "at most " + number(value.hi);
  if (!std::isfinite(value.hi))
    return "at least " + number(value.lo);
  return number(value.lo) + " to " + number(value.hi);
}

std::string valueText(const Value &value) {
  return value.isVacant() ? "not set" : valueText(value.asNumber());
}

} // namespace ncvet::dap
