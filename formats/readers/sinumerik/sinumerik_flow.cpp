// Statements of Sinumerik blocks: structures, jumps, repeats.
#include "formats/readers/sinumerik/sinumerik_scanner.h"

#include "llvm/ADT/STLExtras.h"

namespace ncvet {

void SinumerikScanner::structure(Structure structure, const char *begin, uint16_t condition) {
  Item item = itemAt(ItemKind::Structure, begin);
  item.structure = structure;
  item.condition = condition;
  add(item);
}

void SinumerikScanner::scanStatement(Keyword keyword, const char *begin) {
  switch (keyword) {
  case Keyword::If:
    return scanIf(begin);
  case Keyword::Else:
    return structure(Structure::Else, begin);
  case Keyword::EndIf:
    return structure(Structure::EndIf, begin);
  case Keyword::Loop:
    return structure(Structure::Loop, begin);
  case Keyword::EndLoop:
    return structure(Structure::EndLoop, begin);
  case Keyword::EndFor:
    return structure(Structure::EndFor, begin);
  case Keyword::EndWhile:
    return structure(Structure::EndWhile, begin);
  case Keyword::While:
  case Keyword::Until: {
    const uint16_t test = condition();
    return structure(keyword == Keyword::While ? Structure::While : Structure::Until, begin, test);
  }
  case Keyword::For:
    return scanFor(begin);
  case Keyword::Repeat:
  case Keyword::RepeatBlock:
    return scanRepeat(keyword == Keyword::RepeatBlock, begin);
  case Keyword::Goto:
  case Keyword::GotoForward:
  case Keyword::GotoBackward:
  case Keyword::GotoIfFound:
  case Keyword::GotoStart:
    return scanJump(keyword, begin);
  case Keyword::Case:
    return scanCase(begin);
  case Keyword::Def:
    return scanDefinitions(begin);
  case Keyword::Proc:
    return scanParameters(ItemKind::Parameters, begin);
  case Keyword::Extern:
    return scanParameters(ItemKind::Declaration, begin);
  case Keyword::Define:
    return scanMacro(begin);
  case Keyword::ModalCall:
    return scanModalCall(begin, {begin, size_t(at_ - begin)});
  case Keyword::Call:
  case Keyword::PathCall:
  case Keyword::ExternalCall:
    return scanIndirectCall(keyword, begin);
  case Keyword::Redefine:
    return scanRedefinition(begin);
  case Keyword::When:
  case Keyword::Do:
  case Keyword::Identity:
    return scanSynchronised(keyword, begin);
  case Keyword::None:
    break;
  }
}

/// `END FOR`: the end of a structure, written as two words. It is read as what is meant.
bool SinumerikScanner::scanPartedEnd(llvm::StringRef name) {
  if (!name.equals_insensitive("END") || !startsBlock())
    return false;
  const char *const second = afterBlanks(name.end());
  const llvm::StringRef kind =
      llvm::StringRef(second, size_t(end_ - second)).take_while(isNameCharacter);
  const Keyword keyword = sinumerikKeyword((name + kind).str());
  if (keyword != Keyword::EndIf && keyword != Keyword::EndFor && keyword != Keyword::EndWhile &&
      keyword != Keyword::EndLoop)
    return false;
  at_ = kind.end();
  issue(SyntaxIssueKind::BadStatement, name.begin(), at_);
  scanStatement(keyword, name.begin());
  return true;
}

/// A jump follows after the condition, or the blocks to ENDIF.
void SinumerikScanner::scanIf(const char *begin) {
  const uint16_t test = condition();
  skipBlanks();
  if (!isJump(sinumerikKeyword(identifier())))
    return structure(Structure::If, begin, test);
  Item item = itemAt(ItemKind::If, begin);
  item.condition = test;
  add(item);
  const char *const jump = at_;
  const llvm::StringRef name = identifier();
  at_ = name.end();
  scanJump(sinumerikKeyword(name), jump);
}

void SinumerikScanner::scanJump(Keyword keyword, const char *begin) {
  Item item = itemAt(ItemKind::Jump, begin);
  item.jump = keyword == Keyword::GotoForward    ? JumpKind::Forward
              : keyword == Keyword::GotoBackward ? JumpKind::Backward
              : keyword == Keyword::GotoIfFound  ? JumpKind::IfFound
              : keyword == Keyword::GotoStart    ? JumpKind::ToStart
                                                 : JumpKind::Anywhere;
  if (keyword != Keyword::GotoStart)
    scanTarget(item);
  add(item);
}

/// A label, `N100`, `:10`, `10`, or a string that only the run puts together.
void SinumerikScanner::scanTarget(Item &item) {
  skipBlanks();
  Argument target;
  target.begin = target.end = offset(at_);
  const char *const begin = at_;
  const llvm::StringRef name = identifier();
  const char *digits = at_;
  if (at_ < end_ && (*at_ == ':' || ((*at_ | 32) == 'n' && name.size() > 1 &&
                                     llvm::all_of(name.drop_front(), isNumberDigit))))
    ++digits;
  if (digits < end_ && isNumberDigit(*digits)) {
    at_ = digits;
    const auto number = double(takeWhole());
    target.kind = ArgumentKind::BlockNumber;
    target.expression = constant(begin, at_, number);
  } else if (!name.empty() &&
             !llvm::StringRef(afterBlanks(name.end()), size_t(end_ - afterBlanks(name.end())))
                  .startswith("<<")) {
    target.kind = ArgumentKind::Label;
    at_ = name.end();
  } else if (!atBlockEnd() && (*at_ == '"' || *at_ == '(' || *at_ == '$' || !name.empty())) {
    target.kind = ArgumentKind::Expression;
    target.expression = expression();
    block_.expressions[target.expression].bad = true; // a name, not a number
  } else {
    issue(SyntaxIssueKind::BadStatement, base_ + item.begin, at_);
  }
  target.end = offset(at_);
  block_.arguments.push_back(target);
  ++item.arguments;
}

/// Whether it can be the name of a label: two letters or more at its begin.
static bool isLabelName(llvm::StringRef name) {
  return name.size() > 1 && llvm::isAlpha(name[0]) && (llvm::isAlpha(name[1]) || name[1] == '_');
}

/// `CASE(R1) OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C`: the last letter of each jump is used as the
/// separator of its target.
void SinumerikScanner::scanCase(const char *begin) {
  Item item = itemAt(ItemKind::Jump, begin);
  item.jump = JumpKind::ByValue;
  item.condition = expression();
  item.firstArgument = uint16_t(block_.arguments.size());
  skipBlanks();
  if (identifier().equals_insensitive("OF"))
    at_ = identifier().end();
  else
    issue(SyntaxIssueKind::BadStatement, begin, at_);
  for (;;) {
    skipBlanks();
    if (atBlockEnd())
      break;
    const bool last = identifier().equals_insensitive("DEFAULT");
    if (last) {
      at_ = identifier().end();
    } else {
      Argument value;
      value.kind = ArgumentKind::Expression;
      value.begin = offset(at_);
      const char *const before = at_;
      value.expression = expression();
      value.end = offset(at_);
      if (at_ == before)
        break;
      block_.arguments.push_back(value);
      ++item.arguments;
    }
    skipBlanks();
    const Keyword jump = sinumerikKeyword(identifier());
    if (!isJump(jump)) {
      issue(SyntaxIssueKind::BadStatement, begin, at_);
      if (isLabelName(identifier())) { // `1 SMALL`: the jump is missing, its target is here
        scanTarget(item);
        if (!last)
          continue;
        break;
      }
      rest();
      if (item.arguments % 2 && !last) {
        block_.arguments.pop_back();
        --item.arguments;
      }
      break;
    }
    at_ = identifier().end();
    scanTarget(item);
    block_.arguments.back().separator = jump == Keyword::GotoForward    ? 'F'
                                        : jump == Keyword::GotoBackward ? 'B'
                                        : jump == Keyword::GotoIfFound  ? 'C'
                                                                        : 0;
    if (last)
      break;
  }
  if (!item.arguments)
    issue(SyntaxIssueKind::BadStatement, begin, at_);
  add(item);
}

/// `FOR I=1 TO 5`
void SinumerikScanner::scanFor(const char *begin) {
  Item item = itemAt(ItemKind::Structure, begin);
  item.structure = Structure::For;
  skipBlanks();
  item.nameBegin = offset(at_);
  item.target = parsed(&SinumerikExpression::parseTarget);
  item.nameEnd = offset(at_);
  skipBlanks();
  bool good = isEquals(at_);
  if (good) {
    ++at_;
    item.value = expression();
    skipBlanks();
    good = identifier().equals_insensitive("TO");
  }
  if (good) {
    at_ = identifier().end();
    item.limit = expression();
    skipBlanks();
    if (const llvm::StringRef step = identifier(); step.equals_insensitive("STEP")) {
      rest();
      issue(SyntaxIssueKind::BadStatement, step.begin(), at_);
    }
  } else {
    issue(SyntaxIssueKind::BadStatement, begin, at_);
    rest();
  }
  add(item);
}

/// `G0`, `X5`: a code or the place of an axis, as no label is called.
static bool isWord(llvm::StringRef name) {
  constexpr llvm::StringLiteral letters{"GMXYZ"};
  return name.size() > 1 && letters.contains(char(name[0] & ~32)) &&
         llvm::all_of(name.drop_front(), isNumberDigit);
}

/// `REPEAT` alone begins a loop; with labels it runs a section again.
void SinumerikScanner::scanRepeat(bool single, const char *begin) {
  skipBlanks();
  if (!single && (atBlockEnd() || isWord(identifier())))
    return structure(Structure::Repeat, begin);
  Item item = itemAt(ItemKind::Repeat, begin);
  item.single = single;
  item.jump = single ? JumpKind::Anywhere : JumpKind::Backward;
  while (!atBlockEnd()) {
    const llvm::StringRef name = identifier();
    const char *const after = afterBlanks(name.end());
    const bool passes = name.size() >= 1 && (name[0] | 32) == 'p' &&
                        (name.size() == 1 || llvm::all_of(name.drop_front(), isNumberDigit)) &&
                        (name.size() > 1 || isEquals(after));
    if (passes) {
      at_ = name.size() > 1 ? name.begin() + 1 : after + 1;
      item.count = expression();
      break;
    }
    if (name.empty() || isNumberDigit(name[0]))
      break;
    Argument label;
    label.kind = ArgumentKind::Label;
    label.begin = offset(name.begin());
    label.end = offset(name.end());
    if (item.arguments)
      label.separator = ' ';
    block_.arguments.push_back(label);
    ++item.arguments;
    at_ = name.end();
    skipBlanks();
  }
  if (item.arguments > 1)
    item.jump = JumpKind::Anywhere;
  if (!item.arguments)
    issue(SyntaxIssueKind::BadStatement, begin, at_);
  add(item);
}

} // namespace ncvet
