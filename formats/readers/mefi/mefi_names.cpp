// Names in MEFI blocks: codes, variables, and what is called with arguments.
#include "formats/readers/mefi/mefi_scanner.h"

namespace ncvet {

void MefiScanner::scanName() {
  const llvm::StringRef name = takeName();
  const char *const after = afterLineBlanks(at_);
  if (after < end_ && *after == '=') {
    at_ = after + 1;
    return scanAssignment(name);
  }
  const bool call = after < end_ && *after == '(';
  const CodeIndex code = codeNamed(name, after);
  if (code != noCode) {
    Word word;
    word.address = keywordAddress;
    word.mantissa = code;
    addWord(word, name.begin());
  }
  if (call) {
    at_ = after;
    scanCall(name);
  }
  if (code == noCode)
    issue(SyntaxIssueKind::UnknownWord, name.begin(), name.end());
}

/// The code with this name. A call has an entry for each program that it may name:
/// `CALLCYCLE(CYC_COPY)`; `after` is the place after the name.
CodeIndex MefiScanner::codeNamed(llvm::StringRef name, const char *after) const {
  if (after < end_ && *after == '(') {
    const llvm::StringRef program = llvm::StringRef(after + 1, size_t(end_ - after - 1))
                                        .ltrim(" \t")
                                        .take_while(isNameCharacter);
    const CodeIndex code = dialect_.keyword((name + "(" + program + ")").str());
    if (!program.empty() && code != noCode)
      return code;
  }
  return dialect_.keyword(name);
}

/// `(arg, arg)`: numbers and names. The cursor is at the parenthesis.
void MefiScanner::scanCall(llvm::StringRef name) {
  Item item = itemAt(ItemKind::Instruction, name.begin());
  nameItem(item, name);
  ++at_;
  bool closed = false;
  for (char separator = 0; at_ < end_ && !closed; separator = ',') {
    Argument argument;
    argument.separator = separator;
    const Word word = scanArgument(argument);
    skipLineBlanks();
    const bool comma = at_ < end_ && *at_ == ',';
    closed = at_ < end_ && *at_ == ')';
    if (argument.kind != ArgumentKind::Empty || comma || separator) {
      block_.arguments.push_back(argument);
      ++item.arguments;
      append(word);
    }
    if (!comma && !closed)
      break;
    ++at_;
  }
  if (!closed)
    issue(SyntaxIssueKind::UnbalancedBracket, name.begin(), at_);
  add(item);
}

/// Reads one argument, or none, and makes a word of it.
Word MefiScanner::scanArgument(Argument &argument) {
  skipLineBlanks();
  const char *const begin = at_;
  Word word;
  word.address = argumentAddress;
  word.offset = offset(begin);
  if (at_ < end_ && (isNumberDigit(*at_) || *at_ == '-' || *at_ == '+' || *at_ == '.')) {
    scanNumber(word, begin, /*commaIsPoint=*/false);
    argument.kind = ArgumentKind::Expression;
    argument.expression = valueOf(word);
  } else if (at_ < end_ && isNameLetter(*at_)) {
    argument.kind = ArgumentKind::Name;
    word.mantissa = keyOf(takeName());
    word.flags |= wordExpression;
  } else {
    word.flags |= wordNoValue;
  }
  word.length = lengthFrom(begin);
  argument.begin = offset(begin);
  argument.end = offset(at_);
  return word;
}

} // namespace ncvet
