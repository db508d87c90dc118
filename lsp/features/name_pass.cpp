// Finds the names of a file: the pass over its blocks, their headers, numbers and words.
#include "lsp/features/name_pass.h"

#include "analyzer/program/program_names.h"
#include "formats/readers/table_words.h"

#include "llvm/ADT/SetVector.h"

#include <tuple>

namespace ncvet::lsp {

FoundNames NamePass::find() {
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
void NamePass::finishBlock(size_t first) {
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

void NamePass::block() {
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

void NamePass::header() {
  if (block_.nameEnd > block_.nameBegin) {
    addProgram(NameUse::Definition, block_.nameBegin, block_.nameEnd);
  } else if (block_.program >= 0) {
    const uint32_t begin = firstDigit(block_.headerBegin, block_.headerEnd);
    add(NameKind::Program, NameUse::Definition, uint64_t(block_.program), begin, endOfDigits(begin),
        wholeFile);
  }
}

void NamePass::numberAndLabel() {
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

void NamePass::addProgram(NameUse use, uint32_t begin, uint32_t end) {
  const llvm::StringRef name = bareProgramName(text_.slice(begin, end), dialect_);
  begin = uint32_t(name.begin() - text_.begin());
  end = begin + uint32_t(name.size());
  const uint64_t key = programKey(name);
  if (use != NameUse::Definition && macros_.contains({program_, key}))
    add(NameKind::Macro, NameUse::Read, key, begin, end, program_);
  else
    add(NameKind::Program, use, key, begin, end, wholeFile);
}

void NamePass::words() {
  if (block_.has(letterAddress('T')))
    for (const Word &word : block_.words)
      if (word.address == letterAddress('T'))
        tool(word);
  if (block_.hasAny(dialect_.elementWords))
    elements();
  references_.words(block_, text_, [this](const Reference &one) { reference(one); });
}

static NameUse useOf(ReferenceKind kind) {
  switch (kind) {
  case ReferenceKind::Call:
    return NameUse::Call;
  case ReferenceKind::Jump:
    return NameUse::Jump;
  case ReferenceKind::Return:
    return NameUse::Return;
  case ReferenceKind::First:
    return NameUse::First;
  case ReferenceKind::Last:
    return NameUse::Last;
  }
  return NameUse::Read;
}

void NamePass::reference(const Reference &reference) {
  const NameUse use = useOf(reference.kind);
  const auto begin = uint32_t(reference.text.begin() - text_.begin());
  const uint32_t end = begin + uint32_t(reference.text.size());
  const uint32_t scope = reference.inCalled ? called_ : program_;
  switch (reference.to) {
  case ReferredKind::Program:
    called_ = programOf(uint64_t(reference.number));
    add(NameKind::Program, use, uint64_t(reference.number), begin, end, wholeFile);
    return;
  case ReferredKind::NamedProgram:
    called_ = programOf(programKey(bareProgramName(reference.text, dialect_)));
    return addProgram(use, begin, end);
  case ReferredKind::Subprogram:
    add(NameKind::Subprogram, use, labelKeyOf(*unit_.reader, reference.text), begin, end,
        wholeFile);
    return;
  case ReferredKind::Label:
    add(NameKind::Label, use, labelKeyOf(*unit_.reader, reference.text), begin, end, scope).search =
        reference.search;
    return;
  case ReferredKind::Block:
    if (use == NameUse::Call)
      callsLocally_[program_] = true;
    if (use == NameUse::Return)
      returns_.push_back({all_.size(), program_});
    add(NameKind::Block, use, uint64_t(reference.number), begin, end, scope).search =
        reference.search;
    return;
  case ReferredKind::UntoldProgram:
    return untold(&UntoldNames::call, begin);
  case ReferredKind::UntoldBlock:
    callsLocally_[program_] = callsLocally_[program_] || use == NameUse::Call;
    if (use == NameUse::Return)
      untoldReturn_ = std::min(untoldReturn_, begin);
    return untold(&UntoldNames::target, begin);
  }
}

/// Of a lathe's T word the last two digits are an offset.
void NamePass::tool(const Word &word) {
  if (!word.isNumber() || !word.isWhole() || word.mantissa < 0)
    return;
  const bool pair = dialect_.isLathe() && (word.mantissa >= 100 || word.has(wordLeadingZero));
  const uint32_t end = block_.endOf(word);
  add(NameKind::Tool, NameUse::Read, uint64_t(pair ? word.mantissa / 100 : word.mantissa),
      firstDigit(word.offset, end), end, wholeFile);
}

/// `L1=…` defines an element of a contour; other words with its name use it.
void NamePass::elements() {
  bool defines = llvm::any_of(block_.words, [&](const Word &word) {
    const CodeIndex code = codeOf(dialect_, word);
    return code != noCode && dialect_.codes[code].action == Action::DefineElement;
  });
  for (const Word &word : block_.words) {
    if (!(dialect_.elementWords & maskOf(word.address)) || !word.isNumber() || word.mantissa < 0)
      continue;
    constexpr unsigned bitsOfNumber = 48;
    add(NameKind::Element, defines ? NameUse::Definition : NameUse::Read,
        uint64_t(word.address) << bitsOfNumber | uint64_t(word.mantissa), word.offset,
        block_.endOf(word), program_);
    defines = false;
  }
}

/// `M99 P10` goes on at a block of the caller: of every program of the file that calls this one.
void NamePass::resolveReturns() {
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
void NamePass::scopeVariables() {
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

} // namespace ncvet::lsp
