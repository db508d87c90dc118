// A program with another name, in all files that name it.
#include "lsp/features/writing/rename_program.h"

#include "lsp/features/navigation/definition.h"
#include "lsp/features/writing/rename.h"
#include "lsp/features/writing/rename_limits.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

#include <map>

namespace ncvet::lsp {

namespace {

std::string inMarks(llvm::StringRef name) { return ("`" + name + "`").str(); }

/// A file's name without its ending, in the parts that a program's number has: `O0020`.
struct NumberedStem {
  llvm::StringRef mark;   ///< `O`, `%`, `%O`
  llvm::StringRef digits; ///< empty: the name has another form

  explicit NumberedStem(llvm::StringRef stem) {
    llvm::StringRef rest = stem;
    rest.consume_front("%");
    if (!rest.consume_front("O"))
      rest.consume_front("o");
    mark = stem.drop_back(rest.size());
    if (!rest.empty() && llvm::all_of(rest, llvm::isDigit))
      digits = rest;
  }
  std::optional<uint64_t> number() const {
    uint64_t value = 0;
    if (digits.empty() || digits.getAsInteger(10, value))
      return std::nullopt;
    return value;
  }
};

class ProgramRenamer {
public:
  ProgramRenamer(Snapshot &snapshot, llvm::StringRef name, llvm::ArrayRef<std::string> paths)
      : snapshot_(snapshot), name_(name), paths_(paths) {}

  /// The program that an occurrence of the document names.
  ProgramRename run(const Occurrence &one) {
    const auto target = targetOf(snapshot_, snapshot_.unit(), one);
    if (!target || target->name.file != target->unit->source.id())
      return refuse("program " + inMarks(snapshot_.names().text(one)) + " is not found");
    target_ = *target;
    old_ = snapshot_.names().text(one).str();
    byNumber_ = one.kind == NameKind::Program && one.key < firstNamedVariable;
    if (std::string why = whyNotSpelled(snapshot_, one, name_); !why.empty())
      return refuse(std::move(why));
    return gather();
  }

  /// The program that the document's file is named after.
  ProgramRename runOfFile() {
    FileUnit &unit = snapshot_.unit();
    const ProgramInfo &first = unit.index.programs().front();
    const llvm::StringRef stem = llvm::sys::path::stem(unit.source.path());
    const auto number = NumberedStem(stem).number();
    byNumber_ = number && first.number >= 0 && uint64_t(first.number) == *number;
    const bool byName = first.name.empty() ? first.number < 0 : stem.equals_insensitive(first.name);
    if (!byNumber_ && !byName)
      return {};
    old_ = byNumber_ ? std::to_string(*number) : stem.str();
    target_ = {&unit, &first, {unit.source.id(), first.headerBegin, first.headerEnd}};
    ProgramRename result = gather();
    result.from.clear(); // the client moves it
    result.to.clear();
    return result;
  }

private:
  ProgramRename refuse(std::string why) {
    result_ = {};
    result_.refused = std::move(why);
    return std::move(result_);
  }

  ProgramRename gather() {
    if (means(name_, byNumber_))
      return refuse("the program has that name already");
    if (isTaken())
      return refuse("there is a program " + inMarks(name_) + " already");
    std::vector<FileUnit *> units = {target_.unit};
    const auto add = [&](FileUnit *unit) {
      if (unit && !llvm::is_contained(units, unit))
        units.push_back(unit);
    };
    add(&snapshot_.unit());
    for (const std::string &path : paths_)
      add(snapshot_.unitOf(path));
    for (FileUnit *const unit : units)
      if (std::string why = editIn(*unit); !why.empty())
        return refuse(std::move(why));
    renameFile();
    return std::move(result_);
  }

  bool isTaken() {
    Project &project = snapshot_.project();
    int64_t number = 0;
    const Project::Found found = byNumber_ && !name_.getAsInteger(10, number)
                                     ? project.findProgram(*target_.unit, number)
                                     : project.findProgram(*target_.unit, name_);
    return found.second && found.second != target_.program;
  }

  bool isMeant(FileUnit &unit, const Occurrence &one) {
    if (!isShared(one) || one.scope == otherFile ||
        !means(snapshot_.names(unit).text(one), byNumber_ && one.kind == NameKind::Program))
      return false;
    const auto target = targetOf(snapshot_, unit, one);
    return target && target->unit == target_.unit && target->program == target_.program;
  }
  /// Whether a name is the program's own of before.
  bool means(llvm::StringRef text, bool isNumber) const {
    uint64_t a = 0, b = 0;
    if (isNumber)
      return !text.getAsInteger(10, a) && !llvm::StringRef(old_).getAsInteger(10, b) && a == b;
    return text.equals_insensitive(old_);
  }

