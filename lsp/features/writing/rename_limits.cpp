// What may not be renamed, and why.
#include "lsp/features/writing/rename_limits.h"

#include "analyzer/program/block_reading.h"
#include "formats/readers/table_words.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/Path.h"

#include <algorithm>
#include <map>
#include <set>

namespace ncvet::lsp {

namespace {

std::string quoted(llvm::StringRef name) { return ("`" + name + "`").str(); }

/// Asks all questions about one name.
class RenameLimits {
public:
  /// `snapshot`: of the document, when `unit` is that.
  RenameLimits(FileUnit &unit, const Names &names, const Occurrence &one,
               Snapshot *snapshot = nullptr)
      : snapshot_(snapshot), unit_(unit), names_(names), dialect_(*unit.dialect),
        text_(unit.source.text()), one_(one), name_(names_.text(one)) {}

  std::string why();
  /// As far as it is a variable that other files share.
  std::string whyInFile();

private:
  std::string target();
  std::string variable();
  std::string controlVariable() const;
  std::string numberedVariable();
  std::string localVariable();
  std::string sharedVariable();
  std::string program();
  std::string subprogram();
  std::string unseen();

  bool isHere() const {
    return llvm::any_of(names_.same(one_),
                        [&](uint32_t i) { return names_.all()[i].use == NameUse::Definition; });
  }
  std::string line(uint32_t offset) const {
    return "line " + std::to_string(unit_.source.position(offset).line);
  }
  bool isFirstWritten() const {
    const llvm::ArrayRef<uint32_t> same = names_.same(one_);
    return !same.empty() && names_.all()[same.front()].use == NameUse::Write;
  }
  uint32_t programOf() const {
    return one_.scope < names_.scopes().size() ? names_.scopes()[one_.scope].program
                                               : names_.programAt(one_.begin);
  }
  /// First place of a block of the program with a code of this action.
  std::optional<uint32_t> find(uint32_t program, Action action) const;
  bool readsUnwritten(uint32_t program) const;
  bool isCovered(uint32_t begin) const;
  bool isRemark(uint32_t offset);
  bool namesFile() const {
    const llvm::StringRef stem = llvm::sys::path::stem(unit_.source.path());
    llvm::StringRef digits = stem;
    digits.consume_front("%");
    if (!digits.consume_front("O"))
      digits.consume_front("o");
    uint64_t number = 0;
    return stem.equals_insensitive(name_) ||
           (one_.kind == NameKind::Program && one_.key < firstNamedVariable &&
            !digits.getAsInteger(10, number) && number == one_.key);
  }

