// Gives the name at a place of a document another spelling everywhere, or says why not.
#include "lsp/features/writing/rename.h"

#include "lsp/features/writing/rename_limits.h"

#include "llvm/ADT/StringExtras.h"

#include <algorithm>

namespace ncvet::lsp {

namespace {

/// Edits of one name, and what the control makes of the text after them.
class Renaming {
public:
  Renaming(Snapshot &snapshot, const Occurrence &one, llvm::StringRef name)
      : snapshot_(snapshot), names_(snapshot.names()), one_(one), name_(name) {}

  RenameEdits run();

private:
  void edit();
  std::string whyNotSame();
  std::string compare(const Names &after) const;
  bool readsAlike(const FileUnit &after);
  bool isRenamed(const Occurrence &one) const {
    return one.kind == one_.kind && one.scope == one_.scope && one.key == one_.key;
  }
  std::string lineOf(uint32_t offset) const {
    return "line " + std::to_string(snapshot_.source().position(offset).line);
  }
  std::string otherName() const { return ("`" + name_ + "`").str(); }

  Snapshot &snapshot_;
  const Names &names_;
  const Occurrence &one_;
  const llvm::StringRef name_;
  std::vector<TextEdit> edits_;
};

void Renaming::edit() {
  for (const uint32_t i : names_.same(one_)) {
    const Occurrence &place = names_.all()[i];
    if (!edits_.empty() && edits_.back().range.begin == place.begin)
      continue;
    edits_.push_back({names_.range(place), spelledName(snapshot_.unit(), place, name_)});
  }
}

/// Whether the text means something else than before, all names but this one being the same.
std::string Renaming::compare(const Names &after) const {
  const std::string other = otherName() + " would be read as something else";
  const llvm::ArrayRef<Occurrence> old = names_.all(), now = after.all();
  if (old.size() != now.size())
    return other;
  const auto *const first = llvm::find_if(old, [&](const Occurrence &o) { return isRenamed(o); });
  const uint64_t key = now[size_t(first - old.begin())].key;
  for (size_t i = 0; i < old.size(); ++i) {
    const Occurrence &a = old[i], &b = now[i];
    if (a.kind != b.kind || a.use != b.use)
      return other;
    if (isRenamed(a)) {
      if (b.scope != a.scope)
        return otherName() + " would belong to other programs than before";
      if (b.key != key)
        return other;
      continue;
    }
    if (b.key != a.key)
      return lineOf(a.begin) + " means a block of another program as well";
    // Labels of brackets and of subprograms share their spellings.
    const bool brackets = a.kind == NameKind::Subprogram && one_.kind == NameKind::Bracket;
    const bool subprograms = a.kind == NameKind::Bracket && one_.kind == NameKind::Subprogram;
    if (b.key == key && ((a.kind == one_.kind && a.scope == one_.scope) || brackets || subprograms))
      return otherName() + " is in use already: " + lineOf(a.begin);
    if (b.scope != a.scope)
      return other;
  }
  return {};
}

/// Whether each block with an edit still holds the same words and items, and no new mistake.
bool Renaming::readsAlike(const FileUnit &after) {
  Block before, now;
  int64_t shift = 0; // of what follows the edits so far
  const auto isSame = [&] {
    return before.words.size() == now.words.size() && before.items.size() == now.items.size() &&
           before.issues.size() == now.issues.size() && before.hasLabel() == now.hasLabel() &&
           (before.number >= 0) == (now.number >= 0) && before.kind == now.kind;
  };
  for (const TextEdit &edit : edits_) {
    if (before.next <= edit.range.begin) { // the first one of its block
      snapshot_.readAt(edit.range.begin, before);
      after.reader->read(uint32_t(int64_t(before.begin) + shift), now);
      if (!isSame())
        return false;
    }
    shift += int64_t(edit.text.size()) - int64_t(edit.range.end - edit.range.begin);
  }
  return true;
}

/// Reads the new text, and tells where it means something else.
std::string Renaming::whyNotSame() {
  const SourceFile &source = snapshot_.source();
  const std::string text = applyEdits(snapshot_.text(), edits_);
  const auto file = SourceFile::fromText(source.id(), source.display(), text, source.path());
  const FileUnit &unit = snapshot_.unit();
  FileUnit after(*file, unit.dialect, unit.machine);
  if (!unit.dialect->hiddenPrograms.empty())
    after.reader->setHidesProgram([this](llvm::StringRef name) {
      return snapshot_.project().hidesProgram(snapshot_.unit(), name);
    });
  if (after.index.programs().size() != unit.index.programs().size() || !readsAlike(after))
    return otherName() + " would be read as something else";
  return compare(Names(after));
}

RenameEdits Renaming::run() {
  RenameEdits result;
  result.refused = whyNotRenamed(snapshot_, one_);
  if (result.refused.empty())
    result.refused = whyNotSpelled(snapshot_, one_, name_);
  if (!result.refused.empty())
    return result;
  edit();
  result.refused = whyNotSame();
  if (result.refused.empty())
    result.edits = std::move(edits_);
  return result;
}

constexpr llvm::StringLiteral noName("there is no name here");

} // namespace

std::string spelledName(const FileUnit &unit, const Occurrence &place, llvm::StringRef wanted) {
  const llvm::StringRef text = unit.source.text();
  std::string name = wanted.str();
  if (place.kind == NameKind::Program && place.key < firstNamedVariable) {
    // A header's number has as many digits as the control wants, and leading zeros where it had
    // some; one after a count has as many as before.
    const bool packed =
        place.use == NameUse::Call && place.begin > 0 && llvm::isDigit(text[place.begin - 1]);
    size_t digits = packed ? place.end - place.begin : 0;
    if (place.use == NameUse::Definition)
      digits = std::max<size_t>(unit.dialect->limits.programDigitsMin,
                                text[place.begin] == '0' ? place.end - place.begin : 0);
    if (name.size() < digits)
      name.insert(0, digits - name.size(), '0');
  }
  // `o100` becomes `o<name>`.
  const bool bracket = place.kind == NameKind::Subprogram || place.kind == NameKind::Bracket;
  if (bracket && !llvm::all_of(wanted, llvm::isDigit) && place.begin > 0 &&
      text[place.begin - 1] != '<')
    name = "<" + name + ">";
  return name;
}

RenameSpot prepareRename(Snapshot &snapshot, uint32_t offset) {
  const Names &names = snapshot.names();
  const Occurrence *const one = names.at(offset);
  if (!one)
    return {{snapshot.source().id(), offset, offset}, {}, noName.str()};
  return {names.range(*one), names.text(*one).str(), whyNotRenamed(snapshot, *one)};
}

RenameEdits rename(Snapshot &snapshot, uint32_t offset, llvm::StringRef name) {
  const Occurrence *const one = snapshot.names().at(offset);
  if (!one)
    return {{}, noName.str()};
  return Renaming(snapshot, *one, name).run();
}

} // namespace ncvet::lsp
