// Help on the word at a place, from the dialect's tables.
#include "lsp/features/showing/word_help.h"

#include "interp/evaluate/condition.h"
#include "interp/evaluate/expression.h"
#include "interp/state/executed_block.h"
#include "lsp/features/number_text.h"
#include "lsp/features/word_use.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet::lsp {

namespace {

/// Codes that one variable is a parameter of: more are not listed.
constexpr unsigned mostCodesListed = 8;

std::string code(llvm::StringRef text) { return ("`" + text + "`").str(); }

/// `above 0, at most 180, a whole number`; empty: no bounds.
std::string boundsOf(const ValueTest &range) {
  std::vector<std::string> parts;
  if (!range.oneOf.empty()) {
    std::string list;
    for (const double value : range.oneOf)
      list += (list.empty() ? "" : ", ") + numberText(value);
    parts.push_back("one of " + list);
  }
  if (std::isfinite(range.min))
    parts.push_back((range.minExclusive ? "above " : "at least ") + numberText(range.min));
  if (std::isfinite(range.max))
    parts.push_back((range.maxExclusive ? "below " : "at most ") + numberText(range.max));
  if (range.integer)
    parts.push_back("a whole number");
  if (range.point == PointRule::Required)
    parts.push_back("with a decimal point");
  if (range.point == PointRule::Forbidden)
    parts.push_back("without a decimal point");
  return llvm::join(parts, ", ");
}

/// Traits of a code that a user must know, one sentence.
std::string habits(const CodeInfo &info) {
  std::vector<std::string> parts;
  if (info.needsFeed)
    parts.push_back("needs a feed");
  if (info.needsSpeed)
    parts.push_back("needs a spindle speed");
  if (info.spindle == SpindleNeed::Running || info.spindle == SpindleNeed::Clockwise ||
      info.spindle == SpindleNeed::CounterClockwise)
    parts.push_back("needs a turning spindle");
  if (info.cancelsCycle)
    parts.push_back("ends a canned cycle");
  if (info.alone)
    parts.push_back("wants a block of its own");
  if (info.twoBlock)
    parts.push_back("takes two blocks");
  return llvm::join(parts, ", ");
}

/// Finds the piece of a block at a place and tells of it.
class Helper {
public:
  Helper(Snapshot &snapshot, const Block &block, uint32_t offset, const MachineState *before)
      : snapshot_(snapshot), dialect_(snapshot.dialect()), offset_(offset), before_(before),
        lone_(dialect_, snapshot.unit().machine, snapshot.unit().executor(), block, before) {}

  std::optional<WordHelp> help() const {
    const Block &block = lone_.block();
    for (const Comment &comment : block.comments)
      if (holds(comment.begin, comment.end))
        return std::nullopt;
    if (holds(block.numberBegin, block.numberEnd))
      return at(block.numberBegin, block.numberEnd,
                "**" + text(block.numberBegin, block.numberEnd) + "** block number");
    if (auto found = variableHelp())
      return found;
    const Word *best = nullptr;
    for (const Word &word : block.words)
      if (word.address != noAddress && holds(word.offset, block.endOf(word)) &&
          (!best || lengthOf(word) <= lengthOf(*best)))
        best = &word;
    return best ? wordHelp(*best) : std::nullopt;
  }

private:
  bool holds(uint32_t begin, uint32_t end) const { return begin <= offset_ && offset_ < end; }
  uint32_t lengthOf(const Word &word) const { return lone_.block().endOf(word) - word.offset; }
  std::string text(uint32_t begin, uint32_t end) const {
    return snapshot_.source().displayText(snapshot_.text().slice(begin, end));
  }
  WordHelp at(uint32_t begin, uint32_t end, std::string markdown) const {
    return {{snapshot_.source().id(), begin, end}, std::move(markdown)};
  }

