// What is in angle brackets in ECS blocks: variables, instructions, calls.
#include "formats/readers/ecs/ecs_scanner.h"

namespace ncvet {

/// The bracket that closes what was opened at `begin`.
void EcsScanner::closeAngle(const char *begin) {
  skipBlanks();
  if (at_ < end_ && *at_ == '>') {
    ++at_;
    return;
  }
  const char *p = at_;
  while (p < end_ && !isLineEnd(*p) && *p != '>' && *p != '<')
    ++p;
  if (p < end_ && *p == '>') {
    issue(SyntaxIssueKind::BadExpression, at_, p);
    at_ = p + 1;
    return;
  }
  issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
}

/// A variable that the control itself has.
bool EcsScanner::isVariable(llvm::StringRef name) const {
  return llvm::any_of(dialect_.variableNames,
                      [&](const std::string &known) { return name.equals_insensitive(known); });
}

/// Whether an instruction has this name, and no variable.
bool EcsScanner::isInstruction(llvm::StringRef name) const {
  for (const char *flow : {"JMP", "JMC", "RPT", "INP"})
    if (name.equals_insensitive(flow))
      return true;
  const std::string key = name.upper();
  return (dialect_.keyword(key) != noCode || dialect_.keyword(key + ":ON") != noCode) &&
         !isVariable(name);
}

void EcsScanner::scanAngle() {
  const char *const begin = at_++;
  skipBlanks();
  const llvm::StringRef word = name();
  if (word.empty() || word == "%" || word == "%%") {
    skipToAngle();
    closeAngle(begin);
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  }
  block_.lowerCase |= llvm::any_of(word, [](char c) { return c >= 'a' && c <= 'z'; });
  const char *const after = afterBlanks(word.end());
  const char c = after < end_ ? *after : '\n';
  if (c == '=') {
    at_ = after + 1;
    if (isInstruction(word)) { // `<JMP=N40>`: read as what it is meant for
      issue(SyntaxIssueKind::MissingEquals, begin, at_);
      return scanInstruction(begin, word);
    }
    return scanVariable(begin, word);
  }
  if (c == '<' && (word.equals_insensitive("IFF") || word.equals_insensitive("IFC"))) {
    at_ = after;
    return scanChoice(begin, word.equals_insensitive("IFC"));
  }
  if (c == ':') {
    at_ = after + 1;
    if (!isInstruction(word) && isVariable(word) && dialect_.keyword(word.upper()) == noCode) {
      issue(SyntaxIssueKind::MissingEquals, begin, at_); // `<ENT:-5>`
      return scanVariable(begin, word);
    }
    return scanInstruction(begin, word);
  }
  at_ = after;
  const CodeIndex code = dialect_.keyword(word);
  closeAngle(begin);
  if (code != noCode)
    return keyword(code, begin, at_);
  // `<RTE>`: neither an instruction nor a variable that lacks its value.
  if (c == '>' && !isVariable(word))
    return issue(SyntaxIssueKind::UnknownWord, word.begin(), word.end());
  issue(c == '>' ? SyntaxIssueKind::MissingValue : SyntaxIssueKind::BadStatement, begin, at_);
}

/// `<ENT=-10>`, `<CFF=CFZ>`
void EcsScanner::scanVariable(const char *begin, llvm::StringRef variable) {
  Item item = itemAt(ItemKind::Assignment, begin);
  nameItem(item, variable);
  item.target = constant(variable.begin(), variable.end(), double(variableKey(variable)));
  skipBlanks();
  Word word;
  word.address = variableAddress;
  const llvm::StringRef symbol = name();
  const char *const after = afterBlanks(symbol.end());
  if (atLineEnd() || *at_ == '>') {
    word.flags = wordNoValue;
    issue(SyntaxIssueKind::MissingValue, begin, at_);
  } else if (symbol.size() == 3 && symbol.startswith_insensitive("CF") && after < end_ &&
             *after == '>') {
    // The name of an axis is its own value; as a number it is its key.
    item.value = constant(symbol.begin(), symbol.end(), double(variableKey(symbol)));
    word.flags = wordExpression;
    word.mantissa = item.value;
    at_ = symbol.end();
  } else {
    const char *const from = at_;
    const char *number = nullptr;
    if (isNumberDigit(*at_) || *at_ == '-')
      number = readPlainNumber(at_, end_, word);
    const char *const next = number ? afterBlanks(number) : nullptr;
    if (next && next < end_ && *next == '>') {
      at_ = number;
      item.value = constant(from, number, word.value());
    } else {
      word = Word();
      word.address = variableAddress;
      item.value = expression();
      word.flags = wordExpression;
      word.mantissa = item.value;
    }
  }
  closeAngle(begin);
  add(item);
  extendExpression(word);
  addWord(word, begin);
}

void EcsScanner::scanInstruction(const char *begin, llvm::StringRef word) {
  const std::string key = word.upper();
  if (key == "JMP" || key == "JMC")
    return scanJump(begin, key == "JMC");
  if (key == "RPT")
    return scanRepeat(begin);
  if (key == "INP")
    return scanInput(begin);
  Item item = itemAt(ItemKind::Instruction, begin);
  nameItem(item, word);
  std::string first;
  for (char separator = 0;;) {
    const Argument argument = scanArgument(separator);
    if (argument.kind == ArgumentKind::Empty && !separator && at_ < end_ && *at_ == '>')
      break;
    if (first.empty() && argument.kind == ArgumentKind::Name && !separator)
      first = llvm::StringRef(base_ + argument.begin, argument.end - argument.begin).upper();
    block_.arguments.push_back(argument);
    separator = scanSeparator();
    if (!separator)
      break;
  }
  closeAngle(begin);
  add(item);
  CodeIndex code = dialect_.keyword(key + ":" + first);
  if (code == noCode)
    code = dialect_.keyword(key);
  if (code == noCode)
    return issue(SyntaxIssueKind::UnknownWord, word.begin(), word.end());
  keyword(code, begin, at_);
  const llvm::SmallVector<Argument, 8> arguments(block_.argumentsOf(item).begin(),
                                                 block_.argumentsOf(item).end());
  for (const Argument &argument : inOrder(arguments, dialect_.codes[code]))
    argumentWord(argument);
}

/// An argument of an instruction as a word, so that the table can say what it takes. A name means
/// itself; as a number it is its key.
void EcsScanner::argumentWord(const Argument &argument) {
  Word word;
  word.address = argumentAddress;
  if (argument.kind == ArgumentKind::Empty) {
    word.flags = wordNoValue;
  } else {
    word.flags = wordExpression;
    const char *const begin = base_ + argument.begin, *const end = base_ + argument.end;
    word.mantissa = argument.expression != noExpression ? argument.expression
                    : argument.kind == ArgumentKind::Name
                        ? constant(begin, end, double(variableKey({begin, size_t(end - begin)})))
                        : opaque(begin, end);
  }
  const char *const at = at_;
  at_ = base_ + argument.end;
  addWord(word, base_ + argument.begin);
  at_ = at;
}

/// Arguments with names (`AX=XY`, `P5`) at the places that the table gives these names; the others
/// as written.
llvm::SmallVector<Argument, 8> EcsScanner::inOrder(llvm::ArrayRef<Argument> written,
                                                   const CodeInfo &code) {
  llvm::SmallVector<Argument, 8> placed;
  for (Argument argument : written) {
    size_t place = placed.size();
    llvm::StringRef name(base_ + argument.nameBegin, argument.nameEnd - argument.nameBegin);
    const llvm::StringRef text(base_ + argument.begin, argument.end - argument.begin);
    double number = 0;
    const bool numbered = argument.kind == ArgumentKind::Name && name.empty() && text.size() > 1 &&
                          !text.drop_front().getAsDouble(number);
    if (numbered)
      name = text.take_front();
    if (!name.empty())
      for (const WordSpec &spec : code.words)
        if (spec.position && name.equals_insensitive(spec.name)) {
          place = spec.position - 1;
          if (numbered)
            argument.expression = constant(text.begin(), text.end(), number);
        }
    if (place >= placed.size()) {
      Argument empty;
      empty.begin = empty.end = argument.begin;
      placed.resize(place + 1, empty);
    }
    placed[place] = argument;
  }
  return placed;
}

/// A prompt, also one whose opening quote was forgotten: `<INP: Radius"; R0; N100>`.
Argument EcsScanner::scanPrompt() {
  skipBlanks();
  const llvm::StringRef rest =
      llvm::StringRef(at_, size_t(end_ - at_)).take_until([](char c) { return c == '\n'; });
  const size_t quote = rest.find('"');
  if (quote == 0 || quote == llvm::StringRef::npos || rest.find_first_of(";,<>") < quote)
    return scanArgument(0);
  Argument prompt;
  prompt.kind = ArgumentKind::Text;
  prompt.begin = offset(at_);
  const char *const begin = at_;
  at_ += quote;
  prompt.end = offset(at_);
  ++at_;
  issue(SyntaxIssueKind::UnclosedString, begin, at_);
  return prompt;
}

/// `<INP: "prompt"; R0; N100; 10; 100>`: the target for ESC is the first argument of the item,
/// after it the prompt and the bounds.
void EcsScanner::scanInput(const char *begin) {
  Item item = itemAt(ItemKind::Input, begin);
  Argument prompt = scanPrompt();
  bool complete = prompt.kind == ArgumentKind::Text;
  if (const char after = scanSeparator()) {
    prompt.separator = after;
    skipBlanks();
    item.nameBegin = offset(at_);
    item.target = parsed(&EcsExpression::parseTarget);
    item.nameEnd = offset(at_);
  } else {
    complete = false;
  }
  if (const char separator = scanSeparator())
    block_.arguments.push_back(scanTarget(separator));
  else
    complete = false;
  block_.arguments.push_back(prompt);
  for (unsigned bounds = 0; const char separator = scanSeparator(); ++bounds) {
    if (bounds == 2) {
      tooManyArguments(begin);
      break;
    }
    block_.arguments.push_back(scanArgument(separator));
  }
  closeAngle(begin);
  if (!complete)
    issue(SyntaxIssueKind::MissingArgument, begin, at_);
  add(item);
}

/// `L<NAME>`, `L<&R12>`, `L<C:\PATH\NAME>`
void EcsScanner::scanCall(const char *begin) {
  ++at_; // the bracket
  skipBlanks();
  Item item = itemAt(ItemKind::Call, begin);
  if (at_ < end_ && *at_ == '&') {
    ++at_;
    item.value = expression();
    closeAngle(begin);
    return add(item);
  }
  const char *const from = at_;
  skipToAngle();
  const llvm::StringRef called = withoutFolder({from, size_t(at_ - from)});
  closeAngle(begin);
  if (called.empty())
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  if (const CodeIndex code = dialect_.keyword((dialect_.lexical.callMark + called).str());
      code != noCode)
    return keyword(code, begin, at_);
  nameItem(item, called);
  add(item);
}

} // namespace ncvet
