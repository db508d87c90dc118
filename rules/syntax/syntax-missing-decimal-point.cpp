// A length, angle or feed without a decimal point on a control that may scale such a value.
#include "analyzer/program/project.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct SyntaxMissingDecimalPointMemory {
  std::vector<SourceRange> places; ///< lengths without a point, the first ones of the file
  std::vector<SourceRange> others; ///< further words without one that have it where lengths do
  bool inch = false;               ///< the file has lengths in inches
  bool metric = false;             ///< it says that it has some in millimetres
};

class SyntaxMissingDecimalPoint final : public StatefulRule<SyntaxMissingDecimalPointMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().pointAdvised)
      to.on(EventKind::WordIssue);
    if (!to.dialect().facts->text.pointsThroughout)
      return;
    lengths_ = maskOf('I') | maskOf('J') | maskOf('R');
    for (size_t i = 0; i < to.dialect().addresses.size(); ++i)
      if (const AddressInfo &address = to.dialect().addresses[i];
          address.axis <= Axis::Z || address.axis >= Axis::U)
        if (address.kind == AddressKind::Axis || address.kind == AddressKind::Increment)
          lengths_ |= maskOf(AddressId(i));
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.wordIssue() != WordIssue::NoPoint)
      return sleepInShape();
    // Of a file that is called the check of that file counts the points.
    if (lengths_ && !isOfCheckedFile(ctx))
      return;
    // With this setting the control reads whole numbers as they are meant.
    if (const auto reading = ctx.machine().option("decimalPoint");
        reading && *reading == "calculator")
      return;
    memory().inch |=
        ctx.after().isActive(ctx.dialect(), StandardGroup::Units, {Action::Inch}) == Truth::Yes;
    memory().metric |= ctx.after().originOf(ctx.dialect(), StandardGroup::Units).known();
    if (lengths_)
      collect(ctx);
    for (const Word &word : ctx.block().words) {
      // `Q3000`: counted in the least increment on purpose.
      const bool increments =
          word.address == letterAddress('Q') && word.mantissa >= leastIncrements;
      const bool pointless = isPointless(word) && !increments;
      if (!pointless || (lengths_ & maskOf(word.address)) ||
          !(ctx.dialect().pointAdvised & maskOf(word.address)) || !advised(word.address, ctx))
        continue;
      if (!lengths_)
        tell(ctx.range(word), ctx);
      else if (std::vector<SourceRange> &others = memory().others;
               others.size() < enough && !llvm::is_contained(others, ctx.range(word)))
        others.push_back(ctx.range(word));
    }
  }

  /// Most whole lengths of the file have a point: those that have none are read as thousandths
  /// where the control counts whole numbers so, or the others are.
  void finish(const FileSummary &file, RuleContext &ctx) const override {
    const std::vector<SourceRange> &places = memory().places;
    if (places.empty() && memory().others.empty())
      return;
    size_t with = 0, without = 0;
    file.index.eachPiece([&](const TextPiece &piece) {
      for (const TextPiece::Points &points : piece.points)
        if (lengths_ & maskOf(points.address)) {
          with += points.with; // (`X10.5` needs its point in any case)
          without += points.without;
        }
    });
    // Without any points the control counts whole numbers as they are.
    if (without < with || !without)
      for (const SourceRange &place : memory().others)
        tell(place, ctx);
    if (without > with)
      return;
    constexpr size_t most = 10; // told block by block
    for (size_t i = 0, next = 0; i < places.size(); i = next) {
      for (next = i + 1; next < places.size() && areOfOneBlock(places[i], places[next], ctx);)
        ++next;
      auto finding = ctx.report(places[i]);
      if (!finding)
        continue;
      const llvm::StringRef word = ctx.text(places[i]);
      if (places.size() > most)
        finding.message("`{0}` and {1} further lengths have no decimal point, and {2} of this file "
                        "have one: by parameter the control reads these as {3}",
                        word, without - 1, with, parts());
      else if (next == i + 1)
        finding.message("`{0}` has no decimal point, and other lengths of this file have one: by "
                        "parameter the control reads it as {1}",
                        word, parts());
      else
        finding.message("`{0}` and `{1}` have no decimal point, and other lengths of this file "
                        "have one: by parameter the control reads them as {2}",
                        word, ctx.text(places[next - 1]), parts());
      finding.severity(Severity::Warning)
          .fix(FixSafety::Unsafe, "add the decimal point", ctx.insertBefore(places[i].end, "."));
      for (size_t other = i + 1; other < next; ++other)
        finding.edit(ctx.insertBefore(places[other].end, "."));
      if (places.size() > most)
        return;
    }
  }

