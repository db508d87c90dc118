// A variable that programs of several files share, with another name in all of them.
#include "lsp/features/writing/rename_shared.h"

#include "analyzer/program/block_reading.h"
#include "formats/readers/table_words.h"
#include "lsp/features/navigation/definition.h"
#include "lsp/features/writing/rename.h"
#include "lsp/features/writing/rename_limits.h"

#include "llvm/Support/Path.h"

#include <map>
#include <set>

namespace ncvet::lsp {

namespace {

/// Calls that are followed from one program to the next, to see whether a value is written first.
constexpr unsigned deepest = 16;

bool leads(const Occurrence &one) {
  return isShared(one) && (one.use == NameUse::Call || one.use == NameUse::Jump);
}

/// The programs of several files that call each other, and one variable of theirs.
class SharedVariable {
public:
  SharedVariable(Snapshot &snapshot, const Occurrence &one, llvm::ArrayRef<std::string> paths)
      : snapshot_(snapshot), one_(one), name_(snapshot.names().text(one).str()), paths_(paths) {}

  /// Finds the files that share it; why it keeps its name, when it does.
  std::string gather();
  SharedRename rename(llvm::StringRef name);

private:
  struct Call {
    uint32_t place;                       ///< in the text of the caller
    FileUnit *unit = nullptr;             ///< of the called program; null: it is not found
    const ProgramInfo *program = nullptr; ///< that is called
  };

  void readCalls(FileUnit &unit);
  void collect(FileUnit &start);
  std::string whyNotIn(FileUnit &unit);
  std::optional<NameUse> firstUse(FileUnit &unit, const ProgramInfo &program, unsigned depth);
  std::string whyNotFrom(FileUnit &unit, const ProgramInfo &program);
  bool onlyReturns(const FileUnit &unit, const ProgramInfo &program) const;
  bool isIt(const Occurrence &other) const {
    return other.kind == one_.kind && other.scope == wholeFile && other.key == one_.key;
  }
  bool staysTheSame(FileUnit &unit, llvm::ArrayRef<TextEdit> edits, uint64_t key) const;
  std::string editIn(FileUnit &unit, llvm::StringRef name, uint64_t key, SharedRename &result);
  uint64_t keyOf(llvm::StringRef name);

  std::string in(const FileUnit &unit, const std::string &why) const {
    return &unit == &snapshot_.unit()
               ? why
               : llvm::sys::path::filename(unit.source.display()).str() + ": " + why;
  }
  std::string lineIn(const FileUnit &unit, uint32_t offset) const {
    return in(unit, "line " + std::to_string(unit.source.position(offset).line));
  }
  std::string quoted() const { return "`" + name_ + "`"; }

