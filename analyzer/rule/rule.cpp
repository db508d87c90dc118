// What rules look at and how they report.
#include "analyzer/rule/rule.h"

#include "analyzer/program/project.h"
#include "analyzer/rule/collector.h"
#include "analyzer/rule/text_ahead.h"

namespace ncvet {

SortedCodes::SortedCodes(const Dialect &dialect) : byAction(actionNames().size()) {
  for (size_t code = 0; code < dialect.codes.size(); ++code) {
    byAction[size_t(dialect.codes[code].action)].push_back(CodeIndex(code));
    for (const Notice &notice : dialect.codes[code].notices)
      if (auto &codes = byNotice[notice.rule]; codes.empty() || codes.back() != code)
        codes.push_back(CodeIndex(code));
  }
}

void Subscriptions::onAction(std::initializer_list<Action> actions) {
  for (const Action action : actions)
    llvm::append_range(codes_, sorted_.byAction[size_t(action)]);
}

void Subscriptions::onNotices(llvm::StringRef id) {
  noticesHandled_ = true;
  if (const auto codes = sorted_.byNotice.find(id); codes != sorted_.byNotice.end())
    llvm::append_range(codes_, codes->second);
}

const OptionValue *Subscriptions::option(llvm::StringRef name) const {
  if (!options_)
    return nullptr;
  const auto found = options_->options.find(name);
  return found == options_->options.end() ? nullptr : &found->second;
}

double Subscriptions::number(llvm::StringRef name, double fallback) const {
  const OptionValue *value = option(name);
  const auto *number = value ? std::get_if<double>(value) : nullptr;
  return number ? *number : fallback;
}

bool Subscriptions::flag(llvm::StringRef name, bool fallback) const {
  return number(name, fallback) != 0;
}

unsigned Subscriptions::choice(llvm::StringRef name, llvm::ArrayRef<llvm::StringLiteral> names,
                               unsigned fallback) const {
  const OptionValue *value = option(name);
  if (const auto *chosen = value ? std::get_if<std::string>(value) : nullptr)
    for (unsigned i = 0; i < names.size(); ++i)
      if (names[i] == *chosen)
        return i;
  return unsigned(number(name, fallback));
}

const CodeUse *RuleContext::find(std::initializer_list<Action> actions) const {
  for (const CodeUse &use : codes())
    if (llvm::is_contained(actions, code(use).action))
      return &use;
  return nullptr;
}

FileUnit &RuleContext::unitOf(FileId file) const {
  if (file == source_->id())
    return *unit_;
  assert(unit_->project && "what is known of another file was learned in a project");
  return unit_->project->unit(unit_->project->sources().get(file));
}

const FileIndex &RuleContext::indexOf(FileId file) const { return unitOf(file).index; }

llvm::StringRef RuleContext::text(SourceRange range) const {
  return unitOf(range.file).source.text(range.begin, range.end);
}

const Block *RuleContext::nextAlike() const {
  return ahead_ ? ahead_->peek(block_->next) : nullptr;
}

const ArcWords &RuleContext::arcWords() const {
  if (std::exchange(arcWordsNoted_, true))
    return *arcWords_;
  const KnownArcs::Entry *const entry = knownArcs_ ? knownArcs_->find(outcome_->known) : nullptr;
  if (entry)
    noteUse(entry->wordsUse);
  if (!arcWords_ && entry) {
    entry->fill(*block_, arcWords_.emplace());
  } else if (!arcWords_) {
    const StateUse used = std::exchange(stateUse, StateUse());
    arcWords_ = ncvet::arcWords(*dialect_, *after_, *block_);
    if (outcome_->known) {
      if (!knownArcs_)
        knownArcs_ = std::make_unique<KnownArcs>();
      knownArcs_->keep(outcome_->known, *block_, *arcWords_).wordsUse = stateUse;
    }
    stateUse |= used;
  } else if (!entry) { // which of them means what, the plane has decided
    after_->active(*dialect_, StandardGroup::Plane);
  }
  return *arcWords_;
}

const ArcGeometry &RuleContext::arc() const {
  if (std::exchange(centresOf_, unit_) != unit_)
    centres_ = arcCentresOf(*dialect_, *machine_);
  if (arc_)
    return *arc_;
  const ArcWords &words = arcWords();
  KnownArcs::Entry *const entry = knownArcs_ ? knownArcs_->find(outcome_->known) : nullptr;
  if (entry && entry->hasGeometry) {
    noteUse(entry->geometryUse);
    entry->fill(*block_, *before_, *after_, arc_.emplace());
    return *arc_;
  }
  const StateUse used = std::exchange(stateUse, StateUse());
  arc_ = arcGeometry(words, *dialect_, *machine_, centres_, *block_, *before_, *after_);
  if (entry) {
    KnownArcs::keepGeometry(*entry, *block_, *dialect_, *machine_, *before_, *after_, *arc_);
    entry->geometryUse = stateUse;
  }
  stateUse |= used;
  return *arc_;
}

SourceRange RuleContext::blockRange() const {
  SourceRange range{source_->id(), block_->begin, block_->end};
  const auto begin = [&](uint32_t offset) { range.begin = std::min(range.begin, offset); };
  range.begin = block_->end;
  range.end = block_->begin;
  for (const Word &word : block_->words) {
    begin(word.offset);
    range.end = std::max(range.end, block_->endOf(word));
  }
  for (const Item &item : block_->items) {
    begin(item.begin);
    range.end = std::max(range.end, item.end);
  }
  if (range.begin >= range.end)
    range = {source_->id(), block_->begin, block_->end};
  return range;
}

bool RuleContext::isAt(llvm::StringRef name) const {
  if (name.empty())
    return true;
  if (codes().empty()) {
    const CodeInfo *motion = after_->activeCode(*dialect_, StandardGroup::Motion);
    return motion && motion->name == name;
  }
  return llvm::any_of(codes(), [&](const CodeUse &use) { return code(use).name == name; });
}

std::optional<RuleId> RuleContext::toldRule() const {
  for (const ToldAt &told : toldAt_)
    if (told.rule == rule_ && isAt(told.code))
      return told.wanted ? std::optional(told.as) : std::nullopt;
  return rule_;
}

FindingBuilder RuleContext::report(SourceRange range, bool certain) {
  const std::optional<RuleId> rule = toldRule();
  return FindingBuilder(rule ? collector_.report(*rule, range, certain) : nullptr);
}

bool RuleContext::asked() const { return collector_.isAsked(rule_); }

namespace {
/// The block's assignment to a variable that the formula of a notice reads, or null.
const Word *changedFor(const Notice &notice, const CodeInfo &code, const Block &block) {
  for (const FormulaStep &step : notice.when.formula.steps) {
    uint64_t first = 0, other = 0;
    if (step.op == FormulaOp::Variable || step.op == FormulaOp::GivenVariable) {
      first = uint64_t(step.number);
    } else if (step.op == FormulaOp::Word || step.op == FormulaOp::Given) {
      first = code.words[step.index].variable;
      other = code.words[step.index].orVariable;
    }
    for (const uint64_t key : {first, other})
      if (const Word *word = key ? assignmentOf(block, key) : nullptr)
        return word;
  }
  return nullptr;
}
} // namespace

/// In a later block of a cycle, where no word is the code's, only what the block gives anew is
/// judged, and only what was right before.
void RuleContext::reportNotices(llvm::StringRef id, const Event &event) {
  static const Block nothing;
  const CodeInfo &info = code(event);
  for (const Notice &notice : info.notices) {
    if (id != notice.rule || (notice.advice && !asked()) ||
        !holds(notice.when, &info, conditions()))
      continue;
    const Word *const own = event.word ? event.word : changedFor(notice, info, *block_);
    if (!own || (!event.word && holds(notice.when, &info,
                                      {*dialect_, *machine_, nothing, {}, *before_, false, 0})))
      continue;
    const Word *word = notice.atVariable        ? assignmentOf(*block_, notice.atVariable)
                       : notice.at == noAddress ? own
                                                : block_->find(notice.at);
    if (!word)
      word = own;
    if (auto finding = report(*word)) {
      std::string message = notice.message;
      for (size_t open = message.find('{'); open != std::string::npos;
           open = message.find('{', open + 1)) {
        const size_t close = message.find('}', open);
        if (close == std::string::npos)
          break;
        const llvm::StringRef name = llvm::StringRef(message).slice(open + 1, close);
        std::string text;
        if (name == "code") {
          text = event.kind == EventKind::Code ? this->text(*event.word).str() : info.name;
        } else if (name.size() == 1 && name[0] >= 'A' && name[0] <= 'Z') {
          if (const Word *named = block_->find(name[0]))
            text = this->text(*named).str();
        } else {
          continue;
        }
        message.replace(open, close - open + 1, text);
      }
      finding.text(std::move(message)).severity(notice.severity);
    }
  }
}

TextEdit RuleContext::remove(const Word &word) const {
  SourceRange where = range(word);
  const llvm::StringRef all = source_->text();
  while (where.begin > block_->begin && all[where.begin - 1] == ' ')
    --where.begin;
  return {where, ""};
}

namespace {
/// The line end that the file uses at `offset`.
llvm::StringRef lineEndAt(llvm::StringRef text, uint32_t end) {
  const llvm::StringRef rest = text.substr(end, 2);
  if (rest.startswith("\r\n"))
    return "\r\n";
  return rest.startswith("\r") ? "\r" : "\n";
}
} // namespace

/// Where blocks span lines a new one begins with its mark.
static llvm::StringRef headOf(const Dialect &dialect) {
  return dialect.lexical.blocksSpanLines ? "N " : "";
}

TextEdit RuleContext::insertBlockBefore(llvm::StringRef text) const {
  return {{source_->id(), block_->begin, block_->begin},
          (headOf(*dialect_) + text + lineEndAt(source_->text(), block_->end)).str()};
}

TextEdit RuleContext::insertBlockAfter(llvm::StringRef text) const {
  return {{source_->id(), block_->end, block_->end},
          (lineEndAt(source_->text(), block_->end) + headOf(*dialect_) + text).str()};
}

bool FileSummary::isAnyReached(uint32_t begin, uint32_t end) const {
  const auto at =
      llvm::partition_point(reached, [&](const SourceRange &r) { return r.end <= begin; });
  return at != reached.end() && at->begin < end;
}

SourceRange FileSummary::numberAt(uint32_t offset) const {
  Block block;
  reader.read(offset, block);
  return {source.id(), block.numberBegin, block.numberEnd};
}

bool FileSummary::isReached(uint32_t offset) const {
  const auto at =
      llvm::partition_point(reached, [&](const SourceRange &r) { return r.end <= offset; });
  return at != reached.end() && at->begin <= offset;
}

} // namespace ncvet
