// What the blocks of a program refer to.
#include "analyzer/program/reference_reader.h"

#include "formats/dialect/packed_call.h"
#include "formats/readers/table_words.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

/// The targets of a choice by value have their directions each for itself.
JumpKind searchKind(const Item &item, const Argument &target) {
  return item.jump != JumpKind::ByValue ? item.jump
         : target.separator == 'F'      ? JumpKind::Forward
         : target.separator == 'B'      ? JumpKind::Backward
         : target.separator == 'C'      ? JumpKind::IfFound
                                        : JumpKind::Anywhere;
}

Search searchOf(JumpKind kind) {
  return kind == JumpKind::Forward    ? Search::Forward
         : kind == JumpKind::Backward ? Search::Backward
                                      : Search::Anywhere;
}

Reference Reference::toBlock(int64_t number, Search search) {
  Reference reference;
  reference.to = ReferredKind::Block;
  reference.search = search;
  reference.number = number;
  return reference;
}

Reference Reference::toLabel(llvm::StringRef label, Search search) {
  Reference reference;
  reference.to = ReferredKind::Label;
  reference.search = search;
  reference.text = label;
  return reference;
}

void ReferenceReader::CodeWords::take(const CodeInfo &code) {
  if (action == Action::None)
    action = code.action;
  for (const WordSpec &spec : code.words) {
    if (spec.role == Role::ProfileFirst)
      first |= spec.any;
    else if (spec.role == Role::ProfileLast)
      last |= spec.any;
    else if (spec.role == Role::Sequence && !spec.position)
      sequence |= spec.any;
    else if (spec.role == Role::Program && spec.text && spec.position)
      contour = spec.position;
  }
}

ReferenceReader::ReferenceReader(const Dialect &dialect) : dialect_(dialect) {
  codes_.resize(dialect.codes.size());
  for (size_t i = 0; i < codes_.size(); ++i) {
    CodeWords &words = codes_[i];
    if (dialect.codes[i].elsewhere)
      continue;
    words.take(dialect.codes[i]);
    for (const Variant &variant : dialect.codes[i].variants)
      words.take(dialect.codes[variant.code]);
    words.any =
        namesTarget(words.action) || words.first || words.last || words.sequence || words.contour;
  }
}

/// The references of one block.
class BlockReferences {
public:
  BlockReferences(const ReferenceReader &reader, const Block &block, llvm::StringRef text,
                  ReferenceReader::Visit visit)
      : dialect_(reader.dialect_), codes_(reader.codes_), block_(block), text_(text),
        visit_(visit) {}

  void words();
  void item(const Item &item);

private:
  using CodeWords = ReferenceReader::CodeWords;

  void code(const Word &word, const CodeWords &words);
  void calledProgram(const CodeWords &words);
  void blocksOf(AddressMask mask, ReferenceKind kind);
  void contour(const Word &word, const CodeWords &words);
  void call(const Item &item);
  void jump(const Item &item);
  void repeat(const Item &item);
  void target(const Argument &target, ReferenceKind kind, JumpKind direction, bool inCalled);

  /// The digits of a number that begins in [begin, end).
  llvm::StringRef digitsIn(uint32_t begin, uint32_t end) const {
    while (begin < end && !llvm::isDigit(text_[begin]))
      ++begin;
    return text_.drop_front(begin).take_while(llvm::isDigit);
  }
  llvm::StringRef digitsOf(const Word &word) const {
    const llvm::StringRef spelling = text_.slice(word.offset, block_.endOf(word));
    return spelling.drop_until(llvm::isDigit);
  }
  void named(ReferenceKind kind, ReferredKind to, llvm::StringRef text, int64_t runs = 1) {
    Reference reference;
    reference.kind = kind;
    reference.to = to;
    reference.runs = runs;
    reference.text = text;
    visit_(reference);
  }
  void numbered(ReferenceKind kind, ReferredKind to, int64_t number, llvm::StringRef text,
                bool inCalled = false) {
    Reference reference;
    reference.kind = kind;
    reference.to = to;
    reference.number = number;
    reference.text = text;
    reference.inCalled = inCalled;
    visit_(reference);
  }
  void untoldProgram(uint32_t at) {
    named(ReferenceKind::Call, ReferredKind::UntoldProgram, text_.slice(at, at));
  }
  void untoldBlock(ReferenceKind kind, uint32_t at) {
    named(kind, ReferredKind::UntoldBlock, text_.slice(at, at));
  }
  static bool isWhole(const Word &word) {
    return word.isNumber() && word.isWhole() && word.mantissa >= 0;
  }
  std::optional<int64_t> constant(uint16_t expression) const;

