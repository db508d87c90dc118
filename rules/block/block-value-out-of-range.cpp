// A value outside of what its code takes.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/word_checks.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "formats/text/number_text.h"
#include "interp/evaluate/expression.h"

#include "llvm/ADT/StringExtras.h"

#include <cmath>
#include <map>

namespace ncvet {
namespace {

bool isRangeOfBlock(const CodeInfo &code, const WordSpec &spec) {
  return spec.hasRange && topicOf(code, spec) == WordTopic::Block;
}

struct BlockValueOutOfRangeMemory {
  using Limit = std::pair<double, SourceRange>;
  std::map<uint32_t, Limit> lower; ///< by group and axis
  std::map<uint32_t, Limit> upper; ///< likewise
};

class BlockValueOutOfRange final : public StatefulRule<BlockValueOutOfRangeMemory> {
public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    constexpr AddressMask told = lettersMask("FSTDH"); // by events of their own
    for (size_t i = 0; i < to.dialect().addresses.size(); ++i) {
      const AddressInfo &address = to.dialect().addresses[i];
      if (!std::isfinite(address.least) && !std::isfinite(address.most))
        continue;
      ranged_ = true;
      others_ |= maskOf(AddressId(i)) & ~told;
    }
    to.on({EventKind::WordIssue, EventKind::Syntax});
    textLength_ = to.dialect().facts->limits.textLength;
    modeGroups_ = to.dialect().facts->limits.modeGroups;
    if (textLength_)
      to.on(EventKind::Statement);
    if (modeGroups_)
      to.onChange({EventKind::Block});
    digits_ = to.dialect().facts->limits.lengthDigits;
    leastAlarm_ = to.dialect().facts->limits.leastAlarm;
    greatestAlarm_ = to.dialect().facts->limits.greatestAlarm;
    if (greatestAlarm_ > 0)
      to.on(EventKind::Assignment);
    if (ranged_)
      to.on(
          {EventKind::ToolWord, EventKind::OffsetWord, EventKind::SpeedWord, EventKind::FeedWord});
    to.onCode([&](const CodeInfo &code) {
      return isZone(code, to.dialect()) || !code.excludes.empty() ||
             llvm::any_of(code.words,
                          [&](const WordSpec &spec) { return isRangeOfBlock(code, spec); }) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Syntax) {
      if (digits_)
        tooLong(ctx.block().issues[event.issue()], ctx);
      return skipInside(ctx.block().issues[event.issue()], ctx);
    }
    if (event.kind == EventKind::WordIssue) {
      if (!ctx.block().hasAny(others_) && event.wordIssue() != WordIssue::SkipLevel)
        return sleepInShape();
      ofAddresses(event, ctx);
      return skipLevel(event, ctx);
    }
    if (event.kind == EventKind::Assignment)
      return alarm(event, ctx);
    if (event.kind == EventKind::Statement) {
      sleepAtBlock();
      return tooLongText(ctx.block().items[event.item()], ctx);
    }
    if (event.kind == EventKind::Block)
      return ofWords(ctx);
    if (event.kind != EventKind::Code)
      return ofAddress(event, ctx);
    if (ctx.code(event).action == Action::Reset) { // the limits of the machine hold again
      memory().lower.clear();
      memory().upper.clear();
    }
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    const AddressMask whole = ctx.dialect().whole;
    reportWordRanges(ctx, event, [&](const CodeInfo &c, const WordSpec &spec, Breach breach) {
      // Points in whole numbers are syntax-integer-required's.
      return isRangeOfBlock(c, spec) && breach != Breach::PointMissing &&
             breach != Breach::PointWritten && !(breach == Breach::NotWhole && spec.any & whole);
    });
    if (code.action != Action::Cycle)
      reportExcludedWords(ctx, event);
    if (code.action == Action::ZoneOn)
      zone(ctx);
    if (isZone(code, ctx.dialect()))
      side(event, ctx);
    else if (isByShape(code, ctx.block()))
      sleepInShape();
  }

private:
  unsigned digits_ = 0; ///< most digits of a length in least increments; 0: any

