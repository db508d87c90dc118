// Reads the word formats of the tables for rules: which required words a block lacks, and which
// words have a value that their code does not take.
#include "analyzer/facts/word_checks.h"

#include "formats/dialect/control_facts.h"
#include "formats/text/formatted.h"
#include "formats/text/number_text.h"
#include "interp/evaluate/cycle_words.h"
#include "interp/evaluate/expression.h"

#include <cmath>

namespace ncvet {

WordTopic topicOf(const CodeInfo &code, const WordSpec &spec) {
  switch (spec.role) {
  case Role::Peck:
  case Role::PeckFirst:
  case Role::PeckStep:
  case Role::PeckLeast:
    // The pecks of a groove are words of their cycle like any other.
    if (code.cycle == CycleKind::GrooveFace || code.cycle == CycleKind::GrooveRadial)
      break;
    return WordTopic::Peck;
  case Role::Lead:
    return WordTopic::Lead;
  case Role::Feed:
    // A skip move lists its feed as a part of its own format.
    return code.action == Action::SkipMove ? WordTopic::Block : WordTopic::Feed;
  case Role::Speed:
    if (code.action == Action::SurfaceSpeed || code.action == Action::ConstantSpeed)
      return WordTopic::Speed;
    break;
  case Role::Program:
  case Role::Sequence:
    if (namesTarget(code.action))
      return WordTopic::Target;
    break;
  default:
    break;
  }
  // A call that only stores the parameters of a cycle has them all the same.
  const bool stores = code.action == Action::Switch && code.cycle != CycleKind::None;
  return code.action == Action::Cycle || stores ? WordTopic::Cycle : WordTopic::Block;
}

WordTopic topicOfMissing(const CodeInfo &code, const WordSpec &spec) {
  const WordTopic topic = topicOf(code, spec);
  return topic == WordTopic::Peck && spec.variable ? WordTopic::Cycle : topic;
}

namespace {

/// `CYCLE81(110,,2,-35)`: an empty place in a list of arguments has the value that the table says.
bool isZeroByRule(const WordSpec &spec, const Event &event, const RuleContext &ctx) {
  if (!spec.position || spec.absent != 0. || !event.word)
    return false;
  return llvm::any_of(ctx.block().items, [&](const Item &item) {
    return item.kind == ItemKind::Instruction && item.begin == event.word->offset &&
           spec.position < item.arguments;
  });
}

} // namespace

llvm::SmallVector<MissingWord, 2> missingWords(const RuleContext &ctx, const Event &event) {
  llvm::SmallVector<MissingWord, 2> missing;
  const CodeInfo &code = ctx.code(event);
  for (const WordSpec &spec : code.words) {
    if (spec.need == Need::Optional || wordFor(ctx.block(), spec))
      continue;
    if (!holds(spec.when, &code, ctx.conditions()) || isZeroByRule(spec, event, ctx))
      continue;
    if (spec.need != Need::Here && givenBefore(spec, ctx.after()) != Truth::No)
      continue; // set by a block before, or who knows
    bool certain = event.certain;
    if (spec.need == Need::First && code.group != noGroup) {
      const uint64_t active = ctx.before().group(code.group);
      const uint64_t itself = uint64_t(1) << code.bit;
      if (active == itself)
        continue; // keeps the value of the block that made it active
      if ((spec.any & ctx.before().cycle.present) &&
          takesOverWords(code, ctx.dialect(), ctx.before()))
        continue; // keeps the value of the drilling code before it
      if (active & itself) {
        if (ctx.before().may(Fact::UnknownCode))
          continue;
        certain = false;
      }
    }
    missing.push_back({&spec, certain});
  }
  return missing;
}

void reportMissingWords(RuleContext &ctx, const Event &event,
                        llvm::function_ref<bool(const CodeInfo &, const WordSpec &)> mine) {
  const CodeInfo &code = ctx.code(event);
  for (const MissingWord &missing : missingWords(ctx, event)) {
    if (!mine(code, *missing.spec))
      continue;
    if (auto finding = ctx.report(event, missing.certain)) {
      const std::string words = missing.spec->any ? ctx.dialect().alternatives(missing.spec->any)
                                                  : "`" + missing.spec->name + "`";
      const char *const where = missing.spec->variable && missing.spec->need != Need::Here
                                    ? "neither its block nor one before gives it a value"
                                    : "its block has none";
      if (missing.spec->note.empty())
        finding.message("`{0}` needs {1}, and {2}", code.name, words, where);
      else
        finding.message("`{0}` needs {1} ({2}), and {3}", code.name, words, missing.spec->note,
                        where);
      finding.severity(missing.spec->severity);
    }
  }
}

std::optional<Breach> breachOf(const ValueTest &test, const Word &word,
                               const ConditionContext &context) {
  if (!breaks(test, word, context))
    return std::nullopt;
  if (word.isNumber()) {
    if (test.point == PointRule::Required && !word.has(wordPoint))
      return Breach::PointMissing;
    if (test.point == PointRule::Forbidden && word.has(wordPoint))
      return Breach::PointWritten;
  }
  const Interval value = wordValue(word, context.block, context.before);
  if (test.minExclusive ? value.hi <= test.min : value.hi < test.min)
    return Breach::TooSmall;
  if (test.maxExclusive ? value.lo >= test.max : value.lo > test.max)
    return Breach::TooLarge;
  if (test.integer && value.value() != std::floor(value.value()))
    return Breach::NotWhole;
  return Breach::NotListed;
}

namespace {

/// Whether a value breaks the bounds, however it is written.
bool isOutside(const ValueTest &test, double value) {
  return (test.minExclusive ? value <= test.min : value < test.min) ||
         (test.maxExclusive ? value >= test.max : value > test.max) ||
         (test.integer && value != std::floor(value)) ||
         (!test.oneOf.empty() && !llvm::is_contained(test.oneOf, value));
}

std::string listOf(llvm::ArrayRef<double> values) {
  std::string text;
  for (size_t i = 0; i < values.size(); ++i) {
    if (i)
      text += i + 1 == values.size() ? " or " : ", ";
    text += shortNumber(values[i]);
  }
  return text;
}

} // namespace

std::string describe(const ValueTest &test) {
  if (!test.oneOf.empty())
    return listOf(test.oneOf);
  // Built by appending: GCC 12 warns wrongly about "literal" + std::string.
  std::string bounds = test.integer ? "a whole number" : "";
  const auto add = [&](const char *text, double value) {
    if (!bounds.empty())
      bounds += ' ';
    bounds += text;
    bounds += ' ';
    bounds += shortNumber(value);
  };
  const bool low = std::isfinite(test.min), high = std::isfinite(test.max);
  if (low && high && !test.minExclusive && !test.maxExclusive) {
    add("from", test.min);
    add("to", test.max);
    return bounds;
  }
  if (low)
    add(test.minExclusive ? "greater than" : "at least", test.min);
  if (low && high)
    bounds += " and";
  if (high)
    add(test.maxExclusive ? "less than" : "at most", test.max);
  return bounds;
}

bool namesRange(const Block &block, const CodeInfo &code) {
  return llvm::any_of(code.words, [&](const WordSpec &spec) {
    return (spec.hasRange || spec.variable) && wordFor(block, spec);
  });
}

void reportWordRanges(RuleContext &ctx, const Event &event,
                      llvm::function_ref<bool(const CodeInfo &, const WordSpec &, Breach)> mine) {
  const CodeInfo &code = ctx.code(event);
  for (const WordSpec &spec : code.words) {
    const Word *const named = wordFor(ctx.block(), spec);
    if (!spec.hasRange || !named || !holds(spec.when, &code, ctx.conditions()))
      continue;
    for (const Word &word : ctx.block().words) {
      if (!(spec.any & maskOf(word.address)) && &word != named)
        continue;
      const std::optional<Breach> breach = breachOf(spec.range, word, ctx.conditions());
      if (!breach || !mine(code, spec, *breach))
        continue;
      auto finding = ctx.report(word, event.certain);
      if (!finding)
        continue;
      const std::string what =
          spec.note.empty() ? code.name : formatted("{0}, {1}", code.name, spec.note);
      if (*breach == Breach::PointMissing)
        finding.message("`{0}` ({1}) is written without a decimal point, which it needs here",
                        ctx.text(word), what);
      else if (*breach == Breach::PointWritten)
        finding.message("`{0}` ({1}) is written with a decimal point, which is not allowed here",
                        ctx.text(word), what);
      else
        finding.message("{0} ({1}) is not {2}", withValue(ctx, word, ctx.value(word)), what,
                        describe(spec.range));
      finding.severity(spec.rangeSeverity);
    }
  }
}

void KeptFaults::given(uint64_t variable, std::optional<double> wrong, const RuleContext &ctx) {
  if (wrong)
    faults_[variable] = {*wrong, {ctx.source().id(), ctx.block().begin}};
  else
    faults_.erase(variable);
}

bool KeptFaults::speaks(uint64_t variable, double value, const RuleContext &ctx) {
  const auto known = faults_.find(variable);
  if (known != faults_.end() && known->second.value == value &&
      known->second.block != TextPlace{ctx.source().id(), ctx.block().begin})
    return false;
  given(variable, value, ctx);
  return true;
}

void reportKeptRanges(RuleContext &ctx, const Event &event, KeptFaults &faults,
                      llvm::function_ref<bool(const CodeInfo &, const WordSpec &)> mine) {
  const CodeInfo &code = ctx.code(event);
  for (const WordSpec &spec : code.words) {
    if (!spec.variable || !spec.hasRange || !mine(code, spec) ||
        !holds(spec.when, &code, ctx.conditions()))
      continue;
    if (const Word *word = wordFor(ctx.block(), spec)) {
      const bool wrong = breachOf(spec.range, *word, ctx.conditions()).has_value();
      const Interval value = ctx.value(*word);
      faults.given(spec.variable,
                   wrong && value.isConstant() ? std::optional(value.value()) : std::nullopt, ctx);
      continue;
    }
    const Value kept = readVariable(ctx.before(), int64_t(spec.variable));
    if (event.kind == EventKind::CycleRun || !kept.isConstant() ||
        ctx.before().commons.given(spec.variable) != Truth::Yes)
      continue;
    const double value = kept.number.value();
    if (!isOutside(spec.range, value)) {
      faults.given(spec.variable, std::nullopt, ctx);
      continue;
    }
    if (!faults.speaks(spec.variable, value, ctx))
      continue;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("`{0}` takes {1} = {2}{3} of a block before, which is not {4}", code.name,
                   spec.name, shortNumber(value), spec.note.empty() ? "" : " (" + spec.note + ")",
                   describe(spec.range))
          .severity(spec.rangeSeverity);
  }
}

bool givesNoticedValue(const Block &block, const CodeInfo &code, llvm::StringRef rule) {
  return llvm::any_of(code.notices, [&](const Notice &notice) {
    return rule == notice.rule && notice.atVariable && assignmentOf(block, notice.atVariable);
  });
}

bool lacksAction(const RuleContext &ctx, const SyntaxIssue &issue) {
  // `WHENEVER DO`: the condition is what is missing.
  return issue.kind == SyntaxIssueKind::BadStatement &&
         !ctx.text(ctx.range(issue)).rtrim().endswith_insensitive("DO") &&
         llvm::any_of(ctx.block().items, [&](const Item &item) {
           return item.kind == ItemKind::Output && item.begin == issue.begin;
         });
}

bool namesLackedFunction(const RuleContext &ctx, const SyntaxIssue &issue) {
  if (issue.kind != SyntaxIssueKind::BadExpression)
    return false;
  const llvm::StringRef text = ctx.text(ctx.range(issue));
  const llvm::StringRef name = text.take_while(llvm::isAlpha);
  return text.drop_front(name.size()).startswith("[") &&
         llvm::any_of(ctx.dialect().facts->variables.lacksFunctions,
                      [&](llvm::StringRef one) { return name.equals_insensitive(one); });
}

std::string withValue(const RuleContext &ctx, const Word &word, const Interval &value) {
  std::string text = ("`" + ctx.text(word) + "`").str();
  if (!word.isNumber() && value.isConstant())
    text += " = " + shortNumber(value.value());
  return text;
}

void reportExcludedWords(RuleContext &ctx, const Event &event) {
  const CodeInfo &code = ctx.code(event);
  for (const auto &[first, second] : code.excludes) {
    const Word *one = ctx.block().findAny(first);
    const Word *other = ctx.block().findAny(second);
    if (!one || !other)
      continue;
    if (other->offset < one->offset)
      std::swap(one, other);
    if (auto finding = ctx.report(*other, event.certain))
      finding
          .message("`{0}` and `{1}` exclude each other in `{2}`", ctx.text(*one), ctx.text(*other),
                   code.name)
          .note(ctx.range(*one), "the first of the two");
  }
}

} // namespace ncvet