  const Dialect &dialect_;
  const std::vector<CodeWords> &codes_;
  const Block &block_;
  const llvm::StringRef text_;
  const ReferenceReader::Visit visit_;
};

void BlockReferences::words() {
  constexpr AddressMask codes = maskOf('G') | maskOf('M') | maskOf(keywordAddress);
  if (!block_.hasAny(codes))
    return;
  for (const Word &word : block_.words)
    if (const CodeIndex index = codeOf(dialect_, word); index != noCode && codes_[index].any)
      code(word, codes_[index]);
}

void BlockReferences::code(const Word &word, const CodeWords &words) {
  switch (words.action) {
  case Action::CallProgram:
  case Action::MacroCall:
  case Action::MacroModal:
    calledProgram(words);
    break;
  case Action::CallLocal:
    // An N word after the code is taken as the target too.
    blocksOf(block_.has(letterAddress('P')) ? maskOf('P') : maskOf('N'), ReferenceKind::Call);
    break;
  case Action::Return:
    blocksOf(maskOf('P'), ReferenceKind::Return);
    break;
  case Action::ConditionalJump:
    blocksOf(words.sequence ? words.sequence : maskOf('P'), ReferenceKind::Jump);
    break;
  default:
    break;
  }
  if (words.first | words.last) {
    blocksOf(words.first, ReferenceKind::First);
    blocksOf(words.last, ReferenceKind::Last);
  }
  if (words.contour)
    contour(word, words);
}

/// `M98 P1000`, `G65 P9010`; Q is the block at which the program begins.
void BlockReferences::calledProgram(const CodeWords &words) {
  const Word *const p = block_.find('P');
  if (!p && block_.nameEnd > block_.nameBegin) // `M98 <NAME>`
    return named(ReferenceKind::Call, ReferredKind::NamedProgram,
                 text_.slice(block_.nameBegin, block_.nameEnd));
  if (!p) // `M98 Q100`
    return blocksOf(words.sequence, ReferenceKind::Call);
  if (!isWhole(*p))
    return untoldProgram(p->offset);
  const bool macro = llvm::any_of(block_.words, [&](const Word &word) {
    const CodeIndex code = codeOf(dialect_, word);
    return code != noCode &&
           (codes_[code].action == Action::MacroCall || codes_[code].action == Action::MacroModal);
  });
  const Word *const count = block_.find('L');
  const PackedCall call = unpackCall(dialect_, p->mantissa, macro || count);
  Reference reference;
  reference.to = ReferredKind::Program;
  reference.number = call.program;
  reference.runs = !count ? call.runs : isWhole(*count) ? count->mantissa : 0;
  reference.packed = !macro && dialect_.limits.packedCallDigits;
  reference.text = digitsOf(*p);
  if (call.digits && reference.text.size() > call.digits)
    reference.text = reference.text.take_back(call.digits);
  visit_(reference);
  const Word *const q = macro ? nullptr : block_.find('Q');
  if (q && isWhole(*q))
    numbered(ReferenceKind::First, ReferredKind::Block, q->mantissa, digitsOf(*q), true);
}

/// Blocks of this program that words with these addresses number.
void BlockReferences::blocksOf(AddressMask mask, ReferenceKind kind) {
  const Word *const word = block_.findAny(mask);
  if (!word || word->has(wordNoValue))
    return;
  if (isWhole(*word))
    numbered(kind, ReferredKind::Block, word->mantissa, digitsOf(*word));
  else
    untoldBlock(kind, word->offset);
}

/// `CYCLE95("CONTOUR", …)`, `CYCLE95("BEGIN:END", …)`
void BlockReferences::contour(const Word &word, const CodeWords &words) {
  for (const Item &item : block_.items) {
    if (item.kind != ItemKind::Instruction || item.begin != word.offset ||
        item.arguments < words.contour)
      continue;
    const Argument &argument = block_.argumentsOf(item)[words.contour - 1];
    if (argument.kind != ArgumentKind::Text)
      continue;
    const llvm::StringRef name = text_.slice(argument.begin, argument.end);
    const size_t colon = name.find(':');
    if (colon == llvm::StringRef::npos) {
      named(ReferenceKind::Call, ReferredKind::NamedProgram, name);
      continue;
    }
    named(ReferenceKind::First, ReferredKind::Label, name.take_front(colon).trim());
    named(ReferenceKind::Last, ReferredKind::Label, name.drop_front(colon + 1).trim());
  }
}

