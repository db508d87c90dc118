// Finds the names of a file in one pass over its blocks.
#include "lsp/features/name_finder.h"

#include "llvm/ADT/DenseSet.h"
#include "llvm/ADT/SetVector.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/xxhash.h"

#include <algorithm>
#include <tuple>

namespace ncvet::lsp {

uint64_t programKey(llvm::StringRef name) {
  constexpr uint64_t named = uint64_t(1) << 63; // in front of every number
  return named | llvm::xxHash64(name.upper());
}

uint64_t labelKeyOf(const Reader &reader, llvm::StringRef label) {
  return llvm::xxHash64(reader.labelKey(label));
}

namespace {

bool isSpace(char c) { return c == ' ' || c == '\t'; }

/// What a code's words name.
struct CodeNames {
  Action action = Action::None;
  AddressMask first = 0, last = 0; ///< blocks of a profile
  AddressMask sequence = 0;        ///< a block to jump to
  unsigned contour = 0;            ///< argument that names a contour's program, from 1; 0: none
  bool any = false;
};

/// Reads the names of a file's blocks, one block after the other.
class NameFinder {
public:
  explicit NameFinder(const FileUnit &unit)
      : unit_(unit), dialect_(*unit.dialect), text_(unit.source.text()) {}

  FoundNames find();

private:
  struct Return {
    size_t occurrence;
    uint32_t program;
  };

  void prepare();
  void block();
  void header();
  void numberAndLabel();
  void words();
  void code(const Word &word, const CodeNames &names);
  void calledProgram();
  void blocksOf(AddressMask mask, NameUse use);
  void contour(const Word &word, const CodeNames &names);
  void tool(const Word &word);
  void elements();
  void item(const Item &item);
  void assignment(const Item &item);
  void parameters(const Item &item);
  void bracket(const Item &item);
  void call(const Item &item);
  void jump(const Item &item);
  void repeat(const Item &item);
  void target(const Argument &target, NameUse use, JumpKind kind, uint32_t scope);
  void operations();
  void finishBlock(size_t first);
  void resolveReturns();
  void scopeVariables();

  Occurrence &add(NameKind kind, NameUse use, uint64_t key, uint32_t begin, uint32_t end,
                  uint32_t scope) {
    Occurrence &one = all_.emplace_back();
    one.kind = kind;
    one.use = use;
    one.key = key;
    one.begin = begin;
    one.end = std::max(begin, end);
    one.scope = scope;
    return one;
  }
  void addProgram(NameUse use, uint32_t begin, uint32_t end);
  void addVariable(NameUse use, uint64_t key, uint32_t begin, uint32_t end) {
    if (key)
      add(NameKind::Variable, use, key, begin, end, isOwn(key) ? scope_ : wholeFile);
  }
  /// Whether a variable belongs to the running program, by its key alone.
  bool isOwn(uint64_t key) const {
    return key < firstSharedVariable ? key <= uint64_t(dialect_.variableRanges.lastLocal)
                                     : key >= firstNamedVariable && isNamedLocal();
  }
  bool isNamedLocal() const { return dialect_.variableRanges.namedLocal; }
  void untold(uint32_t UntoldNames::*what, uint32_t at) {
    uint32_t &place = untold_[program_].*what;
    place = std::min(place, at);
  }
  uint32_t firstDigit(uint32_t begin, uint32_t end) const {
    while (begin < end && !llvm::isDigit(text_[begin]))
      ++begin;
    return begin;
  }
  uint32_t behindDigits(uint32_t begin) const {
    while (begin < text_.size() && llvm::isDigit(text_[begin]))
      ++begin;
    return begin;
  }
  std::pair<uint32_t, uint32_t> variableAt(uint32_t offset) const;
  /// The whole number that an expression is; none when it is computed.
  std::optional<int64_t> constant(uint16_t expression) const;
  uint32_t scopeOf(const ProgramInfo *program) const {
    return uint32_t(program - unit_.index.programs().begin());
  }
  /// Scope of the first program of this file with a key, or `otherFile`.
  uint32_t programOf(uint64_t key) const {
    const auto found = programs_.find(key);
    return found == programs_.end() ? otherFile : found->second;
  }