  Snapshot &snapshot_;
  const Occurrence &one_;
  const std::string name_;
  const llvm::ArrayRef<std::string> paths_;
  std::map<FileUnit *, std::vector<Call>> calls_; ///< of all files, in the order of their texts
  std::map<const ProgramInfo *, std::optional<NameUse>> firstUses_;
  std::vector<FileUnit *> units_;   ///< all files, the document first
  std::vector<FileUnit *> sharing_; ///< those of them that share it, in the same order
};

void SharedVariable::readCalls(FileUnit &unit) {
  const auto [entry, isNew] = calls_.try_emplace(&unit);
  if (!isNew)
    return;
  units_.push_back(&unit);
  std::map<std::pair<NameKind, uint64_t>, Call> known;
  for (const Occurrence &other : snapshot_.names(unit).all()) {
    if (!leads(other) || other.scope == otherFile)
      continue;
    const auto [call, first] = known.try_emplace({other.kind, other.key});
    if (first)
      if (const auto target = targetOf(snapshot_, unit, other))
        call->second = {0, target->unit, target->program};
    entry->second.push_back({other.begin, call->second.unit, call->second.program});
  }
}

/// All files that lead to the first one, or that it leads to, and so on.
void SharedVariable::collect(FileUnit &start) {
  std::map<FileUnit *, std::set<FileUnit *>> beside;
  for (const auto &[unit, calls] : calls_)
    for (const Call &call : calls)
      if (call.unit && call.unit != unit) {
        beside[unit].insert(call.unit);
        beside[call.unit].insert(unit);
      }
  std::set<FileUnit *> found = {&start};
  std::vector<FileUnit *> left = {&start};
  while (!left.empty()) {
    FileUnit *const unit = left.back();
    left.pop_back();
    for (FileUnit *const other : beside[unit])
      if (found.insert(other).second)
        left.push_back(other);
  }
  llvm::copy_if(units_, std::back_inserter(sharing_),
                [&](FileUnit *unit) { return found.count(unit) > 0; });
}

/// Whether the program is a subprogram: only a caller lets it begin.
bool SharedVariable::onlyReturns(const FileUnit &unit, const ProgramInfo &program) const {
  bool returns = program.kind == ProgramKind::Subprogram;
  for (const Block &block : blocks(*unit.reader, program.begin, program.end))
    for (const Word &word : block.words) {
      const CodeIndex code = codeOf(*unit.dialect, word);
      const Action action = code == noCode ? Action::None : unit.dialect->codes[code].action;
      if (action == Action::ProgramEnd || action == Action::ProgramEndRewind)
        return false;
      returns |= action == Action::Return;
    }
  return returns;
}

/// What the program does first with the variable, in the order of the texts; nothing: it does not
/// name it.
std::optional<NameUse> SharedVariable::firstUse(FileUnit &unit, const ProgramInfo &program,
                                                unsigned depth) {
  if (const auto [known, isNew] = firstUses_.try_emplace(&program); !isNew)
    return known->second; // of a program that is being looked at: nothing so far
  const llvm::ArrayRef<Call> calls = calls_[&unit];
  const Call *next =
      llvm::partition_point(calls, [&](const Call &call) { return call.place < program.begin; });
  const auto inCalls = [&](uint32_t before) -> std::optional<NameUse> {
    for (; next != calls.end() && next->place < before; ++next)
      if (next->unit && next->program != &program && depth < deepest)
        if (const auto use = firstUse(*next->unit, *next->program, depth + 1))
          return use;
    return std::nullopt;
  };
  std::optional<NameUse> first;
  for (const Occurrence &other : snapshot_.names(unit).within(program.begin, program.end))
    if (isIt(other)) {
      first = inCalls(other.begin);
      if (!first)
        first = other.use;
      break;
    }
  if (!first)
    first = inCalls(program.end);
  return firstUses_[&program] = first;
}

/// A program that no other calls: where its variables come from.
std::string SharedVariable::whyNotFrom(FileUnit &unit, const ProgramInfo &program) {
  const auto calls = [&](const auto &caller) {
    return llvm::any_of(caller.second, [&](const Call &call) {
      return call.program == &program &&
             (caller.first != &unit || call.place < program.begin || call.place >= program.end);
    });
  };
  if (llvm::any_of(calls_, calls))
    return {};
  if (onlyReturns(unit, program))
    return in(unit, "a program that calls this one shares " + quoted());
  const auto use = firstUse(unit, program, 0);
  return !use || *use == NameUse::Write || *use == NameUse::Definition
             ? ""
             : in(unit, quoted() + " is read before it is written: its value comes from elsewhere");
}

/// Why the variable keeps its name, as far as one of the files tells it.
std::string SharedVariable::whyNotIn(FileUnit &unit) {
  const Names &names = snapshot_.names(unit);
  for (const Call &call : calls_[&unit])
    if (!call.unit)
      return lineIn(unit, call.place) + " calls a program that is not found, which shares " +
             quoted();
  if (const auto *const here =
          llvm::find_if(names.all(), [&](const Occurrence &other) { return isIt(other); });
      here != names.all().end())
    if (std::string why = whyNotRenamedIn(unit, names, *here); !why.empty())
      return in(unit, why);
  for (uint32_t i = 0; i < unit.index.programs().size(); ++i) {
    if (const uint32_t computed = names.untold(i).variable; computed != UntoldNames::nowhere)
      return lineIn(unit, computed) + " names a variable that only the run decides";
    if (std::string why = whyNotFrom(unit, unit.index.programs()[i]); !why.empty())
      return why;
  }
  return {};
}

std::string SharedVariable::gather() {
  FileUnit &own = snapshot_.unit();
  readCalls(own);
  for (const std::string &path : paths_)
    if (FileUnit *const unit = snapshot_.unitOf(path); unit && unit->dialect == own.dialect)
      readCalls(*unit);
  for (size_t i = 0; i < units_.size(); ++i) { // what they call may lie elsewhere
    const std::vector<Call> calls = calls_[units_[i]];
    for (const Call &call : calls)
      if (call.unit)
        readCalls(*call.unit);
  }
  collect(own);
  for (FileUnit *const unit : units_)
    for (uint32_t i = 0; i < unit->index.programs().size(); ++i)
      if (const uint32_t call = snapshot_.names(*unit).untold(i).call; call != UntoldNames::nowhere)
        return lineIn(*unit, call) + " calls a program that only the run decides";
  for (FileUnit *const unit : sharing_)
    if (std::string why = whyNotIn(*unit); !why.empty())
      return why;
  return {};
}

/// Whether the text after the edits has the same names in the same places, but for this one.
bool SharedVariable::staysTheSame(FileUnit &unit, llvm::ArrayRef<TextEdit> edits,
                                  uint64_t key) const {
  const std::string text = applyEdits(unit.source.text(), edits);
  const auto file =
      SourceFile::fromText(unit.source.id(), unit.source.display(), text, unit.source.path());
  FileUnit after(*file, unit.dialect, unit.machine);
  after.reader->setHidesProgram([&](llvm::StringRef name) { return unit.reader->isHidden(name); });
  const Names now(after);
  const llvm::ArrayRef<Occurrence> before = snapshot_.names(unit).all();
  if (now.all().size() != before.size() ||
      after.index.programs().size() != unit.index.programs().size())
    return false;
  for (size_t i = 0; i < before.size(); ++i) {
    const Occurrence &a = before[i], &b = now.all()[i];
    if (a.kind != b.kind || a.use != b.use || a.scope != b.scope ||
        b.key != (isIt(a) ? key : a.key))
      return false;
  }
  return true;
}

std::string SharedVariable::editIn(FileUnit &unit, llvm::StringRef name, uint64_t key,
                                   SharedRename &result) {
  const Names &names = snapshot_.names(unit);
  std::vector<TextEdit> edits;
  for (const Occurrence &other : names.all()) {
    if (other.kind == one_.kind && other.scope == wholeFile && other.key == key)
      return ("`" + name + "` is in use already: ").str() + lineIn(unit, other.begin);
    if (isIt(other) && (edits.empty() || edits.back().range.begin != other.begin))
      edits.push_back({names.range(other), spelledName(unit, other, name)});
  }
  if (!edits.empty() && !staysTheSame(unit, edits, key))
    return in(unit, ("`" + name + "` would be read as something else").str());
  llvm::append_range(result.edits, std::move(edits));
  return {};
}

/// The key that the variable has by another name; that of `one_`: it is no variable of all
/// programs.
uint64_t SharedVariable::keyOf(llvm::StringRef name) {
  FileUnit &own = snapshot_.unit();
  const TextEdit edit{snapshot_.names().range(one_), spelledName(own, one_, name)};
  const std::string text = applyEdits(own.source.text(), edit);
  const auto file =
      SourceFile::fromText(own.source.id(), own.source.display(), text, own.source.path());
  const FileUnit after(*file, own.dialect, own.machine);
  const Names names(after);
  const Occurrence *const other = names.at(one_.begin);
  return other && other->kind == one_.kind && other->scope == wholeFile ? other->key : one_.key;
}

SharedRename SharedVariable::rename(llvm::StringRef name) {
  SharedRename result;
  result.refused = whyNotSpelled(snapshot_, one_, name);
  if (!result.refused.empty())
    return result;
  const uint64_t key = keyOf(name);
  if (key == one_.key) {
    result.refused = ("`" + name + "` is no other variable that these programs share").str();
    return result;
  }
  for (FileUnit *const unit : sharing_)
    if (result.refused = editIn(*unit, name, key, result); !result.refused.empty()) {
      result.edits.clear();
      break;
    }
  return result;
}

} // namespace

bool isSharedVariable(Snapshot &snapshot, uint32_t offset) {
  const Occurrence *const one = snapshot.names().at(offset);
  return one && one->kind == NameKind::Variable && one->scope == wholeFile;
}

SharedRename renameShared(Snapshot &snapshot, uint32_t offset, llvm::StringRef name,
                          llvm::ArrayRef<std::string> paths) {
  if (!isSharedVariable(snapshot, offset))
    return {{}, "there is no variable here that programs share"};
  SharedVariable variable(snapshot, *snapshot.names().at(offset), paths);
  if (std::string why = variable.gather(); !why.empty())
    return {{}, std::move(why)};
  return variable.rename(name);
}

std::string whyNotShared(Snapshot &snapshot, uint32_t offset, llvm::ArrayRef<std::string> paths) {
  if (!isSharedVariable(snapshot, offset))
    return "there is no variable here that programs share";
  return SharedVariable(snapshot, *snapshot.names().at(offset), paths).gather();
}

} // namespace ncvet::lsp
