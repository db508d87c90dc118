// Hands the events of a block to the rules that listen for them.
#include "analyzer/rule/dispatch.h"

#include "analyzer/rule/block_shape.h"
#include "analyzer/rule/hole_row.h"

#include "llvm/Support/MathExtras.h"

#include <utility>

namespace ncvet {

namespace {

/// Kinds of events of blocks that only go on.
constexpr uint32_t movesAndBlocks =
    bitOf(EventKind::Block) | bitOf(EventKind::Motion) | bitOf(EventKind::Code);

/// A rule that a control's table tells under another name is selected by that name and by its own.
bool runs(RuleId rule, RuleId told, const RuleSelection &selection) {
  if (told >= selection.enabled.size()) // nothing was selected
    return true;
  return !selection.ignored[rule] &&
         (selection.enabled[told] || (selection.enabled[rule] && selection.asked[rule]));
}

} // namespace

Dispatcher::Dispatcher(const Dialect &dialect, const MachineProfile &machine,
                       const RuleSelection &selection, Collector &collector)
    : byCode_(dialect.codes.size()), noticesOf_(dialect.codes.size()), context_(collector) {
  const llvm::ArrayRef<RuleEntry> table = allRules();
  const SortedCodes sorted(dialect);
  for (size_t i = 0; i < table.size(); ++i) {
    // The user's options lie over the dialect's.
    RuleOverride options;
    const auto ofDialect = dialect.rules.find(table[i].info.id);
    if (ofDialect != dialect.rules.end())
      options = ofDialect->second;
    const RuleId told = options.toldAs.empty() ? RuleId(i) : findRule(options.toldAs).value_or(i);
    const bool runsAnywhere = runs(RuleId(i), told, selection);
    bool runsAtCodes = false;
    for (const auto &at : options.toldAt)
      if (const std::optional<RuleId> as = findRule(at.second)) {
        const bool wanted = runs(RuleId(i), *as, selection);
        context_.toldAt_.push_back({told, at.first().str(), *as, wanted});
        runsAtCodes |= wanted;
      }
    if (!runsAnywhere && !runsAtCodes)
      continue;
    if (!runsAnywhere)
      context_.toldAt_.push_back({told, "", told, false});
    const auto ofUser = selection.options.find(table[i].info.id);
    if (ofUser != selection.options.end())
      for (const auto &entry : ofUser->second)
        options.options[entry.first()] = entry.second;
    rules_.push_back(table[i].make());
    Listener listener{rules_.back().get(), told};
    all_.push_back(listener);
    Subscriptions subscriptions(dialect, machine, &options, sorted);
    listener.rule->listen(subscriptions);
    listener.moves = subscriptions.moves();
    if (subscriptions.isGathering())
      gatherers_.push_back(listener.rule);
    RuleMemory first(FileId(0));
    listener.rule->remember(first);
    const bool remembers = !first.isLeftOut();
    if (remembers)
      rememberers_.push_back(listener.rule);
    if (remembers && !(subscriptions.everyBlock() & movesAndBlocks))
      changeRememberers_.push_back(listener.rule);
    listenToKinds(listener, subscriptions);
    // Facts of the table are reported for every rule; some do so themselves.
    if (const auto codes = sorted.byNotice.find(table[i].info.id); codes != sorted.byNotice.end())
      listenToNotices(RuleId(i), dialect, codes->second, !subscriptions.noticesHandled());
    listenToCodes(listener, subscriptions);
  }
}

void Dispatcher::listenToKinds(const Listener &listener, const Subscriptions &subscriptions) {
  kinds_ |= subscriptions.kinds();
  for (uint32_t left = subscriptions.kinds(); left; left &= left - 1)
    byKind_[llvm::countTrailingZeros(left)].push_back(listener);
  if (subscriptions.kinds() & bitOf(EventKind::Motion))
    for (size_t move = 0; move < byMove_.size(); ++move)
      if (listener.moves & bitOf(MotionKind(move)))
        byMove_[move].push_back(listener);
  for (const EventKind kind : {EventKind::Block, EventKind::Code, EventKind::Motion})
    if (subscriptions.everyBlock() & bitOf(kind))
      everyBlock_.emplace_back(kind, listener);
}

void Dispatcher::listenToNotices(RuleId rule, const Dialect &dialect,
                                 llvm::ArrayRef<CodeIndex> noticed, bool report) {
  for (const CodeIndex code : noticed) {
    if (dialect.codes[code].action == Action::Cycle) {
      kinds_ |= bitOf(EventKind::CycleRun);
      noticesOf_[code].push_back(rule);
    }
    if (report) {
      kinds_ |= bitOf(EventKind::Code);
      byCode_[code].push_back({nullptr, rule});
    }
  }
}

void Dispatcher::listenToCodes(const Listener &listener, const Subscriptions &subscriptions) {
  for (const CodeIndex code : subscriptions.codes()) {
    kinds_ |= bitOf(EventKind::Code);
    // A rule subscribes at once: what it has asked for twice comes one after the other.
    std::vector<Listener> &listeners = byCode_[code];
    if (listeners.empty() || listeners.back().rule != listener.rule)
      listeners.push_back(listener);
  }
}

void Dispatcher::prepare(const ToldBlock &told) {
  context_.dialect_ = told.unit.dialect.get();
  context_.machine_ = &told.unit.machine;
  context_.unit_ = &told.unit;
  context_.source_ = &told.unit.source;
  context_.index_ = &told.unit.index;
  context_.block_ = &told.block;
  context_.outcome_ = &told.outcome;
  context_.before_ = &told.before;
  context_.after_ = &told.after;
  context_.caller_ = told.caller;
  context_.ahead_ = nullptr;
  context_.arcWords_.reset();
  context_.arc_.reset();
  context_.startNotes();
}

void Dispatcher::dispatch(const ToldBlock &told, TextAhead *ahead, uint64_t place) {
  const Outcome &outcome = told.outcome;
  if (!(outcome.kinds & kinds_))
    return;
  const KnownModes *const again = shapes_ ? toldAgain(outcome) : nullptr;
  if (again && again->awake.empty()) {
    context_.noteUse(again->asleepUse);
    return;
  }
  prepare(told);
  context_.ahead_ = ahead;
  if (again)
    tellAwake(*again, outcome);
  else if (!shapes_ || !tellKnown(place, outcome))
    tellAll(outcome);
}

/// Who is told of such blocks; null: that is not known.
const Dispatcher::KnownModes *Dispatcher::toldAgain(const Outcome &outcome) const {
  const KnownModes &known = shapes_->again[outcome.known % shapes_->again.size()];
  return outcome.known && known.modes == outcome.known ? &known : nullptr;
}

void Dispatcher::tellAwake(const KnownModes &modes, const Outcome &outcome) {
  context_.noteUse(modes.asleepUse);
  const bool hasRows = modes.inRow.size() != modes.awake.size();
  const bool inRow = hasRows && context_.block().comments.empty() && isFollowedByPlace(context_);
  for (const Awake &one : inRow ? modes.inRow : modes.awake)
    tellOne(outcome.events[one.event], one.listener);
}

/// Who is told of every hole of the row; null: that is not known, or not the same of all.
const Dispatcher::KnownModes *Dispatcher::toldOfRow(const HoleRow &row) const {
  const KnownModes *all = nullptr;
  for (const Outcome *outcome : row.kinds) {
    const KnownModes *const again = toldAgain(*outcome);
    const auto isSame = [](const Awake &a, const Awake &b) {
      return a.listener.rule == b.listener.rule;
    };
    if (!again || (all && !std::equal(all->inRow.begin(), all->inRow.end(), again->inRow.begin(),
                                      again->inRow.end(), isSame)))
      return nullptr;
    all = again;
  }
  return all;
}

size_t Dispatcher::dispatchRow(const ToldBlock &before, const HoleRow &row, size_t most) {
  const KnownModes *const told = shapes_ ? toldOfRow(row) : nullptr;
  if (!told)
    return 0;
  prepare(before);
  // What a rule that gathers has taken it keeps.
  const Listener *gatherer = nullptr;
  for (const Awake &one : told->inRow) {
    if (!one.listener.rule || most == 0)
      return 0;
    context_.rule_ = one.listener.id;
    if (!llvm::is_contained(gatherers_, one.listener.rule))
      most = one.listener.rule->onRow(row, most, context_);
    else if (std::exchange(gatherer, &one.listener))
      return 0;
  }
  if (gatherer && most) {
    context_.rule_ = gatherer->id;
    most = gatherer->rule->onRow(row, most, context_);
  }
  if (most)
    context_.index().noteRead(row.holes[0].begin, row.holes[most - 1].next);
  return most;
}

/// Tells those that have not said that blocks of this shape do not interest them; false: that is
/// not known of it. What is met for the first time is only noted: in some programs no block has the
/// shape of another.
bool Dispatcher::tellKnown(uint64_t place, const Outcome &outcome) {
  const Block &block = context_.block();
  const uint64_t shape = place ? shapeAt(place, context_.caller(), block, outcome)
                               : shapeOf(context_.dialect(), block, outcome, context_.caller());
  if (!shape)
    return false;
  if (std::exchange(shapes_->met[shape % KnownShapes::places], shape) != shape)
    return false;
  KnownShape &known = knownShape(shape);
  const uint64_t modes = modesOf(known.use, context_.before(), context_.after());
  for (const KnownModes &there : known.modes)
    if (there.modes == modes) {
      if (outcome.known) {
        KnownModes &again = shapes_->again[outcome.known % shapes_->again.size()];
        again = there;
        again.modes = outcome.known;
      }
      tellAwake(there, outcome);
      return true;
    }
  findingPlace_ = place != 0;
  findOut(known, outcome);
  return true;
}

/// What is known of the shape; where nothing is, the shape that was met first may be given up.
Dispatcher::KnownShape &Dispatcher::knownShape(uint64_t shape) {
  std::vector<KnownShape> &all = shapes_->all;
  uint16_t &at = shapes_->at[shape % KnownShapes::places];
  if (at < all.size() && all[at].shape == shape)
    return all[at];
  at = uint16_t(shapes_->next);
  if (all.size() < KnownShapes::most)
    all.emplace_back();
  KnownShape &room = all[at];
  shapes_->next = (shapes_->next + 1) % unsigned(KnownShapes::most);
  room.shape = shape;
  room.use = {};
  for (KnownModes &modes : room.modes)
    modes.modes = 0;
  return room;
}

/// Tells all, and notes who need not be told of such a block again.
void Dispatcher::findOut(KnownShape &shape, const Outcome &outcome) {
  KnownModes &modes = shape.modes[shape.next];
  shape.next = (shape.next + 1) % unsigned(shape.modes.size());
  modes.awake.clear();
  modes.inRow.clear();
  modes.asleepUse = {};
  finding_ = &modes;
  context_.notes_ = true;
  tellAll(outcome);
  context_.notes_ = recordsUses_;
  finding_ = nullptr;
  StateUse use = shape.use;
  use |= modes.asleepUse;
  if (!isSame(use, shape.use)) { // the others were told apart by less
    shape.use = use;
    for (KnownModes &other : shape.modes)
      other.modes = 0;
  }
  modes.modes = modesOf(use, context_.before(), context_.after());
}

void Dispatcher::tellAll(const Outcome &outcome) {
  for (uint32_t i = 0; i < outcome.events.size(); ++i) {
    const Event &event = outcome.events[i];
    if (!(bitOf(event.kind) & kinds_))
      continue;
    if (event.kind == EventKind::Motion)
      tell(outcome, i, byMove_[size_t(event.motion)]);
    else
      tell(outcome, i, byKind_[size_t(event.kind)]);
    if (event.kind == EventKind::CycleRun)
      reportChanged(event);
    if (event.kind == EventKind::Code)
      tell(outcome, i, byCode_[event.code]);
  }
}

void Dispatcher::tell(const Outcome &outcome, uint32_t event, llvm::ArrayRef<Listener> listeners) {
  for (const Listener &listener : listeners) {
    if (!finding_) {
      tellOne(outcome.events[event], listener);
      continue;
    }
    const StateUse used = std::exchange(stateUse, StateUse());
    const RuleSleep sleeps = sleepsInShape(outcome.events[event], listener);
    if (sleeps != RuleSleep::No)
      finding_->asleepUse |= stateUse;
    if (sleeps != RuleSleep::InShape)
      finding_->awake.push_back({event, listener});
    if (sleeps == RuleSleep::No)
      finding_->inRow.push_back({event, listener});
    stateUse |= used;
  }
}

void Dispatcher::tellOne(const Event &event, const Listener &listener) {
  context_.rule_ = listener.id;
  if (listener.rule)
    listener.rule->on(event, context_);
  else
    context_.reportNotices(allRules()[listener.id].info.id, event);
}

/// Tells the rule, which may have nothing to say of any such block, or of those of a row, while it
/// is known why.
RuleSleep Dispatcher::sleepsInShape(const Event &event, const Listener &listener) {
  const uint64_t reports = context_.collector_.reports();
  ruleSleep = RuleSleep::No;
  context_.startNotes();
  tellOne(event, listener);
  const RuleSleep said = std::exchange(ruleSleep, RuleSleep::No);
  if (reports != context_.collector_.reports() || !coversModes(stateUse))
    return RuleSleep::No;
  if (said == RuleSleep::InRow)
    return said;
  const bool sleeps =
      said == RuleSleep::InShape || (said == RuleSleep::AtBlock && findingPlace_) ||
      (!listener.rule && !asksNumbers(context_.code(event), allRules()[listener.id].info.id));
  return sleeps ? RuleSleep::InShape : RuleSleep::No;
}

/// A later block of a modal cycle may give variables anew that the cycle reads: what the table says
/// of the cycle is asked again.
void Dispatcher::reportChanged(const Event &event) {
  if (event.code == noCode || !context_.block().has(variableAddress) || context_.codeWord(event))
    return;
  Event changed = event;
  changed.word = nullptr;
  for (const RuleId id : noticesOf_[event.code]) {
    context_.rule_ = id;
    context_.reportNotices(allRules()[id].info.id, changed);
  }
}

void Dispatcher::dispatchMove(const ToldBlock &told, uint64_t stretch) {
  const Outcome &outcome = told.outcome;
  if (stretch != stretch_) {
    stretch_ = stretch;
    wake(outcome);
  }
  // Where that is another, they would be awake.
  stateUse |= asleepUse_;
  const bool still = !atStill_.empty() && told.before.position == told.after.position;
  if (awake_.empty() && !still)
    return;
  prepare(told);
  ruleSleep = RuleSleep::No;
  const size_t known = atStill_.size();
  for (size_t i = 0; i < awake_.size();) {
    const auto &[event, listener] = awake_[i];
    context_.rule_ = listener.id;
    context_.startNotes();
    const StateUse used = std::exchange(stateUse, StateUse());
    listener.rule->on(outcome.events[event], context_);
    const RuleSleep said = std::exchange(ruleSleep, RuleSleep::No);
    if (said == RuleSleep::InStretch || said == RuleSleep::InShape ||
        said == RuleSleep::WhileMoving) {
      if (said == RuleSleep::WhileMoving)
        atStill_.push_back(awake_[i]);
      asleepUse_ |= stateUse;
      awake_.erase(awake_.begin() + ptrdiff_t(i));
    } else {
      ++i;
    }
    stateUse |= used;
  }
  for (size_t i = 0; still && i < known; ++i) // (who fell asleep at this move has been told of it)
    tellOne(outcome.events[atStill_[i].event], atStill_[i].listener);
}

/// All who want to know of every move are told of the events of this one.
void Dispatcher::wake(const Outcome &outcome) {
  awake_.clear();
  atStill_.clear();
  asleepUse_ = {};
  for (uint32_t i = 0; i < outcome.events.size(); ++i)
    for (const auto &[kind, listener] : everyBlock_)
      if (kind == outcome.events[i].kind && listener.wants(outcome.events[i]))
        awake_.push_back({i, listener});
}

void Dispatcher::flowIssue(FlowIssue issue, const ToldBlock &told, SourceRange where,
                           SourceRange related) {
  prepare(told);
  context_.flowRange_ = where;
  context_.flowRelated_ = related;
  Event event;
  event.kind = EventKind::FlowIssue;
  event.setFlowIssue(issue);
  for (const Listener &listener : byKind_[size_t(EventKind::FlowIssue)]) {
    context_.rule_ = listener.id;
    listener.rule->on(event, context_);
  }
}

void Dispatcher::callReturned(const ToldBlock &told) {
  prepare(told);
  Event event;
  event.kind = EventKind::CallReturned;
  event.code = told.outcome.flow.code;
  for (const Listener &listener : byKind_[size_t(EventKind::CallReturned)]) {
    context_.rule_ = listener.id;
    listener.rule->on(event, context_);
  }
}

void Dispatcher::finish(const FileSummary &summary, FileUnit &unit) {
  static const Block noBlock;
  const Outcome noOutcome;
  const MachineState state = initialState(*unit.dialect);
  prepare({unit, noBlock, noOutcome, state, state, nullptr});
  for (const Listener &listener : all_) {
    context_.rule_ = listener.id;
    listener.rule->finish(summary, context_);
  }
}

} // namespace ncvet