void BlockReferences::item(const Item &item) {
  switch (item.kind) {
  case ItemKind::Call:
    return call(item);
  case ItemKind::Jump:
    return jump(item);
  case ItemKind::Repeat:
    return repeat(item);
  case ItemKind::Input:
    if (item.arguments)
      target(block_.argumentsOf(item)[0], ReferenceKind::Jump, JumpKind::Anywhere, false);
    return;
  default:
    return;
  }
}

void BlockReferences::call(const Item &item) {
  if (item.nameEnd <= item.nameBegin)
    return untoldProgram(item.begin);
  named(ReferenceKind::Call,
        item.positional ? ReferredKind::Subprogram : ReferredKind::NamedProgram,
        text_.slice(item.nameBegin, item.nameEnd),
        item.count == noExpression ? 1 : constant(item.count).value_or(0));
}

/// The whole number that an expression is; none when it is computed.
std::optional<int64_t> BlockReferences::constant(uint16_t expression) const {
  const auto value = block_.numberIn(expression);
  if (!value || !(*value >= 0 && *value < 1e15) || *value != double(int64_t(*value)))
    return std::nullopt;
  return int64_t(*value);
}

/// One place that a jump, a repeat or an answer leads to.
void BlockReferences::target(const Argument &target, ReferenceKind kind, JumpKind direction,
                             bool inCalled) {
  Reference reference;
  reference.kind = kind;
  reference.search = searchOf(direction);
  reference.inCalled = inCalled;
  if (target.kind == ArgumentKind::Label) {
    reference.to = ReferredKind::Label;
    reference.text = text_.slice(target.begin, target.end);
    if (!reference.text.empty())
      visit_(reference);
    return;
  }
  if (target.kind != ArgumentKind::BlockNumber && target.kind != ArgumentKind::Expression)
    return;
  const auto number = constant(target.expression);
  if (!number || target.kind != ArgumentKind::BlockNumber)
    return untoldBlock(kind, target.begin);
  reference.to = ReferredKind::Block;
  reference.number = *number;
  reference.text = digitsIn(target.begin, target.end);
  visit_(reference);
}

void BlockReferences::jump(const Item &item) {
  const bool elsewhere = item.nameEnd > item.nameBegin;
  if (elsewhere)
    named(ReferenceKind::Jump, ReferredKind::NamedProgram,
          text_.slice(item.nameBegin, item.nameEnd));
  const llvm::ArrayRef<Argument> all = block_.argumentsOf(item);
  for (size_t i = 0; i < all.size(); ++i)
    // Of pairs of a constant and its target, the last target alone.
    if (item.jump != JumpKind::ByValue || i % 2 == 1 || i + 1 == all.size())
      target(all[i], ReferenceKind::Jump, searchKind(item, all[i]), elsewhere);
  if (!all.empty() || item.value >= block_.expressions.size())
    return;
  const Expression &value = block_.expressions[item.value];
  if (const auto number = constant(item.value))
    numbered(ReferenceKind::Jump, ReferredKind::Block, *number,
             digitsIn(block_.operations[value.first].offset, value.end));
  else if (value.end > value.begin)
    untoldBlock(ReferenceKind::Jump, item.begin);
}

void BlockReferences::repeat(const Item &item) {
  const llvm::ArrayRef<Argument> places = block_.argumentsOf(item);
  if (!places.empty())
    target(places[0], places.size() > 1 ? ReferenceKind::First : ReferenceKind::Jump, item.jump,
           false);
  if (places.size() > 1)
    target(places[1], ReferenceKind::Last, JumpKind::Anywhere, false);
}

void ReferenceReader::words(const Block &block, llvm::StringRef text, Visit visit) const {
  BlockReferences(*this, block, text, visit).words();
}

void ReferenceReader::item(const Block &block, const Item &item, llvm::StringRef text,
                           Visit visit) const {
  BlockReferences(*this, block, text, visit).item(item);
}

} // namespace ncvet
