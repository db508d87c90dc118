// All places that use the name at a place of a document.
#include "lsp/features/navigation/references.h"

#include "lsp/features/navigation/definition.h"

#include "llvm/ADT/SmallPtrSet.h"

namespace ncvet::lsp {

namespace {

class Gatherer {
public:
  Gatherer(Snapshot &snapshot, bool definitions) : snapshot_(snapshot), definitions_(definitions) {}

  /// Places of `name`, a name of the document.
  void here(const Occurrence &name) { add(snapshot_.names(), name); }
  /// Places of the program `target` in a further file.
  void in(FileUnit &unit, const Occurrence &name, const NameTarget &target) {
    const Names &names = snapshot_.names(unit);
    const llvm::ArrayRef<uint32_t> same = names.same(name);
    if (same.empty() || &unit == &snapshot_.unit())
      return;
    // The same number may be another program's there.
    const auto found = targetOf(snapshot_, unit, names.all()[same.front()]);
    if (found && found->unit == target.unit && found->program == target.program)
      add(names, name);
  }
  bool hasAny() const { return !places_.empty(); }
  std::vector<SourceRange> take() { return std::exchange(places_, {}); }

private:
  void add(const Names &names, const Occurrence &name) {
    const Occurrence *const written = names.definition(name); // of a variable its first assignment
    for (const uint32_t i : names.same(name)) {
      const Occurrence &one = names.all()[i];
      if (definitions_ || (one.use != NameUse::Definition && &one != written))
        places_.push_back(names.range(one));
    }
  }

  Snapshot &snapshot_;
  const bool definitions_;
  std::vector<SourceRange> places_;
};

} // namespace

std::vector<SourceRange> references(Snapshot &snapshot, uint32_t offset, bool definitions,
                                    llvm::ArrayRef<std::string> paths, const GatherSteps &steps) {
  const Occurrence *const name = snapshot.names().at(offset);
  if (!name)
    return {};
  Gatherer gatherer(snapshot, definitions);
  gatherer.here(*name);
  if (!isShared(*name))
    return gatherer.take();
  const auto target = targetOf(snapshot, snapshot.unit(), *name);
  if (!target)
    return gatherer.take();
  llvm::SmallPtrSet<const FileUnit *, 8> seen;
  seen.insert(target->unit);
  gatherer.in(*target->unit, *name, *target);
  for (size_t i = 0; i < paths.size(); ++i) {
    if (FileUnit *const unit = snapshot.unitOf(paths[i]); unit && seen.insert(unit).second)
      gatherer.in(*unit, *name, *target);
    if (steps.looked)
      steps.looked(i + 1);
    if (steps.found && gatherer.hasAny())
      steps.found(gatherer.take());
  }
  return gatherer.take();
}

} // namespace ncvet::lsp