  std::optional<WordHelp> wordHelp(const Word &word) const {
    if (word.address == keywordAddress ||
        dialect_.addresses[word.address].kind == AddressKind::Code)
      return helpOfCode(word);
    const WordUse use = useOf(lone_.executed(), word);
    const auto value = effectiveValue(lone_.executed(), word, use);
    std::string out = title(word, use);
    if (value)
      out += "\n\n" + code(text(word.offset, lone_.block().endOf(word))) + " = " + value->text;
    if (use.spec) {
      const std::string bounds = boundsOf(use.spec->hasRange ? use.spec->range : ValueTest());
      if (!bounds.empty())
        out += "\n\nRange: " + bounds;
      if (use.spec->absent)
        out += "\n\nLeft out: " + numberText(*use.spec->absent);
    }
    return at(word.offset, lone_.block().endOf(word), std::move(out));
  }

  /// `**P** dwell at the bottom - word of `G83` peck drilling`
  std::string title(const Word &word, const WordUse &use) const {
    std::string name, meaning;
    if (word.address < variableAddress) {
      name = dialect_.addressName(word.address);
      meaning = dialect_.addresses[word.address].title;
      if (dialect_.addresses[word.address].kind == AddressKind::Unknown)
        return "**" + name + "** no address of this control";
    }
    if (use.spec) {
      if (!use.spec->name.empty())
        name = use.spec->name;
      if (!use.spec->note.empty())
        meaning = use.spec->note;
    } else if (word.address == variableAddress) {
      return variableTitle(word);
    }
    if (name.empty())
      name = text(word.offset, lone_.block().endOf(word));
    std::string out = "**" + name + "** " + meaning;
    if (use.code)
      out += " – " + code(use.code->name) + " " + use.code->title;
    return out;
  }

  std::string variableTitle(const Word &word) const {
    const uint64_t key = variableOf(lone_.block(), word);
    std::string name;
    for (const Item &item : lone_.block().items)
      if (item.begin == word.offset && item.kind == ItemKind::Assignment)
        name = text(item.nameBegin, item.nameEnd);
    return parameterHelp(name, key);
  }

  /// A variable that codes read as their parameter.
  std::string parameterHelp(llvm::StringRef name, uint64_t key) const {
    std::string out = ("**" + name + "** variable").str();
    unsigned listed = 0;
    std::string last;
    for (const CodeInfo &info : dialect_.codes)
      for (const WordSpec &spec : info.words)
        if (key && (spec.variable == key || spec.orVariable == key) && info.name != last &&
            listed < mostCodesListed) {
          out += "\n- " + code(info.name) + " " + info.title + ": " + specHelp(spec);
          last = info.name;
          ++listed;
        }
    return out;
  }

  std::optional<WordHelp> helpOfCode(const Word &word) const {
    const uint32_t end = lone_.block().endOf(word);
    const std::string spelled = text(word.offset, end);
    const CodeInfo *info = nullptr;
    for (const CodeUse &use : lone_.executed().outcome.codes)
      if (use.word == &word)
        info = &dialect_.codes[use.code];
    if (const CodeIndex index = codeOf(dialect_, word); !info && index < dialect_.codes.size())
      info = &dialect_.codes[index];
    if (info)
      return at(word.offset, end, codeHelp(dialect_, *info));
    if (!word.isNumber())
      return std::nullopt;
    return at(word.offset, end,
              "**" + spelled + "** is no code that the table of this control knows");
  }

  /// A variable, where it is read or written.
  std::optional<WordHelp> variableHelp() const {
    const Block &block = lone_.block();
    for (const Item &item : block.items)
      if (item.target != noExpression && holds(beginOfName(item), endOfName(item)) &&
          (item.kind == ItemKind::Assignment || item.kind == ItemKind::Definition ||
           item.kind == ItemKind::Input || item.kind == ItemKind::Structure))
        return at(beginOfName(item), endOfName(item),
                  variable(text(beginOfName(item), endOfName(item)), block.keyOf(item.target)));
    for (const ExpressionOp &op : block.operations) {
      if (op.op != Op::Variable || op.offset > offset_ + 1)
        continue;
      const bool afterMark = op.offset && snapshot_.text()[op.offset - 1] == '#';
      const uint32_t begin = op.offset - afterMark, end = endOfName(begin);
      if (begin <= offset_ && offset_ < end)
        return at(begin, end, variable(text(begin, end), uint64_t(op.value)));
    }
    return std::nullopt;
  }