  Snapshot *const snapshot_;
  FileUnit &unit_;
  const Names &names_;
  const Dialect &dialect_;
  const llvm::StringRef text_;
  const Occurrence &one_;
  const llvm::StringRef name_;
  Block block_;
};

std::string RenameLimits::why() {
  switch (one_.kind) {
  case NameKind::Tool:
    return "a tool has its number from the machine, not from the program";
  case NameKind::Element:
    return "elements of a contour are not renamed";
  case NameKind::Macro:
    return "a name that is replaced by words is not renamed";
  case NameKind::Block:
  case NameKind::Label:
    return target();
  case NameKind::Variable:
    return variable();
  case NameKind::Program:
    return program();
  case NameKind::Subprogram:
    return subprogram();
  case NameKind::Bracket:
    return {};
  }
  return {};
}

/// A block number or a label.
std::string RenameLimits::target() {
  if (one_.scope == otherFile)
    return quoted(name_) + " is a block of a program in another file";
  if (!isHere())
    return "nothing in this program defines " + quoted(name_);
  const uint32_t computed = names_.untold(programOf()).target;
  if (computed != UntoldNames::nowhere)
    return line(computed) + " jumps to a block that only the run decides";
  if (one_.kind == NameKind::Block)
    return {};
  if (unit_.reader->labelKey(name_) == dialect_.lexical.endLabel)
    return quoted(name_) + " has a meaning of its own for the control";
  return unseen();
}

std::string RenameLimits::program() {
  if (!isHere())
    return "program " + quoted(name_) + " is not defined in this file";
  if (namesFile())
    return "the file is named after the program: other files find it by that name";
  for (uint32_t i = 0; i < unit_.index.programs().size(); ++i)
    if (names_.untold(i).call != UntoldNames::nowhere)
      return line(names_.untold(i).call) + " calls a program that only the run decides";
  return {};
}

std::string RenameLimits::subprogram() {
  return isHere() ? program() : quoted(name_) + " is not defined in this file";
}

std::string RenameLimits::variable() {
  if (std::string why = controlVariable(); !why.empty())
    return why;
  const bool numbered = one_.key < firstSharedVariable ||
                        (name_.size() > 1 && llvm::all_of(name_.drop_front(), llvm::isDigit));
  if (numbered) {
    if (std::string why = numberedVariable(); !why.empty())
      return why;
  } else if (one_.scope == wholeFile && one_.key >= firstNamedVariable) {
    return "nothing in this program defines " + quoted(name_);
  }
  if (one_.scope == wholeFile) {
    if (std::string why = sharedVariable(); !why.empty())
      return why;
  } else if (numbered) {
    if (std::string why = localVariable(); !why.empty())
      return why;
  }
  return unseen();
}

std::string RenameLimits::whyInFile() {
  if (std::string why = controlVariable(); !why.empty())
    return why;
  if (std::string why = numberedVariable(); !why.empty())
    return why;
  for (uint32_t i = 0; i < unit_.index.programs().size(); ++i)
    if (names_.untold(i).call != UntoldNames::nowhere)
      return line(names_.untold(i).call) + " calls a program that only the run decides";
  return unseen();
}

/// Variables that the control itself reads or writes.
std::string RenameLimits::controlVariable() const {
  const std::string why = quoted(name_) + " is a variable of the control";
  const auto begins = [&](const std::vector<std::string> &list) {
    return llvm::any_of(list, [&](const std::string &one) {
      return name_.equals_insensitive(llvm::StringRef(one).ltrim('#')) ||
             (one.front() == '$' && name_.startswith_insensitive(one));
    });
  };
  if (!dialect_.lexical.macro || name_.startswith("$") || begins(dialect_.readOnly) ||
      begins(dialect_.machineData) || llvm::is_contained(dialect_.variableNames, name_.upper()))
    return why;
  if (one_.key >= firstSharedVariable)
    return {};
  const auto number = int64_t(one_.key);
  const ZeroVariables &zeros = dialect_.zeros;
  const int64_t firstOfControl =
      zeros.systems ? std::min<int64_t>({zeros.systems, zeros.preset, zeros.presetOn,
                                         zeros.length ? zeros.length : zeros.systems})
                    : int64_t(dialect_.variableRanges.lastCommon) + 1;
  return number == 0 || number >= firstOfControl ? why : std::string();
}

/// Variables with numbers may be reached by a computed one.
std::string RenameLimits::numberedVariable() {
  for (uint32_t i = 0; i < unit_.index.programs().size(); ++i)
    if ((one_.scope == wholeFile || i == programOf()) &&
        names_.untold(i).variable != UntoldNames::nowhere)
      return line(names_.untold(i).variable) + " names a variable that only the run decides";
  if (one_.key < firstSharedVariable)
    return {};
  const uint64_t array = variableKey(name_.take_front()); // `R[5]`
  for (const Occurrence &other : names_.all())
    if (other.kind == NameKind::Variable && other.key == array)
      return line(other.begin) + " names a variable that only the run decides";
  return {};
}

std::optional<uint32_t> RenameLimits::find(uint32_t program, Action action) const {
  const ProgramInfo &where = unit_.index.programs()[program];
  for (const Block &block : blocks(*unit_.reader, where.begin, where.end))
    for (const Word &word : block.words)
      if (const CodeIndex code = codeOf(dialect_, word);
          code != noCode && dialect_.codes[code].action == action)
        return block.begin;
  return std::nullopt;
}

/// Whether a variable of the program's own is read that no line above writes: it is a macro whose
/// variables come from its call.
bool RenameLimits::readsUnwritten(uint32_t program) const {
  std::map<uint64_t, bool> written;
  for (const Occurrence &other : names_.all())
    if (other.kind == NameKind::Variable && other.scope == program)
      if (!written.try_emplace(other.key, other.use == NameUse::Write).first->second)
        return true;
  return false;
}

/// `#1` to `#33`: a plain call shares them, a macro call gives them values.
std::string RenameLimits::localVariable() {
  const uint32_t program = programOf();
  if (!isFirstWritten())
    return quoted(name_) + " is read before it is written: its value comes from the call";
  for (const Occurrence &other : names_.all())
    if (other.kind == NameKind::Subprogram && other.use == NameUse::Call)
      return line(other.begin) + " calls a subprogram that finds the value of " + quoted(name_);
  if (const auto call = find(program, Action::CallProgram))
    return line(*call) + " calls a program that shares " + quoted(name_);
  if (find(program, Action::Return) && !readsUnwritten(program))
    return "a program that calls this one may share " + quoted(name_);
  return {};
}

/// Variables that all programs share.
std::string RenameLimits::sharedVariable() {
  if (!isFirstWritten())
    return quoted(name_) + " is read before it is written: its value comes from elsewhere";
  std::set<std::pair<NameKind, uint64_t>> seen;
  for (const Occurrence &other : names_.all()) {
    const bool leaves = (other.kind == NameKind::Program || other.kind == NameKind::Subprogram) &&
                        (other.use == NameUse::Call || other.use == NameUse::Jump);
    if (!leaves || !seen.insert({other.kind, other.key}).second)
      continue;
    const bool here = llvm::any_of(
        names_.same(other), [&](uint32_t i) { return names_.all()[i].use == NameUse::Definition; });
    if (!here)
      return line(other.begin) + " calls a program of another file, which shares " + quoted(name_);
  }
  for (uint32_t i = 0; i < unit_.index.programs().size(); ++i)
    if (names_.untold(i).call != UntoldNames::nowhere)
      return line(names_.untold(i).call) + " calls a program, which shares " + quoted(name_);
  if (find(0, Action::Return) && !find(0, Action::ProgramEnd) && !find(0, Action::ProgramEndRewind))
    return "a program that calls this one shares " + quoted(name_);
  return {};
}

/// Whether an occurrence of the name begins at `begin`.
bool RenameLimits::isCovered(uint32_t begin) const {
  for (const Occurrence &other : names_.within(begin, begin + 1))
    if (other.kind == one_.kind && other.key == one_.key)
      return true;
  return false;
}

/// Whether a place lies in a comment or between quotes.
bool RenameLimits::isRemark(uint32_t offset) {
  constexpr uint32_t longest = 1 << 16; // bytes; after it nobody knows
  if (snapshot_)
    snapshot_->readAt(offset, block_);
  else if (dialect_.lexical.blocksSpanLines) // where the block begins is not looked for
    return false;
  else
    readBlockAt(unit_.source, *unit_.reader, offset, block_);
  if (offset - block_.begin > longest)
    return false;
  // There some comments show the values of variables.
  if (dialect_.lexical.arithmetic != Arithmetic::Ngc)
    for (const Comment &comment : block_.comments)
      if (comment.begin <= offset && offset < comment.end)
        return true;
  return text_.slice(block_.begin, offset).count('"') % 2 == 1;
}

/// A place that spells the name where what it means there is not known.
std::string RenameLimits::unseen() {
  const Scope whole{0, uint32_t(text_.size()), 0};
  const Scope &scope = one_.scope < names_.scopes().size() ? names_.scopes()[one_.scope] : whole;
  const bool marked = one_.kind == NameKind::Variable && one_.begin > 0 &&
                      llvm::StringRef("#<[ ").contains(text_[one_.begin - 1]);
  const auto isPart = [](char c) { return llvm::isAlnum(c) || c == '_'; };
  constexpr unsigned mostRemarks = 1000; // each of them is read
  unsigned remarks = 0;
  for (size_t at = text_.find_insensitive(name_, scope.begin);
       at != llvm::StringRef::npos && at < scope.end && !name_.empty();
       at = text_.find_insensitive(name_, at + 1)) {
    const size_t end = at + name_.size();
    if ((at > 0 && isPart(text_[at - 1])) || (end < text_.size() && isPart(text_[end])) ||
        isCovered(uint32_t(at)))
      continue;
    if (marked && (at == 0 || !llvm::StringRef("#<[").contains(text_[at - 1])))
      continue;
    if (++remarks > mostRemarks || !isRemark(uint32_t(at)))
      return line(uint32_t(at)) + " names " + quoted(name_) + " in a form that is not read closely";
  }
  return {};
}

/// The name of something that the control knows itself.
bool isOfControl(const Dialect &dialect, llvm::StringRef name) {
  return dialect.keyword(name) != noCode ||
         llvm::any_of(dialect.addressNames,
                      [&](const std::string &one) { return name.equals_insensitive(one); }) ||
         llvm::is_contained(dialect.variableNames, name.upper());
}

/// Whether the name alone in a block is a call, as every name is that means nothing else.
bool readsAsName(const Dialect &dialect, llvm::StringRef name) {
  Block block;
  makeReader(dialect, name)->read(0, block);
  return block.items.size() == 1 && block.items[0].kind == ItemKind::Call && block.words.empty();
}

std::string whyNotNumber(const Dialect &dialect, const Occurrence &one, llvm::StringRef name) {
  uint64_t number = 0;
  if (!llvm::all_of(name, llvm::isDigit) || name.getAsInteger(10, number))
    return quoted(name) + " is no number";
  size_t most = 8;
  if (one.kind == NameKind::Program && dialect.limits.programDigitsMax)
    most = dialect.limits.programDigitsMax;
  if (name.size() > most)
    return quoted(name) + " has more than " + std::to_string(most) + " digits";
  if (one.kind == NameKind::Block && double(number) > dialect.addresses[letterAddress('N')].most)
    return quoted(name) + " is larger than block numbers of this control are";
  if (one.kind == NameKind::Program && llvm::is_contained(dialect.limits.reservedPrograms, number))
    return quoted(name) + " is a program of the control";
  return {};
}

} // namespace

std::string whyNotRenamed(Snapshot &snapshot, const Occurrence &one) {
  return RenameLimits(snapshot.unit(), snapshot.names(), one, &snapshot).why();
}

std::string whyNotRenamedIn(FileUnit &unit, const Names &names, const Occurrence &one) {
  return RenameLimits(unit, names, one).whyInFile();
}

std::string whyNotSpelled(Snapshot &snapshot, const Occurrence &one, llvm::StringRef name) {
  const Dialect &dialect = snapshot.dialect();
  const llvm::StringRef old = snapshot.names().text(one);
  if (name.empty())
    return "a name has at least one character";
  if (llvm::any_of(name, [](char c) { return c <= ' ' || c == 0x7F; }))
    return "a name has no blanks";
  const bool byNumber = one.kind == NameKind::Block ||
                        (one.kind == NameKind::Program && one.key < firstNamedVariable) ||
                        (one.kind == NameKind::Variable && one.key < firstSharedVariable);
  if (byNumber)
    return whyNotNumber(dialect, one, name);
  const size_t labelLength = dialect.limits.labelLength;
  if (one.kind == NameKind::Label && labelLength && name.size() > labelLength)
    return "of a label only " + std::to_string(labelLength) + " characters count";
  if (isOfControl(dialect, name))
    return quoted(name) + " has a meaning of its own for the control";
  const bool numbered = old.size() > 1 && llvm::all_of(old.drop_front(), llvm::isDigit);
  if (one.kind == NameKind::Variable && numbered &&
      (!name.take_front().equals_insensitive(old.take_front()) || name.size() < 2 ||
       !llvm::all_of(name.drop_front(), llvm::isDigit)))
    return quoted(name) + " is not spelled as `" + old.take_front().str() + "` and a number";
  const size_t nameLength = dialect.limits.nameLength;
  if (!nameLength || (one.kind == NameKind::Variable && numbered))
    return {};
  const auto isLetter = [](char c) { return llvm::isAlpha(c) || c == '_'; };
  if (name.size() < 2 || !isLetter(name[0]) || !isLetter(name[1]) ||
      !llvm::all_of(name, [](char c) { return llvm::isAlnum(c) || c == '_'; }))
    return quoted(name) + " is no name: two letters, then letters and digits";
  if (!readsAsName(dialect, name))
    return quoted(name) + " has a meaning of its own for the control";
  if (one.kind == NameKind::Program && name.size() > nameLength)
    return quoted(name) + " has more than " + std::to_string(nameLength) + " characters";
  return {};
}

} // namespace ncvet::lsp