  const FileUnit &unit_;
  const Dialect &dialect_;
  const llvm::StringRef text_;
  std::vector<Occurrence> all_;
  std::vector<Scope> scopes_;
  std::vector<UntoldNames> untold_;
  std::vector<CodeNames> codes_;
  llvm::DenseMap<uint64_t, uint32_t> programs_; ///< by key: by number or by name
  std::vector<Return> returns_;
  uint32_t untoldReturn_ = UntoldNames::nowhere; ///< a return to a computed block of the caller
  llvm::DenseSet<std::pair<uint32_t, uint64_t>> defined_; ///< variables, by program
  llvm::DenseSet<std::pair<uint32_t, uint64_t>> macros_;  ///< by program
  std::vector<bool> callsLocally_;                        ///< by program
  Block block_;
  uint32_t program_ = 0;
  uint32_t scope_ = 0;
};

/// What each code of the table names, its variants included.
void NameFinder::prepare() {
  codes_.resize(dialect_.codes.size());
  const auto take = [](CodeNames &names, const CodeInfo &code) {
    if (names.action == Action::None)
      names.action = code.action;
    for (const WordSpec &spec : code.words) {
      if (spec.role == Role::ProfileFirst)
        names.first |= spec.any;
      else if (spec.role == Role::ProfileLast)
        names.last |= spec.any;
      else if (spec.role == Role::Sequence && !spec.position)
        names.sequence |= spec.any;
      else if (spec.role == Role::Program && spec.text && spec.position)
        names.contour = spec.position;
    }
  };
  for (size_t i = 0; i < codes_.size(); ++i) {
    CodeNames &names = codes_[i];
    take(names, dialect_.codes[i]);
    for (const Variant &variant : dialect_.codes[i].variants)
      take(names, dialect_.codes[variant.code]);
    switch (names.action) {
    case Action::CallProgram:
    case Action::MacroCall:
    case Action::MacroModal:
    case Action::CallLocal:
    case Action::Return:
    case Action::ConditionalJump:
      names.any = true;
      break;
    default:
      names.any = names.first || names.last || names.sequence || names.contour;
    }
  }
}

FoundNames NameFinder::find() {
  prepare();
  const auto programs = unit_.index.programs();
  for (const ProgramInfo &program : programs) {
    const auto index = uint32_t(scopes_.size());
    scopes_.push_back({program.begin, program.end, index});
    if (program.hasHeader() && program.number >= 0)
      programs_.try_emplace(uint64_t(program.number), index);
    if (!program.name.empty())
      programs_.try_emplace(programKey(program.name), index);
  }
  untold_.resize(scopes_.size());
  callsLocally_.resize(scopes_.size());
  for (uint32_t at = unit_.reader->first(); at < text_.size();) {
    if (program_ + 1 < programs.size() && programs[program_ + 1].begin <= at)
      scope_ = ++program_;
    unit_.reader->read(at, block_);
    const size_t first = all_.size();
    block();
    if (all_.size() - first > 1)
      finishBlock(first);
    if (block_.next <= at)
      break;
    at = block_.next;
  }
  resolveReturns();
  scopeVariables();
  all_.shrink_to_fit();
  return {std::move(all_), std::move(scopes_), std::move(untold_)};
}

/// Brings the names of one block into the order of the text, each once.
void NameFinder::finishBlock(size_t first) {
  const auto order = [](const Occurrence &one) {
    return std::make_tuple(one.begin, one.end, one.kind, one.use, one.key);
  };
  const auto begin = all_.begin() + ptrdiff_t(first);
  std::stable_sort(begin, all_.end(),
                   [&](const Occurrence &a, const Occurrence &b) { return order(a) < order(b); });
  all_.erase(
      std::unique(begin, all_.end(),
                  [&](const Occurrence &a, const Occurrence &b) { return order(a) == order(b); }),
      all_.end());
}

void NameFinder::block() {
  if (block_.kind == BlockKind::ProgramHeader)
    header();
  numberAndLabel();
  if (!block_.words.empty())
    words();
  for (const Item &one : block_.items)
    item(one);
  if (!block_.operations.empty())
    operations();
}

void NameFinder::header() {
  if (block_.nameEnd > block_.nameBegin) {
    addProgram(NameUse::Definition, block_.nameBegin, block_.nameEnd);
  } else if (block_.program >= 0) {
    const uint32_t begin = firstDigit(block_.headerBegin, block_.headerEnd);
    add(NameKind::Program, NameUse::Definition, uint64_t(block_.program), begin,
        behindDigits(begin), wholeFile);
  }
}

void NameFinder::numberAndLabel() {
  if (block_.number >= 0 && block_.numberEnd > block_.numberBegin)
    add(NameKind::Block, NameUse::Definition, uint64_t(block_.number),
        firstDigit(block_.numberBegin, block_.numberEnd), block_.numberEnd, program_);
  const bool opens = !block_.items.empty() && block_.items[0].kind == ItemKind::Structure &&
                     block_.items[0].structure == Structure::Sub;
  if (block_.hasLabel() && !opens)
    add(NameKind::Label, NameUse::Definition,
        labelKeyOf(*unit_.reader, text_.slice(block_.labelBegin, block_.labelEnd)),
        block_.labelBegin, block_.labelEnd, program_);
}

void NameFinder::addProgram(NameUse use, uint32_t begin, uint32_t end) {
  llvm::StringRef name = text_.slice(begin, end);
  const size_t slash = name.find_last_of("/\\"); // only the name counts
  if (slash != llvm::StringRef::npos) {
    begin += uint32_t(slash + 1);
    name = name.drop_front(slash + 1);
  }
  const uint64_t key = programKey(name);
  if (use != NameUse::Definition && macros_.contains({program_, key}))
    add(NameKind::Macro, NameUse::Read, key, begin, end, program_);
  else
    add(NameKind::Program, use, key, begin, end, wholeFile);
}

void NameFinder::words() {
  constexpr AddressMask codes = maskOf('G') | maskOf('M') | maskOf(keywordAddress);
  if (block_.has(letterAddress('T')))
    for (const Word &word : block_.words)
      if (word.address == letterAddress('T'))
        tool(word);
  if (block_.hasAny(dialect_.elementWords))
    elements();
  if (!block_.hasAny(codes))
    return;
  for (const Word &word : block_.words)
    if (const CodeIndex index = codeOf(dialect_, word); index != noCode && codes_[index].any)
      code(word, codes_[index]);
}

void NameFinder::code(const Word &word, const CodeNames &names) {
  switch (names.action) {
  case Action::CallProgram:
  case Action::MacroCall:
  case Action::MacroModal:
    calledProgram();
    break;
  case Action::CallLocal:
    callsLocally_[program_] = true;
    // An N word behind the code is taken as the target too.
    blocksOf(block_.has(letterAddress('P')) ? maskOf('P') : maskOf('N'), NameUse::Call);
    break;
  case Action::Return:
    blocksOf(maskOf('P'), NameUse::Return);
    break;
  case Action::ConditionalJump:
    blocksOf(names.sequence ? names.sequence : maskOf('P'), NameUse::Jump);
    break;
  default:
    break;
  }
  if (names.first | names.last) {
    blocksOf(names.first, NameUse::First);
    blocksOf(names.last, NameUse::Last);
  }
  if (names.contour)
    contour(word, names);
}

/// `M98 P1000`, `G65 P9010`; Q is the block at which the program begins.
void NameFinder::calledProgram() {
  const Word *const p = block_.find('P');
  if (!p)
    return;
  if (!p->isNumber() || !p->isWhole() || p->mantissa < 0)
    return untold(&UntoldNames::call, p->offset);
  const uint32_t end = block_.endOf(*p);
  uint32_t begin = firstDigit(p->offset, end);
  int64_t number = p->mantissa;
  const bool macro = llvm::any_of(block_.words, [&](const Word &word) {
    const CodeIndex code = codeOf(dialect_, word);
    return code != noCode &&
           (codes_[code].action == Action::MacroCall || codes_[code].action == Action::MacroModal);
  });
  // Where numbers have four digits, those in front of them say how often it runs.
  if (!macro && number > 9999 && !block_.has(letterAddress('L')) &&
      dialect_.limits.programDigitsMax == 4 && end - begin > 4) {
    number %= 10000;
    begin = end - 4;
  }
  add(NameKind::Program, NameUse::Call, uint64_t(number), begin, end, wholeFile);
  const Word *const q = macro ? nullptr : block_.find('Q');
  if (q && q->isNumber() && q->isWhole() && q->mantissa >= 0)
    add(NameKind::Block, NameUse::First, uint64_t(q->mantissa),
        firstDigit(q->offset, block_.endOf(*q)), block_.endOf(*q), programOf(uint64_t(number)));
}

/// Blocks of this program that words with these addresses number.
void NameFinder::blocksOf(AddressMask mask, NameUse use) {
  const Word *const word = block_.findAny(mask);
  if (!word || word->has(wordNoValue))
    return;
  if (!word->isNumber() || !word->isWhole() || word->mantissa < 0) {
    if (use == NameUse::Return)
      untoldReturn_ = std::min(untoldReturn_, word->offset);
    return untold(&UntoldNames::target, word->offset);
  }
  const uint32_t end = block_.endOf(*word);
  if (use == NameUse::Return)
    returns_.push_back({all_.size(), program_});
  add(NameKind::Block, use, uint64_t(word->mantissa), firstDigit(word->offset, end), end, program_);
}

/// `CYCLE95("CONTOUR", …)`, `CYCLE95("BEGIN:END", …)`
void NameFinder::contour(const Word &word, const CodeNames &names) {
  for (const Item &item : block_.items) {
    if (item.kind != ItemKind::Instruction || item.begin != word.offset ||
        item.arguments < names.contour)
      continue;
    const Argument &argument = block_.argumentsOf(item)[names.contour - 1];
    if (argument.kind != ArgumentKind::Text)
      continue;
    const llvm::StringRef name = text_.slice(argument.begin, argument.end);
    const size_t colon = name.find(':');
    if (colon == llvm::StringRef::npos) {
      addProgram(NameUse::Call, argument.begin, argument.end);
      continue;
    }
    const uint32_t middle = argument.begin + uint32_t(colon);
    add(NameKind::Label, NameUse::First, labelKeyOf(*unit_.reader, name.take_front(colon)),
        argument.begin, middle, program_);
    add(NameKind::Label, NameUse::Last, labelKeyOf(*unit_.reader, name.drop_front(colon + 1)),
        middle + 1, argument.end, program_);
  }
}

/// Of a lathe's T word the last two digits are an offset.
void NameFinder::tool(const Word &word) {
  if (!word.isNumber() || !word.isWhole() || word.mantissa < 0)
    return;
  const bool pair = dialect_.isLathe() && (word.mantissa >= 100 || word.has(wordLeadingZero));
  const uint32_t end = block_.endOf(word);
  add(NameKind::Tool, NameUse::Read, uint64_t(pair ? word.mantissa / 100 : word.mantissa),
      firstDigit(word.offset, end), end, wholeFile);
}

/// `L1=…` defines an element of a contour; other words with its name use it.
void NameFinder::elements() {
  bool defines = llvm::any_of(block_.words, [&](const Word &word) {
    const CodeIndex code = codeOf(dialect_, word);
    return code != noCode && dialect_.codes[code].action == Action::DefineElement;
  });
  for (const Word &word : block_.words) {
    if (!(dialect_.elementWords & maskOf(word.address)) || !word.isNumber() || word.mantissa < 0)
      continue;
    constexpr unsigned behindNumber = 48;
    add(NameKind::Element, defines ? NameUse::Definition : NameUse::Read,
        uint64_t(word.address) << behindNumber | uint64_t(word.mantissa), word.offset,
        block_.endOf(word), program_);
    defines = false;
  }
}

void NameFinder::item(const Item &item) {
  switch (item.kind) {
  case ItemKind::Assignment:
    return assignment(item);
  case ItemKind::Definition:
    defined_.insert({program_, block_.keyOf(item.target)});
    return addVariable(NameUse::Definition, block_.keyOf(item.target), item.nameBegin,
                       item.nameEnd);
  case ItemKind::Parameters:
    return parameters(item);
  case ItemKind::Declaration:
    return addProgram(NameUse::Declaration, item.nameBegin, item.nameEnd);
  case ItemKind::Macro: {
    const uint64_t key = programKey(text_.slice(item.nameBegin, item.nameEnd));
    macros_.insert({program_, key});
    add(NameKind::Macro, NameUse::Definition, key, item.nameBegin, item.nameEnd, program_);
    return;
  }
  case ItemKind::Structure:
    if (item.structure == Structure::For)
      return assignment(item);
    return bracket(item);
  case ItemKind::Call:
    return call(item);
  case ItemKind::Jump:
    return jump(item);
  case ItemKind::Repeat:
    return repeat(item);
  case ItemKind::Input:
    if (item.target != noExpression)
      assignment(item);
    if (item.arguments)
      target(block_.argumentsOf(item)[0], NameUse::Jump, JumpKind::Anywhere, program_);
    return;
  default:
    return;
  }
}

/// The variable that an item writes.
void NameFinder::assignment(const Item &item) {
  if (item.target >= block_.expressions.size() || item.nameEnd <= item.nameBegin)
    return;
  const Expression &target = block_.expressions[item.target];
  llvm::StringRef name = text_.slice(item.nameBegin, item.nameEnd);
  uint64_t key = block_.keyOf(item.target);
  const ExpressionOp *const last =
      target.count ? &block_.operations[target.first + target.count - 1] : nullptr;
  if (!key && last && last->op == Op::ElementKey) {
    key = uint64_t(last->value); // of the array; which element does not matter
    name = name.take_until([](char c) { return c == '[' || isSpace(c); });
  }
  if (!key)
    return untold(&UntoldNames::variable, item.nameBegin);
  // `#[100]`, `# 1`, `#<name>`: its marks are no part of the name.
  llvm::StringRef bare = name.trim("# \t");
  if (bare.startswith("[") || bare.startswith("<"))
    bare = bare.trim("[]<> \t");
  const auto begin = uint32_t(bare.begin() - text_.begin());
  if (!bare.empty())
    addVariable(NameUse::Write, key, begin, begin + uint32_t(bare.size()));
}

/// `PROC NAME(REAL A, VAR INT B)`
void NameFinder::parameters(const Item &item) {
  addProgram(NameUse::Declaration, item.nameBegin, item.nameEnd);
  for (const Argument &parameter : block_.argumentsOf(item)) {
    if (parameter.end <= parameter.begin)
      continue;
    const uint64_t key = variableKey(text_.slice(parameter.begin, parameter.end));
    defined_.insert({program_, key});
    addVariable(NameUse::Definition, key, parameter.begin, parameter.end);
  }
}

/// `o100 sub`, `o101 if [..]`: brackets with labels.
void NameFinder::bracket(const Item &item) {
  if (!item.label || item.nameEnd <= item.nameBegin)
    return;
  const uint64_t key = labelKeyOf(*unit_.reader, text_.slice(item.nameBegin, item.nameEnd));
  const bool subprogram = item.structure == Structure::Sub || item.structure == Structure::EndSub ||
                          item.structure == Structure::Return;
  const NameUse use = item.structure == Structure::Sub ? NameUse::Definition : NameUse::Read;
  if (item.structure == Structure::EndSub && scope_ != program_) {
    scopes_[scope_].end = block_.next;
    scope_ = program_;
  }
  if (subprogram)
    add(NameKind::Subprogram, use, key, item.nameBegin, item.nameEnd, wholeFile);
  else
    add(NameKind::Bracket, use, key, item.nameBegin, item.nameEnd, scope_);
  if (item.structure == Structure::Sub) {
    scope_ = uint32_t(scopes_.size());
    scopes_.push_back({block_.begin, scopes_[program_].end, program_});
  }
}

void NameFinder::call(const Item &item) {
  if (item.nameEnd <= item.nameBegin)
    return untold(&UntoldNames::call, item.begin);
  if (!item.positional)
    return addProgram(NameUse::Call, item.nameBegin, item.nameEnd);
  add(NameKind::Subprogram, NameUse::Call,
      labelKeyOf(*unit_.reader, text_.slice(item.nameBegin, item.nameEnd)), item.nameBegin,
      item.nameEnd, wholeFile);
}

std::optional<int64_t> NameFinder::constant(uint16_t expression) const {
  if (expression >= block_.expressions.size())
    return std::nullopt;
  const Expression &e = block_.expressions[expression];
  if (e.count != 1 || block_.operations[e.first].op != Op::Number)
    return std::nullopt;
  const double value = block_.operations[e.first].value;
  if (!(value >= 0 && value < 1e15) || value != double(int64_t(value)))
    return std::nullopt;
  return int64_t(value);
}

/// One place that a jump, a repeat or an answer leads to.
void NameFinder::target(const Argument &target, NameUse use, JumpKind kind, uint32_t scope) {
  const Search search = kind == JumpKind::Forward    ? Search::Forward
                        : kind == JumpKind::Backward ? Search::Backward
                                                     : Search::Anywhere;
  if (target.kind == ArgumentKind::Label) {
    if (target.end > target.begin)
      add(NameKind::Label, use, labelKeyOf(*unit_.reader, text_.slice(target.begin, target.end)),
          target.begin, target.end, scope)
          .search = search;
    return;
  }
  if (target.kind != ArgumentKind::BlockNumber && target.kind != ArgumentKind::Expression)
    return;
  const auto number = constant(target.expression);
  if (!number || target.kind != ArgumentKind::BlockNumber)
    return untold(&UntoldNames::target, target.begin);
  const uint32_t begin = firstDigit(target.begin, target.end);
  add(NameKind::Block, use, uint64_t(*number), begin, behindDigits(begin), scope).search = search;
}

void NameFinder::jump(const Item &item) {
  uint32_t scope = program_;
  if (item.nameEnd > item.nameBegin) {
    const llvm::StringRef name = text_.slice(item.nameBegin, item.nameEnd);
    addProgram(NameUse::Jump, item.nameBegin, item.nameEnd);
    scope = programOf(programKey(name));
  }
  const llvm::ArrayRef<Argument> all = block_.argumentsOf(item);
  for (size_t i = 0; i < all.size(); ++i)
    // Of pairs of a constant and its target, the last target alone.
    if (item.jump != JumpKind::ByValue || i % 2 == 1 || i + 1 == all.size())
      target(all[i], NameUse::Jump, item.jump, scope);
  if (!all.empty() || item.value == noExpression)
    return;
  const auto number = constant(item.value);
  if (!number) {
    const bool empty = item.value < block_.expressions.size() &&
                       block_.expressions[item.value].end <= block_.expressions[item.value].begin;
    if (!empty)
      untold(&UntoldNames::target, item.begin);
    return;
  }
  const Expression &e = block_.expressions[item.value];
  const uint32_t begin = firstDigit(block_.operations[e.first].offset, e.end);
  add(NameKind::Block, NameUse::Jump, uint64_t(*number), begin, behindDigits(begin), program_);
}

void NameFinder::repeat(const Item &item) {
  const llvm::ArrayRef<Argument> places = block_.argumentsOf(item);
  if (!places.empty())
    target(places[0], places.size() > 1 ? NameUse::First : NameUse::Jump, item.jump, program_);
  if (places.size() > 1)
    target(places[1], NameUse::Last, JumpKind::Anywhere, program_);
}

/// Where the name of a variable stands that is spelled at `offset`, without its marks.
std::pair<uint32_t, uint32_t> NameFinder::variableAt(uint32_t offset) const {
  const auto size = uint32_t(text_.size());
  uint32_t begin = offset;
  if (begin < size && text_[begin] == '#')
    ++begin;
  while (begin < size && isSpace(text_[begin]))
    ++begin;
  if (begin < size && text_[begin] == '<') {
    const size_t close = text_.find('>', ++begin);
    return {begin, close == llvm::StringRef::npos ? begin : uint32_t(close)};
  }
  uint32_t end = begin;
  while (end < size && (llvm::isAlnum(text_[end]) || text_[end] == '_' || text_[end] == '%'))
    ++end;
  return {begin, end};
}

/// Variables that the block reads.
void NameFinder::operations() {
  for (size_t i = 0; i < block_.operations.size(); ++i) {
    const ExpressionOp &op = block_.operations[i];
    switch (op.op) {
    case Op::Variable:
    case Op::ElementAt:
    case Op::Exists: {
      const auto [begin, end] = variableAt(op.offset);
      if (end > begin)
        addVariable(NameUse::Read, uint64_t(op.value), begin, end);
      break;
    }
    case Op::VariableAt:
      // `#[100]` is `#100`.
      if (i > 0 && block_.operations[i - 1].op == Op::Number &&
          block_.operations[i - 1].offset > op.offset && block_.operations[i - 1].value >= 0 &&
          block_.operations[i - 1].value < 1e9) {
        const uint32_t begin = firstDigit(op.offset, uint32_t(text_.size()));
        addVariable(NameUse::Read, uint64_t(block_.operations[i - 1].value), begin,
                    behindDigits(begin));
      } else {
        untold(&UntoldNames::variable, op.offset);
      }
      break;
    default:
      break;
    }
  }
}

/// `M99 P10` goes on at a block of the caller: of every program of the file that calls this one.
void NameFinder::resolveReturns() {
  if (untoldReturn_ != UntoldNames::nowhere)
    for (UntoldNames &program : untold_) // where it leads back to, any of them may be
      program.target = std::min(program.target, untoldReturn_);
  if (returns_.empty())
    return;
  std::map<uint32_t, llvm::SmallSetVector<uint32_t, 2>> callers;
  for (const Occurrence &one : all_)
    if (one.kind == NameKind::Program && one.use == NameUse::Call && one.key < firstNamedVariable)
      if (const uint32_t called = programOf(one.key); called != otherFile)
        callers[called].insert(scopeOf(&unit_.index.programAt(one.begin)));
  std::vector<Occurrence> further;
  for (const Return &from : returns_) {
    auto &scopes = callers[from.program];
    // A main program goes on in itself, and so does one that calls its own blocks.
    if (scopes.empty() || callsLocally_[from.program])
      scopes.insert(from.program);
    for (size_t i = 0; i < scopes.size(); ++i)
      if (i == 0) {
        all_[from.occurrence].scope = scopes[i];
      } else {
        further.push_back(all_[from.occurrence]);
        further.back().scope = scopes[i];
      }
  }
  if (further.empty())
    return;
  all_.insert(all_.end(), further.begin(), further.end());
  std::stable_sort(all_.begin(), all_.end(),
                   [](const Occurrence &a, const Occurrence &b) { return a.begin < b.begin; });
}

/// Where only a definition makes a name the program's own, the others are shared by all.
void NameFinder::scopeVariables() {
  if (defined_.empty() || isNamedLocal())
    return;
  uint32_t program = 0;
  for (Occurrence &one : all_) {
    while (program + 1 < untold_.size() && scopes_[program + 1].begin <= one.begin)
      ++program;
    if (one.kind == NameKind::Variable && defined_.contains({program, one.key}))
      one.scope = program;
  }
}

} // namespace

FoundNames findNames(const FileUnit &unit) { return NameFinder(unit).find(); }

} // namespace ncvet::lsp
