// Definitions in Sinumerik blocks: variables, parameters, macros.
#include "formats/readers/sinumerik/sinumerik_functions.h"
#include "formats/readers/sinumerik/sinumerik_scanner.h"

#include "llvm/ADT/StringSwitch.h"

namespace ncvet {

namespace {
VariableType typeOf(llvm::StringRef name) {
  return llvm::StringSwitch<VariableType>(name.upper())
      .Case("INT", VariableType::Integer)
      .Case("REAL", VariableType::Real)
      .Case("BOOL", VariableType::Boolean)
      .Case("CHAR", VariableType::Character)
      .Case("STRING", VariableType::String)
      .Case("AXIS", VariableType::Axis)
      .Case("FRAME", VariableType::Frame)
      .Default(VariableType::None);
}

} // namespace

/// A word of the language, which no variable can be.
bool SinumerikScanner::isTaken(llvm::StringRef name) const {
  const std::string upper = name.upper();
  if (sinumerikKeyword(name) != SinumerikKeyword::None || sinumerikFunction(upper) != Op::Unknown)
    return true;
  for (const char *operation : {"DIV", "MOD", "AND", "OR", "XOR", "NOT", "B_AND", "B_OR", "B_XOR",
                                "B_NOT", "TRUE", "FALSE", "ATAN2", "MINVAL", "MAXVAL", "BOUND"})
    if (upper == operation)
      return true;
  return false;
}

/// Words after the head of a program that say how it runs.
static bool isAttribute(llvm::StringRef name) {
  for (const char *known : {"SAVE", "SBLOF", "SBLON", "DISPLOF", "DISPLON", "ACTBLOCNO", "PREPRO",
                            "IPTRLOCK", "IPTRUNLOCK", "ICYCOF", "ICYCON", "BLSYNC"})
    if (name.equals_insensitive(known))
      return true;
  return false;
}

/// Words of a definition that take a value.
static bool isProperty(llvm::StringRef name) {
  for (const char *known : {"PHU", "LLI", "ULI", "APR", "APW", "APRP", "APWP", "APRB", "APWB"})
    if (name.equals_insensitive(known))
      return true;
  return false;
}

/// The type of a definition, with what may be before it.
VariableType SinumerikScanner::scanType() {
  VariableType type = VariableType::None;
  // Modifiers (NCK, CHAN, SYNR, PHU 3, …) may be before the type.
  while (!atBlockEnd() && type == VariableType::None) {
    const llvm::StringRef word = identifier();
    if (word.empty())
      break;
    at_ = word.end();
    type = typeOf(word);
    if (type == VariableType::String) {
      skipBlanks();
      skipIndices();
    }
    skipBlanks();
  }
  skipProperties();
  return type;
}

/// `PHU 24 LLI -10 ULI 50`, of definitions of the machine: unit, limits and who may write, each
/// with its value, are between the type and the names.
void SinumerikScanner::skipProperties() {
  while (!atBlockEnd()) {
    const llvm::StringRef word = identifier();
    if (!isProperty(word))
      return;
    const char *const value = afterBlanks(word.end());
    if (value == end_ || isEquals(value) || *value == ',' || *value == '[' || isLineEnd(*value))
      return; // a variable of that name
    at_ = value;
    while (!atBlockEnd() && *at_ != ' ' && *at_ != '\t')
      ++at_;
    skipBlanks();
  }
}

/// `[3, 4]` after the name of a definition.
void SinumerikScanner::scanSizes(Item &item, const char *begin) {
  for (char separator = 0; at_ < end_ && (*at_ == '[' || *at_ == ',');) {
    ++at_;
    Argument size;
    size.kind = ArgumentKind::Expression;
    size.separator = separator;
    size.begin = offset(at_);
    size.expression = expression();
    size.end = offset(at_);
    separator = ',';
    block_.arguments.push_back(size);
    ++item.arguments;
    skipBlanks();
  }
  if (at_ < end_ && *at_ == ']')
    ++at_;
  else
    issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
  skipBlanks();
}

/// `A[0]=(1,2,3)`, `OSCTRL[Z]=(4,0)`: the list of values in brackets that is here, if there is a
/// comma between them; `noExpression`, with nothing read: there is none.
uint16_t SinumerikScanner::scanList() {
  skipBlanks();
  const char *const begin = at_;
  if (at_ == end_ || *at_ != '(')
    return noExpression;
  bool comma = false;
  int depth = 0;
  const char *p = at_;
  for (; p < end_ && !isLineEnd(*p) && *p != ';'; ++p) {
    depth += *p == '(' || *p == '[' ? 1 : *p == ')' || *p == ']' ? -1 : 0;
    comma |= depth == 1 && *p == ',';
    if (depth == 0)
      break;
  }
  if (!comma || p == end_ || *p != ')')
    return noExpression;
  do {
    at_ = afterBlanks(at_ + 1);
    if (at_ < p && *at_ != ',')
      expression();
    at_ = afterBlanks(at_);
  } while (at_ < p && *at_ == ',');
  if (at_ != p)
    issue(SyntaxIssueKind::BadExpression, begin, p + 1);
  at_ = p + 1;
  return opaque(begin, at_);
}

/// `DEF INT A=0, B[3]`
void SinumerikScanner::scanDefinitions(const char *keyword) {
  skipBlanks();
  const char *const begin = atBlockEnd() ? keyword : at_;
  const VariableType type = scanType();
  if (type == VariableType::None) {
    issue(SyntaxIssueKind::BadStatement, begin, at_);
    return rest();
  }
  while (!atBlockEnd()) {
    const llvm::StringRef name = identifier();
    if (name.empty() || isNumberDigit(name[0])) {
      issue(SyntaxIssueKind::BadStatement, begin, at_);
      return rest();
    }
    Item item = itemAt(ItemKind::Definition, at_);
    item.type = type;
    nameItem(item, name);
    item.target = constant(name.begin(), name.end(), double(variableKey(name)));
    at_ = name.end();
    if (isTaken(name))
      issue(SyntaxIssueKind::BadName, name.begin(), at_);
    skipBlanks();
    if (at_ < end_ && *at_ == '[')
      scanSizes(item, name.begin());
    if (isEquals(at_)) {
      ++at_;
      const uint16_t list = item.arguments ? scanList() : noExpression;
      item.value = list != noExpression ? list : expression();
      skipBlanks();
    }
    add(item);
    if (at_ == end_ || *at_ != ',')
      break;
    ++at_;
    skipBlanks();
  }
  skipBlanks();
  if (!atBlockEnd()) {
    issue(SyntaxIssueKind::BadStatement, at_, at_ + 1);
    rest();
  }
}

/// `VAR REAL C`, `INT B=1`
Argument SinumerikScanner::scanParameter(char separator) {
  Argument parameter;
  parameter.kind = ArgumentKind::Name;
  parameter.separator = separator;
  if (identifier().equals_insensitive("VAR")) {
    parameter.byReference = true;
    at_ = identifier().end();
    skipBlanks();
  }
  parameter.type = typeOf(identifier());
  at_ = identifier().end();
  skipBlanks();
  skipIndices(); // STRING[20]
  skipBlanks();
  const llvm::StringRef own = identifier();
  parameter.begin = offset(own.begin());
  parameter.end = offset(own.end());
  at_ = own.end();
  skipBlanks();
  skipIndices();
  skipBlanks();
  if (isEquals(at_)) {
    ++at_;
    parameter.expression = expression();
    skipBlanks();
  }
  return parameter;
}

/// `(REAL A, INT B=1, VAR REAL C)`
void SinumerikScanner::scanParameterList(Item &item, const char *begin) {
  ++at_;
  skipBlanks();
  for (char separator = 0; !atBlockEnd() && *at_ != ')'; separator = ',') {
    const char *const from = at_;
    const Argument parameter = scanParameter(separator);
    block_.arguments.push_back(parameter);
    ++item.arguments;
    if (parameter.type == VariableType::None)
      issue(SyntaxIssueKind::BadStatement, from, std::max(from + 1, at_));
    if (at_ == from || at_ == end_ || *at_ != ',')
      break;
    ++at_;
    skipBlanks();
  }
  if (at_ < end_ && *at_ == ')')
    ++at_;
  else
    issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
}

/// `PROC NAME(REAL A, INT B=1, VAR REAL C) SAVE`, `EXTERN NAME(REAL, VAR INT)`
void SinumerikScanner::scanParameters(ItemKind kind, const char *begin) {
  Item item = itemAt(kind, begin);
  skipBlanks();
  const llvm::StringRef name = identifier();
  nameItem(item, name);
  at_ = name.end();
  if (name.empty()) {
    issue(SyntaxIssueKind::BadStatement, begin, at_);
    rest();
    return add(item);
  }
  skipBlanks();
  if (at_ < end_ && *at_ == '(')
    scanParameterList(item, begin);
  // Attributes; only SAVE matters to the caller.
  while (!atBlockEnd()) {
    const llvm::StringRef attribute = identifier();
    if (attribute.empty()) {
      if (*at_ == '(') { // the list comes before the attributes
        issue(SyntaxIssueKind::BadStatement, at_, at_ + 1);
        if (!item.arguments) {
          const size_t told = block_.issues.size();
          scanParameterList(item, begin);
          block_.issues.resize(told);
          continue;
        }
      }
      ++at_;
      continue;
    }
    item.restores |= attribute.equals_insensitive("SAVE");
    at_ = attribute.end();
    if (kind == ItemKind::Parameters && !isAttribute(attribute))
      issue(SyntaxIssueKind::UnknownAttribute, attribute.begin(), at_);
  }
  add(item);
}

/// `REDEF $MN_NAME APR 7`: who may read and write a variable, and when it begins anew.
void SinumerikScanner::scanRedefinition(const char *begin) {
  Item item = itemAt(ItemKind::Output, begin);
  rest();
  add(item);
}

/// `DEFINE NAME AS G1 G91`: what it means is read where it is written only.
void SinumerikScanner::scanMacro(const char *begin) {
  Item item = itemAt(ItemKind::Macro, begin);
  skipBlanks();
  const llvm::StringRef name = identifier();
  nameItem(item, name);
  at_ = name.end();
  rest();
  add(item);
}

} // namespace ncvet