private:
  static constexpr int64_t leastIncrements = 100; ///< of a depth that is meant so
  static constexpr size_t enough = 20;            ///< that many are kept

  static bool isOfCheckedFile(const RuleContext &ctx) {
    const CallSite *first = ctx.caller();
    while (first && first->before)
      first = first->before;
    return !first || !first->unit || first->unit->source.id() == ctx.source().id();
  }

  /// The first speaks for the others of its block.
  static bool areOfOneBlock(const SourceRange &first, const SourceRange &other,
                            const RuleContext &ctx) {
    return first.begin < other.begin && !ctx.source().text(first.begin, other.begin).contains('\n');
  }

  /// What a number without a point counts.
  const char *parts() const {
    return memory().inch     ? "ten-thousandths"
           : memory().metric ? "thousandths"
                             : "its least increments (0.001 mm or 0.0001 inch)";
  }

  void tell(const SourceRange &place, RuleContext &ctx) const {
    const llvm::StringRef word = ctx.text(place);
    const llvm::StringRef number = word.drop_front().ltrim("+-=0 ");
    // What is meant so is read otherwise by a control that counts whole units.
    const bool meant = number.size() > 3 && !word.startswith_insensitive("F") &&
                       (memory().inch || memory().metric);
    if (auto finding = ctx.report(place))
      finding
          .message("`{0}` has no decimal point: the control may read it as {1} {2}{3}", word,
                   number, memory().inch || memory().metric ? "" : "of ",
                   meant ? memory().inch ? "inches" : "mm" : parts())
          .fix(FixSafety::Unsafe, "add the decimal point", ctx.insertBefore(place.end, "."));
  }

  AddressMask lengths_ = 0; ///< of which a program has the point throughout; 0: not asked

  static bool isPointless(const Word &word) {
    return word.isNumber() && !word.has(wordPoint) && word.mantissa;
  }

  /// Keeps the lengths of the block that have no point.
  void collect(RuleContext &ctx) const {
    std::vector<SourceRange> &places = memory().places;
    if (places.size() >= enough || ctx.before().switches.areOn(ctx.dialect().dataSwitches) ||
        (ctx.outcome().kinds & bitOf(EventKind::UnknownCode)))
      return;
    if (ctx.find({Action::MacroCall, Action::MacroModal}))
      return arguments(ctx);
    for (const CodeUse &use : ctx.codes()) {
      const CodeInfo &code = ctx.code(use);
      // What is no motion may take numbers of its own.
      if (code.action == Action::DataInput || code.action == Action::MachineSpecific ||
          code.action == Action::Dwell || code.action == Action::PathMode ||
          code.action == Action::CallProgram || code.action == Action::None ||
          code.action == Action::ScalingOn || code.action == Action::CallLocal ||
          (code.action == Action::Cycle && code.group == noGroup) ||
          (code.letter == 'M' && takesLength(code, ctx.block())))
        return;
    }
    for (const Word &word : ctx.block().words)
      if (lengths_ & maskOf(word.address) && isPointless(word) && !isNoLength(word.address, ctx) &&
          !llvm::is_contained(places, ctx.range(word)))
        places.push_back(ctx.range(word));
  }

  /// `G84 J4`: the code that takes the word says that it is none.
  static bool isNoLength(AddressId address, const RuleContext &ctx) {
    return llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      return llvm::any_of(ctx.code(use).words, [&](const WordSpec &spec) {
        return (spec.any & maskOf(address)) && spec.pointAdvised && !*spec.pointAdvised;
      });
    });
  }

  /// A code of the machine, such as the angle of an oriented stop, counts in units of its own.
  bool takesLength(const CodeInfo &code, const Block &block) const {
    return block.hasAny(code.takes & lengths_) ||
           llvm::any_of(code.words, [&](const WordSpec &word) { return word.any & lengths_; });
  }

  /// Arguments of a macro, some of which have a point.
  static void arguments(RuleContext &ctx) {
    AddressMask lengths = 0;
    for (const char letter : llvm::StringRef("XYZUVWIJKR"))
      lengths |= maskOf(letter);
    const Block &block = ctx.block();
    if (!(block.pointed & lengths))
      return;
    for (const Word &word : block.words)
      if (lengths & maskOf(word.address) && isPointless(word))
        if (auto finding = ctx.report(word))
          finding.severity(Severity::Style)
              .message("`{0}` has no decimal point, and other arguments have one: by parameter the "
                       "control reads it as thousandths",
                       ctx.text(word));
  }

  /// What the block's codes, else the active cycle, else the address itself say.
  static bool advised(AddressId address, const RuleContext &ctx) {
    const auto says = [&](const CodeInfo &code) -> std::optional<bool> {
      for (const WordSpec &spec : code.words)
        if (spec.any & maskOf(address) && spec.pointAdvised)
          return spec.pointAdvised;
      return std::nullopt;
    };
    for (const CodeUse &use : ctx.codes())
      if (const auto said = says(ctx.code(use)))
        return *said;
    for (const StandardGroup group : {StandardGroup::Cycle, StandardGroup::Motion})
      if (const CodeInfo *active = ctx.before().activeCode(ctx.dialect(), group))
        if (const auto said = says(*active))
          return *said;
    return ctx.dialect().addresses[address].pointAdvised;
  }
};

} // namespace
NCVET_RULE(SyntaxMissingDecimalPoint, syntax_missing_decimal_point)
} // namespace ncvet