  /// Adds the edits of one file; why not, when there are none to be had.
  std::string editIn(FileUnit &unit) {
    const Names &names = snapshot_.names(unit);
    std::vector<TextEdit> edits;
    for (const Occurrence &one : names.all()) {
      if (!isMeant(unit, one) || (!edits.empty() && edits.back().range.begin == one.begin))
        continue;
      edits.push_back({names.range(one), spelledName(unit, one, name_)});
    }
    for (uint32_t i = 0; i < unit.index.programs().size(); ++i)
      if (const uint32_t call = names.untold(i).call; call != UntoldNames::nowhere)
        return unit.source.display() + ", line " +
               std::to_string(unit.source.lines().lineOf(call)) +
               " calls a program that only the run decides";
    if (!edits.empty() && !staysTheSame(unit, edits))
      return inMarks(name_) + " would be read as something else in " + unit.source.display();
    llvm::append_range(result_.edits, std::move(edits));
    return {};
  }

  /// Whether the text after the edits has the same names in the same places, but for this one.
  bool staysTheSame(const FileUnit &unit, llvm::ArrayRef<TextEdit> edits) {
    const std::string text = applyEdits(unit.source.text(), edits);
    const auto file =
        SourceFile::fromText(unit.source.id(), unit.source.display(), text, unit.source.path());
    FileUnit after(*file, unit.dialect, unit.machine);
    after.reader->setHidesProgram([&](llvm::StringRef name) {
      return name.equals_insensitive(name_) || unit.reader->isHidden(name);
    });
    const Names now(after);
    const llvm::ArrayRef<Occurrence> before = snapshot_.names(unit).all();
    if (now.all().size() != before.size() ||
        after.index.programs().size() != unit.index.programs().size())
      return false;
    std::optional<uint64_t> fresh;
    for (size_t i = 0; i < before.size(); ++i) {
      const Occurrence &a = before[i], &b = now.all()[i];
      if (a.kind != b.kind || a.use != b.use)
        return false;
      const bool isRenamed =
          llvm::any_of(edits, [&](const TextEdit &edit) { return edit.range.begin == a.begin; });
      if (!isRenamed && a.key != b.key)
        return false;
      if (isRenamed && fresh.value_or(b.key) != b.key)
        return false;
      if (isRenamed)
        fresh = b.key;
    }
    return true;
  }

  /// The file of the program, when it has its name.
  void renameFile() {
    const std::string &path = target_.unit->source.path();
    const llvm::StringRef stem = llvm::sys::path::stem(path);
    std::string fresh;
    const NumberedStem numbered(stem);
    uint64_t number = 0;
    if (byNumber_) {
      if (!numbered.number() || llvm::StringRef(old_).getAsInteger(10, number) ||
          *numbered.number() != number)
        return;
      fresh = name_.str();
      if (fresh.size() < numbered.digits.size())
        fresh.insert(0, numbered.digits.size() - fresh.size(), '0');
      fresh = numbered.mark.str() + fresh;
    } else {
      if (!stem.equals_insensitive(old_))
        return;
      fresh = stem == stem.upper()   ? name_.upper()
              : stem == stem.lower() ? name_.lower()
                                     : name_.str();
    }
    llvm::SmallString<128> to(llvm::sys::path::parent_path(path));
    llvm::sys::path::append(to, fresh + llvm::sys::path::extension(path));
    if (to.str() == path)
      return;
    if (llvm::sys::fs::exists(to)) {
      refuse("there is a file " + llvm::sys::path::filename(to).str() + " already");
      return;
    }
    result_.from = path;
    result_.to = to.str().str();
  }

  Snapshot &snapshot_;
  const llvm::StringRef name_;
  const llvm::ArrayRef<std::string> paths_;
  NameTarget target_;
  std::string old_;       ///< its name as it was, a number without its address
  bool byNumber_ = false; ///< programs have numbers
  ProgramRename result_;
};

} // namespace

ProgramRename renameProgram(Snapshot &snapshot, uint32_t offset, llvm::StringRef name,
                            llvm::ArrayRef<std::string> paths) {
  const Occurrence *const one = snapshot.names().at(offset);
  if (!one || !isShared(*one))
    return {{}, "", "", "there is no name of a program here"};
  return ProgramRenamer(snapshot, name, paths).run(*one);
}

ProgramRename renameWithFile(Snapshot &snapshot, llvm::StringRef to,
                             llvm::ArrayRef<std::string> paths) {
  const llvm::StringRef path = snapshot.source().path();
  if (llvm::sys::path::extension(path) != llvm::sys::path::extension(to) ||
      llvm::sys::path::parent_path(path) != llvm::sys::path::parent_path(to) ||
      snapshot.unit().index.programs().empty())
    return {};
  const llvm::StringRef stem = llvm::sys::path::stem(to);
  const NumberedStem numbered(stem);
  const bool hadNumber = NumberedStem(llvm::sys::path::stem(path)).number().has_value();
  if (hadNumber && !numbered.number())
    return {};
  const std::string name = hadNumber ? std::to_string(*numbered.number()) : stem.str();
  if (stem.equals_insensitive(llvm::sys::path::stem(path)))
    return {};
  return ProgramRenamer(snapshot, name, paths).runOfFile();
}

} // namespace ncvet::lsp
