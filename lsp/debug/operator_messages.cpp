// Texts that a program shows to the operator.
#include "lsp/debug/operator_messages.h"

#include "formats/dialect/control_facts.h"
#include "lsp/debug/watch_expression.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet::dap {

namespace {

/// The text of a comment without its marks.
llvm::StringRef inner(llvm::StringRef comment) { return comment.trim("(); \t\r\n"); }

/// Whether a comment begins with one of the words and a comma: what comes after that.
std::optional<llvm::StringRef> afterWord(llvm::StringRef comment,
                                         llvm::ArrayRef<std::string> words) {
  const auto [word, text] = comment.split(',');
  if (word.size() == comment.size())
    return std::nullopt;
  for (const std::string &one : words)
    if (word.trim().equals_insensitive(one))
      return text.trim();
  return std::nullopt;
}

std::string valueOf(const FileUnit &unit, llvm::StringRef expression, const MachineState &state) {
  auto value = WatchExpression::parse(unit, expression);
  if (value)
    return valueText(value->evaluate(state));
  llvm::consumeError(value.takeError());
  return expression.str();
}

/// The text with the values of the variables that it names: `#5`, `#<depth>`.
std::string withValues(const FileUnit &unit, llvm::StringRef text, const MachineState &state) {
  std::string shown;
  while (!text.empty()) {
    const auto [plain, rest] = text.split('#');
    shown += plain;
    if (plain.size() == text.size())
      break;
    const bool isNamed = rest.startswith("<");
    const size_t length = isNamed ? rest.find('>') + 1 : rest.take_while(llvm::isDigit).size();
    if (length == 0) { // a `#` that names nothing
      shown += '#';
      text = rest;
      continue;
    }
    shown += valueOf(unit, ("#" + rest.take_front(length)).str(), state);
    text = rest.drop_front(length);
  }
  return shown;
}

/// The parts of an argument that `<<` joins: texts between quotes, and values.
std::string joined(const FileUnit &unit, llvm::StringRef argument, const MachineState &state) {
  std::string shown;
  while (!(argument = argument.ltrim()).empty()) {
    if (argument.consume_front("<<"))
      continue;
    if (argument.consume_front("\"")) {
      const auto [text, rest] = argument.split('"');
      shown += text;
      argument = rest;
      continue;
    }
    const size_t end = std::min(argument.find("<<"), argument.size());
    shown += valueOf(unit, argument.take_front(end).rtrim(), state);
    argument = argument.drop_front(end);
  }
  return shown;
}

bool isOneOf(const std::vector<int> &variables, uint64_t key) {
  return llvm::any_of(variables, [&](int one) { return uint64_t(one) == key; });
}

class MessageReader {
public:
  MessageReader(const FileUnit &unit, const Block &block, const MachineState &state)
      : unit_(unit), block_(block), state_(state), facts_(unit.dialect->facts->messages) {}

  std::vector<OperatorMessage> read() {
    for (const Comment &comment : block_.comments)
      ofComment(comment);
    for (const Item &item : block_.items) {
      if (item.kind == ItemKind::Instruction)
        ofInstruction(item);
      if (item.kind == ItemKind::Assignment && isOneOf(facts_.variables, block_.keyOf(item.target)))
        ofVariable(item);
    }
    return std::move(messages_);
  }

private:
  llvm::StringRef text(uint32_t begin, uint32_t end) const { return unit_.source.text(begin, end); }
  void add(std::string shown, uint32_t offset) {
    messages_.push_back({unit_.source.displayText(shown), offset});
  }

  void ofComment(const Comment &comment) {
    const llvm::StringRef own = inner(text(comment.begin, comment.end));
    if (comment.shown)
      return add(own.str(), comment.begin);
    if (const auto plain = afterWord(own, facts_.comments))
      return add(plain->str(), comment.begin);
    if (const auto named = afterWord(own, facts_.withValues))
      add(withValues(unit_, *named, state_), comment.begin);
  }

  void ofInstruction(const Item &item) {
    const llvm::StringRef name = text(item.nameBegin, item.nameEnd);
    if (llvm::none_of(facts_.instructions,
                      [&](const std::string &one) { return name.equals_insensitive(one); }))
      return;
    for (const Argument &argument : block_.argumentsOf(item)) {
      const llvm::StringRef own = text(argument.begin, argument.end);
      const std::string shown =
          argument.kind == ArgumentKind::Text ? own.str() : joined(unit_, own, state_);
      if (!shown.empty())
        add(shown, item.begin);
    }
  }

  /// The comment right after the value.
  void ofVariable(const Item &item) {
    for (const Comment &comment : block_.comments)
      if (comment.begin >= item.end &&
          text(item.end, comment.begin).find_first_not_of(" \t]") == llvm::StringRef::npos)
        return add(inner(text(comment.begin, comment.end)).str(), comment.begin);
  }

  const FileUnit &unit_;
  const Block &block_;
  const MachineState &state_;
  const MessageFacts &facts_;
  std::vector<OperatorMessage> messages_;
};

} // namespace

std::vector<OperatorMessage> messagesOf(const FileUnit &unit, const Block &block,
                                        const MachineState &state) {
  if (block.comments.empty() && block.items.empty())
    return {};
  return MessageReader(unit, block, state).read();
}

bool stopsWithMessage(const FileUnit &unit, const Block &block) {
  const std::vector<int> &stops = unit.dialect->facts->messages.stops;
  return llvm::any_of(block.items, [&](const Item &item) {
    return item.kind == ItemKind::Assignment && isOneOf(stops, block.keyOf(item.target));
  });
}

} // namespace ncvet::dap