  /// Of what is written: with the mark of a variable and its brackets.
  uint32_t beginOfName(const Item &item) const {
    const llvm::StringRef all = snapshot_.text().take_front(item.nameBegin);
    for (const llvm::StringRef mark : {"#<", "#"})
      if (item.nameBegin != item.nameEnd && all.endswith(mark))
        return item.nameBegin - uint32_t(mark.size());
    return item.nameBegin;
  }
  uint32_t endOfName(const Item &item) const {
    const uint32_t begin = beginOfName(item);
    return begin == item.nameBegin ? item.nameEnd : endOfName(begin);
  }
  /// After `#100`, `#<name>`, `R1`, `NAME`.
  uint32_t endOfName(uint32_t begin) const {
    const llvm::StringRef all = snapshot_.text();
    uint32_t p = begin;
    while (p < all.size() && (all[p] == '#' || all[p] == '$' || all[p] == '%'))
      ++p;
    const bool angle = p > begin && p < all.size() && all[p] == '<';
    if (angle) {
      const size_t close = all.find_first_of(">\r\n", p);
      return uint32_t(
          std::min(close == llvm::StringRef::npos ? all.size() : close + 1, all.size()));
    }
    while (p < all.size() && (llvm::isAlnum(all[p]) || all[p] == '_'))
      ++p;
    return p;
  }

  std::string variable(const std::string &name, uint64_t key) const {
    std::string out = parameterHelp(name, key);
    if (key && key < firstSharedVariable) {
      const VariableRanges &ranges = dialect_.variableRanges;
      const auto number = int64_t(key);
      if (dialect_.lexical.macro && number <= ranges.lastLocal)
        out += ", local to the running program";
      else if (number <= ranges.lastCommon)
        out += ", common to all programs";
      else
        out += " of the control";
    }
    if (!before_ || !key)
      return out;
    const Value value = readVariable(*before_, int64_t(key));
    if (value.isVacant())
      out += "\n\nNot set here";
    else if (const std::string known = intervalText(value.asNumber()); !known.empty())
      out += "\n\nHere: " + known;
    return out;
  }

  Snapshot &snapshot_;
  const Dialect &dialect_;
  const uint32_t offset_;
  const MachineState *before_;
  const LoneBlock lone_;
};

} // namespace

std::string specName(const Dialect &dialect, const WordSpec &spec) {
  return spec.name.empty() ? dialect.alternatives(spec.any) : spec.name;
}

std::string specHelp(const WordSpec &spec) {
  std::string out = spec.note.empty() ? toString(spec.role).str() : spec.note;
  if (spec.hasRange)
    if (const std::string bounds = boundsOf(spec.range); !bounds.empty())
      out += ", " + bounds;
  if (spec.need == Need::Required || spec.need == Need::Here)
    out += " (required)";
  else if (spec.need == Need::First)
    out += " (required when the cycle begins)";
  return out;
}

std::string codeHelp(const Dialect &dialect, const CodeInfo &info) {
  std::string out = "**" + info.name + "** " + info.title;
  if (info.group != noGroup) {
    const GroupInfo &group = dialect.groups[info.group];
    out += "\n\n" + std::string(group.oneShot ? "Acts in its block only" : "Modal") + ", group “" +
           (group.title.empty() ? group.id : group.title) + "”";
    if (info.opposite != noCode)
      out += "; ended by " + code(dialect.codes[info.opposite].name);
  }
  if (const std::string traits = habits(info); !traits.empty())
    out += "\n\n" + std::string(1, char(traits[0] & ~32)) + traits.substr(1) + ".";
  if (!info.words.empty())
    out += "\n";
  for (const WordSpec &spec : info.words)
    out += "\n- " + code(specName(dialect, spec)) + " " + specHelp(spec);
  if (!info.source.empty())
    out += "\n\n*Manual: " + info.source + "*";
  return out;
}

std::optional<WordHelp> wordHelp(Snapshot &snapshot, uint32_t offset, const MachineState *before) {
  Block block;
  snapshot.readAt(offset, block);
  return Helper(snapshot, block, offset, before).help();
}

} // namespace ncvet::lsp