  /// `X123456.7891`: a word that is read, and has too many digits.
  void tooLong(const SyntaxIssue &issue, RuleContext &ctx) const {
    if (issue.kind != SyntaxIssueKind::MalformedNumber)
      return;
    for (const Word &word : ctx.block().words) {
      if (word.offset != issue.begin || !word.isNumber() || word.has(wordMalformed) ||
          ctx.block().endOf(word) != issue.end ||
          size_t(llvm::count_if(ctx.text(word), llvm::isDigit)) <= digits_)
        continue;
      if (auto finding = ctx.report(word))
        finding.message("`{0}` has more than {1} digits in least increments: the control stops "
                        "with an alarm",
                        ctx.text(word), digits_);
    }
  }

  unsigned textLength_ = 0, modeGroups_ = 0; ///< see `LimitFacts`

  /// A text in quotation marks.
  void tooLongText(const Item &item, RuleContext &ctx) const {
    for (const Argument &argument : ctx.block().argumentsOf(item)) {
      if (argument.kind != ArgumentKind::Text || argument.end - argument.begin <= textLength_)
        continue;
      if (auto finding = ctx.report(ctx.range(argument)))
        finding.severity(Severity::Warning)
            .message("a text of {0} characters: the control takes {1}",
                     argument.end - argument.begin, textLength_);
    }
  }

  /// `X=DC(10)` of an axis that does not turn, and `G[70]=1`.
  void ofWords(RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    if (ctx.block().expressions.empty())
      return sleepInShape();
    for (const Word &word : ctx.block().words) {
      if (!word.has(wordExpression))
        continue;
      const AddressInfo &address = dialect.addresses[word.address];
      const bool turns = word.reading() == WordReading::RotaryShortest ||
                         word.reading() == WordReading::RotaryPositive ||
                         word.reading() == WordReading::RotaryNegative;
      if (turns && address.kind == AddressKind::Axis && address.axis <= Axis::Z) {
        if (auto finding = ctx.report(word))
          finding.severity(Severity::Warning)
              .message("`{0}`: {1} is a linear axis, and this is the way of one that turns",
                       ctx.text(word), ctx.text(word).take_front());
      } else if (word.address == letterAddress('G')) {
        groupOf(word, ctx);
      }
    }
  }

  void groupOf(const Word &word, RuleContext &ctx) const {
    const auto [inside, rest] = ctx.text(word).drop_front().ltrim().split(']');
    int64_t number = 0;
    if (!inside.startswith("[") || inside.drop_front().trim().getAsInteger(10, number) ||
        (number >= 1 && number <= int64_t(modeGroups_)))
      return;
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Warning)
          .message("`{0}`: the groups of G functions are numbered 1 to {1}", ctx.text(word),
                   modeGroups_);
  }

  double leastAlarm_ = 0, greatestAlarm_ = 0; ///< of the numbers that `#3000` takes

  /// `#3000=5000`: the number of an alarm.
  void alarm(const Event &event, RuleContext &ctx) const {
    constexpr int64_t alarms = 3000;
    if (event.variable() != alarms)
      return;
    for (const Item &item : ctx.block().items) {
      if (item.kind != ItemKind::Assignment || item.value == noExpression ||
          int64_t(ctx.block().keyOf(item.target)) != alarms)
        continue;
      const Value value = evaluate(ctx.block(), item.value, ctx.before(), nullptr);
      if (!value.isConstant() ||
          (value.number.value() >= leastAlarm_ && value.number.value() <= greatestAlarm_))
        return;
      const SourceRange range = ctx.range(item);
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message("`{0}`: the number of an alarm is from {1} to {2}", ctx.text(range),
                     shortNumber(leastAlarm_), shortNumber(greatestAlarm_));
      return;
    }
  }

  /// Whether no number of the block decides what is said of the code.
  static bool isByShape(const CodeInfo &code, const Block &block) {
    return code.action != Action::Reset && !asksNumbers(code, id) &&
           llvm::none_of(code.words, [&](const WordSpec &spec) {
             return spec.hasRange && wordFor(block, spec);
           });
  }

  /// A code that limits where the tool may be, or how fast the spindle turns.
  static bool isZone(const CodeInfo &code, const Dialect &dialect) {
    return code.action == Action::ZoneOn ||
           (code.base != noCode && dialect.codes[code.base].action == Action::ZoneOn);
  }

