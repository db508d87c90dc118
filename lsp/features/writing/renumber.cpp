// New numbers for the blocks of a text: every place that names a block gets the number of the block
// that the control finds from there.
#include "lsp/features/writing/renumber.h"

#include "lsp/features/names.h"

#include "llvm/ADT/DenseMap.h"
#include "llvm/ADT/DenseSet.h"
#include "llvm/ADT/StringExtras.h"

namespace ncvet::lsp {

namespace {

/// Digits of `number`, with leading zeros up to the width of an old number that had some.
std::string digits(int64_t number, llvm::StringRef old) {
  std::string text = std::to_string(number);
  if (old.startswith("0") && text.size() < old.size())
    text.insert(0, old.size() - text.size(), '0');
  return text;
}

class Renumberer {
public:
  Renumberer(Snapshot &snapshot, const NumberOptions &options)
      : snapshot_(snapshot), options_(options), names_(snapshot.unit()) {}

  Renumbering run() {
    if (options_.first <= 0 || options_.step <= 0)
      return refuse("numbers begin above 0 and go up", {});
    areNamed_ = llvm::any_of(names_.all(), [](const Occurrence &one) {
      return isNumber(one) && one.use != NameUse::Definition && one.scope != otherFile;
    });
    if (!refuseUntold() || !number() || !allAreNumbered() || !rename())
      return std::move(result_);
    return std::move(result_);
  }

private:
  Renumbering &refuse(std::string why, SourceRange at) {
    result_ = {{}, std::move(why), at};
    return result_;
  }

  bool refuseUntold() {
    for (size_t i = 0; i < snapshot_.unit().index.programs().size(); ++i) {
      const uint32_t at = names_.untold(uint32_t(i)).target;
      if (at == UntoldNames::nowhere)
        continue;
      refuse("the target of a jump is computed: no one knows which block it means",
             {snapshot_.source().id(), at, snapshot_.source().lines().lineEnd(at)});
      return false;
    }
    return true;
  }

  static bool isNumber(const Occurrence &one) { return one.kind == NameKind::Block; }

  /// Gives every numbered block its new number, in the order of the text.
  bool number() {
    const double most = snapshot_.dialect().addresses[letterAddress('N')].most;
    uint32_t program = ~0u;
    int64_t next = options_.first, step = options_.step, before = 0;
    bool isPlanned = !isPart();
    for (size_t i = 0; i < names_.all().size(); ++i) {
      const Occurrence &one = names_.all()[i];
      if (!isNumber(one) || one.use != NameUse::Definition)
        continue;
      if (const uint32_t own = names_.programAt(one.begin); own != program) {
        program = own;
        next = options_.first;
        before = 0;
        isPlanned = !isPart();
      }
      if (!isWhereTheControlLooks(one)) {
        refuse("the number of this block cannot be read for certain", names_.range(one));
        return false;
      }
      if (!isSelected(one)) {
        before = int64_t(one.key);
        fresh_[one.begin] = before;
        continue;
      }
      if (!std::exchange(isPlanned, true) && !findRoom(i, before, next, step))
        return false;
      if (double(next) > most || next > mostNumber) {
        refuse("the numbers would grow larger than the control allows", names_.range(one));
        return false;
      }
      fresh_[one.begin] = next;
      next += step;
    }
    return true;
  }

  bool isPart() const { return options_.begin > 0 || options_.end < snapshot_.text().size(); }
  bool isSelected(const Occurrence &one) const {
    return one.begin >= options_.begin && one.begin < options_.end;
  }

  /// The first number and the step of the selected blocks from the one at `index` on, which come
  /// after the number `before`.
  bool findRoom(size_t index, int64_t before, int64_t &first, int64_t &step) {
    const uint32_t program = names_.programAt(names_.all()[index].begin);
    int64_t count = 0, after = 0;
    for (const Occurrence &one : names_.all().drop_front(index)) {
      if (!isNumber(one) || one.use != NameUse::Definition)
        continue;
      if (names_.programAt(one.begin) != program)
        break;
      if (!isSelected(one)) {
        after = int64_t(one.key);
        break;
      }
      ++count;
    }
    for (const int64_t tried : {options_.step, int64_t(5), int64_t(2), int64_t(1)}) {
      if (tried > options_.step)
        continue;
      step = tried;
      first = before / tried * tried + tried;
      if (after == 0 || first + (count - 1) * tried < after)
        return true;
    }
    refuse("there are not enough numbers between those around the selection",
           names_.range(names_.all()[index]));
    return false;
  }

  /// Whether the number is digits alone and, where some place names a block, one that the control
  /// finds: it looks at the begins of lines.
  bool isWhereTheControlLooks(const Occurrence &one) {
    if (!llvm::all_of(names_.text(one), llvm::isDigit))
      return false;
    if (!areNamed_)
      return true;
    const FileIndex &index = snapshot_.unit().index;
    const llvm::ArrayRef<NumberedBlock> found = index.numbersAsWritten(index.programAt(one.begin));
    const auto next = std::upper_bound(
        found.begin(), found.end(), one.begin,
        [](uint32_t offset, const NumberedBlock &block) { return offset < block.offset; });
    return next != found.begin() && uint64_t((next - 1)->number) == one.key &&
           numbered_.insert((next - 1)->offset).second;
  }

  /// The control finds no number besides those that are changed.
  bool allAreNumbered() {
    size_t found = 0;
    const FileIndex &index = snapshot_.unit().index;
    for (const ProgramInfo &program : index.programs())
      found += areNamed_ ? index.numbersAsWritten(program).size() : 0;
    if (found <= numbered_.size())
      return true;
    refuse("a line begins with a number that is not its block's", {});
    return false;
  }

  bool rename() {
    for (const Occurrence &one : names_.all()) {
      if (!isNumber(one) || one.scope == otherFile)
        continue;
      const Occurrence *block = one.use == NameUse::Definition ? &one : names_.definition(one);
      const auto number = block ? fresh_.find(block->begin) : fresh_.end();
      if (number == fresh_.end()) {
        refuse("block " + names_.text(one).str() + " is named here and does not exist",
               names_.range(one));
        return false;
      }
      const std::string text = digits(number->second, names_.text(one));
      if (text != names_.text(one))
        result_.edits.push_back({names_.range(one), text});
    }
    return true;
  }

  /// Longer numbers no control takes.
  static constexpr int64_t mostNumber = 99999999;

  Snapshot &snapshot_;
  const NumberOptions options_;
  const Names names_;
  bool areNamed_ = false;                   ///< some place names a block
  llvm::DenseSet<uint32_t> numbered_;       ///< blocks that have their new number
  llvm::DenseMap<uint32_t, int64_t> fresh_; ///< new number by the offset of the old one
  Renumbering result_;
};

} // namespace

Renumbering renumber(Snapshot &snapshot, const NumberOptions &options) {
  return Renumberer(snapshot, options).run();
}

} // namespace ncvet::lsp