  /// Words that no event tells of.
  void ofAddresses(const Event &event, RuleContext &ctx) const {
    const Block &block = ctx.block();
    if ((event.wordIssue() != WordIssue::Special && event.wordIssue() != WordIssue::NumberInside) ||
        !block.hasAny(others_) || ctx.find({Action::MacroCall, Action::MacroModal}))
      return;
    const AddressMask of = event.wordIssue() == WordIssue::Special ? ~maskOf('N') : maskOf('N');
    for (const Word &word : block.words)
      if (others_ & of & maskOf(word.address) && !word.has(wordNoValue))
        outside(word, ctx.value(word), ctx);
  }

  static void ofAddress(const Event &event, RuleContext &ctx) {
    // A time that is turned round has no greatest value: short moves take little of it.
    if (event.kind == EventKind::FeedWord && event.wordValue().lo > 0 &&
        ctx.after().activeAction(ctx.dialect(), StandardGroup::FeedMode) == Action::FeedInverseTime)
      return;
    // `F0` in a block that moves nothing: the alarm comes with a move, which may have its own.
    const bool idle = event.kind == EventKind::FeedWord && event.wordValue().isConstant() &&
                      event.wordValue().value() == 0 && !ctx.find({Action::Dwell}) &&
                      (!ctx.block().hasAny(ctx.dialect().axisWords) || ctx.find({Action::Rapid}));
    outside(*event.word, event.wordValue(), ctx,
            idle ? std::optional(Severity::Style) : std::nullopt);
  }

  /// What the address takes whatever is beside it.
  static void outside(const Word &word, const Interval &value, RuleContext &ctx,
                      std::optional<Severity> severity = std::nullopt) {
    const AddressInfo &address = ctx.dialect().addresses[word.address];
    if (!(value.hi < address.least) && !(value.lo > address.most))
      return;
    constexpr double nothing = 1e-5; // the least that is not zero
    const auto bound = [](double number) { return formatted("{0}", llvm::format("%.9g", number)); };
    const std::string range =
        value.hi < address.least && address.least > 0 && address.least < nothing ? "above 0"
        : !std::isfinite(address.least) ? "at most " + bound(address.most)
        : !std::isfinite(address.most)
            ? "at least " + bound(address.least)
            : "from " + bound(std::fabs(address.least) < nothing ? 0 : address.least) + " to " +
                  bound(address.most);
    if (auto finding = ctx.report(word))
      finding.severity(severity).message("{0} ({1}) is not {2}", withValue(ctx, word, value),
                                         address.title, range);
  }

  static void skipInside(const SyntaxIssue &issue, RuleContext &ctx) {
    if (issue.kind != SyntaxIssueKind::SkipInside)
      return;
    const SourceRange range = ctx.range(issue);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` comes after the block number: a block skip is the first of its block",
                      ctx.text(range));
  }

  static void skipLevel(const Event &event, RuleContext &ctx) {
    if (event.wordIssue() != WordIssue::SkipLevel)
      return;
    const Block &block = ctx.block();
    const llvm::StringRef text = ctx.source().text(block.begin, block.end).ltrim();
    const auto begin = uint32_t(text.data() - ctx.source().text().data());
    const auto length = uint32_t(text.drop_front().take_while(llvm::isDigit).size() + 1);
    if (auto finding = ctx.report(SourceRange{ctx.source().id(), begin, begin + length}))
      finding.message("`/{0}` is no level of block skip: the control has / to /{1}",
                      int(block.skip), int(ctx.dialect().lexical.skipLevels));
  }

  /// Where two codes of a group give the lower and the upper limits: the last lower ones.
  void side(const Event &event, RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    const CodeInfo &code = ctx.code(event);
    if (code.group == noGroup)
      return;
    llvm::SmallVector<CodeIndex, 2> sides;
    for (const CodeIndex member : dialect.groups[code.group].members)
      if (dialect.codes[member].action == Action::ZoneOn)
        sides.push_back(member);
    if (sides.size() != 2)
      return;
    const bool upper = code.base == sides[1];
    std::map<uint32_t, Memory::Limit> &own = upper ? memory().upper : memory().lower;
    // The code by itself takes back what it narrowed, an axis without a value this axis'.
    if (!axesOf(dialect, ctx.block()) && !ctx.block().has(letterAddress('S')))
      std::erase_if(own, [&](const auto &limit) { return limit.first >> 8 == code.group; });
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = dialect.addresses[word.address];
      const Interval value = ctx.value(word);
      const uint32_t key = uint32_t(code.group) << 8 | uint32_t(address.axis);
      const bool limited = address.kind == AddressKind::Axis || word.address == letterAddress('S');
      if (limited && (!value.isConstant() || word.has(wordNoValue)))
        own.erase(key);
      if (!limited || !value.isConstant() || word.has(wordNoValue))
        continue;
      if (!upper) {
        memory().lower[key] = {value.value(), ctx.range(word)};
        if (const auto high = memory().upper.find(key); high != memory().upper.end())
          above(word, value.value(), high->second, code, sides[1], ctx);
        continue;
      }
      memory().upper[key] = {value.value(), ctx.range(word)};
      const auto low = memory().lower.find(key);
      if (low == memory().lower.end() || value.value() >= low->second.first)
        continue;
      if (auto finding = ctx.report(word))
        finding
            .message("`{0}` of `{1}` lies below the lower limit: nothing is left between the two",
                     ctx.text(word), code.name)
            .note(low->second.second, "the lower limit");
    }
  }

  /// A lower limit after the upper one, unless the next block gives that anew.
  static void above(const Word &word, double value, const Memory::Limit &upper,
                    const CodeInfo &code, CodeIndex upperCode, RuleContext &ctx) {
    BlocksAhead ahead(ctx);
    Block next;
    if (value <= upper.first ||
        (ahead.next(next) && llvm::is_contained(codesOf(ctx.dialect(), next), upperCode) &&
         next.has(word.address)))
      return;
    if (auto finding = ctx.report(word))
      finding
          .message("`{0}` of `{1}` lies above the upper limit: nothing is left between the two",
                   ctx.text(word), code.name)
          .note(upper.second, "the upper limit");
  }

  bool ranged_ = false;
  AddressMask others_ = 0; ///< addresses with bounds that have no event of their own
  static constexpr llvm::StringLiteral id{"block-value-out-of-range"};

  /// The limits of a working-space zone: X Y Z are the upper ones, I J K the lower ones.
  static void zone(RuleContext &ctx) {
    const Word *side = ctx.block().find('P');
    const Interval inside = side ? ctx.value(*side) : Interval::unknown();
    const struct {
      char upper, lower;
      Axis axis;
    } pairs[] = {{'X', 'I', Axis::X}, {'Y', 'J', Axis::Y}, {'Z', 'K', Axis::Z}};
    const Word *first = nullptr, *opposite = nullptr; // the first limits that are equal
    bool empty = true;                                // all of them are
    for (const auto &pair : pairs) {
      const Word *upper = ctx.block().find(pair.upper), *lower = ctx.block().find(pair.lower);
      if (!upper || !lower) {
        empty &= ctx.dialect().isLathe() && pair.axis == Axis::Y && !upper && !lower;
        continue;
      }
      const Interval high = ctx.value(*upper), low = ctx.value(*lower);
      empty &= high.isConstant() && low.isConstant() && high.value() == low.value();
      if (high.isUnknown() || low.isUnknown())
        continue;
      if (high.hi < low.lo) {
        if (auto finding = ctx.report(*upper))
          finding
              .message("`{0}` lies below `{1}`: the upper limit of the zone is smaller than the "
                       "lower one",
                       ctx.text(*upper), ctx.text(*lower))
              .note(ctx.range(*lower), "the lower limit");
      }
      if (!first) {
        first = upper;
        opposite = lower;
      }
    }
    const bool forbidsAll = inside.isConstant() && inside.value() == 1;
    const bool allowsAll = inside.isConstant() && inside.value() == 0;
    // One pair of equal limits alone may be an axis that the machine has not.
    if (!empty || !first || (!forbidsAll && !allowsAll))
      return;
    if (auto finding = ctx.report(*first))
      finding
          .message(forbidsAll ? "all limits are equal, as `{0}` and `{1}`: the zone is empty and "
                                "every place is forbidden"
                              : "all limits are equal, as `{0}` and `{1}`: the zone is empty and "
                                "forbids nothing",
                   ctx.text(*first), ctx.text(*opposite))
          .severity(forbidsAll ? Severity::Error : Severity::Style);
  }
};

} // namespace
NCVET_RULE(BlockValueOutOfRange, block_value_out_of_range)
} // namespace ncvet
