// Slots or holes of one call run into each other, an island lies outside of its pocket.
#include "analyzer/defined_elements.h"
#include "analyzer/lookahead.h"
#include "analyzer/outline.h"
#include "interp/arc.h"
#include "interp/expression.h"

#include "llvm/ADT/StringExtras.h"

#include <cmath>
#include <map>

namespace ncvet {
namespace {

/// What lies nearer to a circle than this lies on it, millimetres.
constexpr double least = 0.01;

class CycleFeaturesOverlap final : public Rule {
  using Point = Outline::Point;

public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    for (const CodeInfo &code : to.dialect().codes)
      pockets_ |= isClosed(code);
    if (!pockets_)
      return;
    to.onAction({Action::ProfileBegin, Action::ProfileRun, Action::DefineElement});
    to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Motion)
      return element(event, ctx);
    ctx.reportNotices(id, event);
    if (!pockets_)
      return;
    const Action action = ctx.code(event).action;
    if (action == Action::DefineElement)
      define(ctx);
    else if (action == Action::ProfileBegin || action == Action::ProfileRun)
      next(event, ctx);
  }
  void remember(RuleMemory &memory) const override {
    memory(profiles_, begin_, pocketBegin_, attach_, pocket_, current_, points_, circles_,
           startName_, circle_);
  }

private:
  /// A profile that encloses something has a point from which the tool comes.
  static bool isClosed(const CodeInfo &code) {
    return code.action == Action::ProfileBegin &&
           llvm::any_of(code.words, [](const WordSpec &w) { return w.role == Role::Target; });
  }

  /// The profile before is complete; another one begins, or all of them are run.
  void next(const Event &event, RuleContext &ctx) {
    if (profiles_ == 1)
      pocket_ = current_;
    else if (profiles_ > 1)
      island(ctx);
    const bool begins = isClosed(ctx.code(event));
    profiles_ = begins ? profiles_ + 1 : 0;
    if (profiles_ == 1)
      pocketBegin_ = ctx.range(*event.word);
    current_.clear();
    circle_.reset();
    startName_.reset();
    begin_ = ctx.range(*event.word);
    attach_ = begins ? attachPoint(ctx.code(event), ctx) : std::nullopt;
  }

  void island(RuleContext &ctx) const {
    if (!pocket_.isClosed())
      return;
    const bool attach = attach_ && pocket_.excludes(*attach_);
    const bool contour = current_.isClosed() && pocket_.excludes(current_.first());
    if (!attach && !contour)
      return;
    if (auto finding = ctx.report(begin_))
      finding
          .message(attach ? "the attach point of this island lies outside of the pocket"
                          : "this island lies outside of the pocket")
          .note(pocketBegin_, "the outline of the pocket");
  }

  /// The first two variables of the code: its place in the plane.
  static std::optional<Point> attachPoint(const CodeInfo &code, const RuleContext &ctx) {
    Point place;
    size_t found = 0;
    for (const WordSpec &spec : code.words)
      if (spec.variable && found < 2) {
        const Value value = readVariable(ctx.after(), int64_t(givenVariable(spec, ctx.after())));
        const auto unit = millimetresPer(ctx.dialect(), ctx.after());
        if (!value.isConstant() || !unit)
          return std::nullopt;
        place[found++] = value.number.value() * *unit;
      }
    return found == 2 ? std::optional(place) : std::nullopt;
  }

  /// A piece of the profile that is being recorded.
  void element(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (!profiles_ || before.profile != 1 || ctx.find({Action::CompensationOff}))
      return;
    if (ctx.block().hasAny(ctx.dialect().cornerWords | ctx.dialect().lineAngleWords) ||
        !event.certain || before.may(Fact::UnknownCode))
      return current_.loseTrack();
    const bool attaches = before.compensation == phaseOff && after.compensation != phaseOff;
    if (const Word *name = ctx.block().findAny(ctx.dialect().elementWords))
      return named(*name, attaches);
    const std::array<Axis, 2> axes = planeOrder(ctx.dialect(), after);
    Point to;
    for (size_t i = 0; i < 2; ++i) {
      const Interval &at = after.at(axes[i]);
      if (!at.isConstant() || after.inMachineCoordinates(axes[i]))
        return current_.loseTrack();
      to[i] = at.value() / ctx.dialect().lengthsPerUnit(axes[i]);
    }
    if (attaches)
      return current_.start(to);
    if (event.motion != MotionKind::ArcCw && event.motion != MotionKind::ArcCcw)
      return event.motion == MotionKind::Feed ? current_.line(to) : current_.loseTrack();
    const ArcGeometry arc = arcGeometry(arcWords(ctx.dialect(), after, ctx.block()), ctx.dialect(),
                                        ctx.machine(), ctx.block(), before, after);
    const auto centre =
        arc.radius && arc.start && arc.end
            ? centreByRadius(*arc.start, *arc.end, *arc.radius, event.motion == MotionKind::ArcCw)
            : arc.centre();
    if (!centre)
      return current_.loseTrack();
    current_.arc(*centre, to, event.motion == MotionKind::ArcCw);
  }

  struct Circle {
    Point centre;
    double radius;
  };

  /// The words of `O5 = G2 I0 J0 R250`, by letter; empty when one of them is no plain number.
  static std::map<char, double> wordsOf(llvm::StringRef definition) {
    std::map<char, double> words;
    llvm::StringRef rest = definition.split('=').second.split('\'').first.trim();
    while (!rest.empty()) {
      const char letter = llvm::toUpper(rest.front());
      const llvm::StringRef number = rest.drop_front().ltrim().take_while(
          [](char c) { return llvm::isDigit(c) || c == '.' || c == '-' || c == '+'; });
      double value = 0;
      if (!llvm::isAlpha(letter) || number.getAsDouble(value) ||
          !words.try_emplace(letter, value).second)
        return {};
      rest = llvm::StringRef(number.end(), size_t(definition.end() - number.end()))
                 .split('\'')
                 .first.trim();
    }
    return words;
  }

  /// Points and circles by their coordinates; others are not followed.
  void define(const RuleContext &ctx) {
    const Word *name = DefinedElements::definedBy(ctx);
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    if (!name || !unit)
      return;
    const auto key = std::pair(name->address, name->mantissa);
    points_.erase(key);
    circles_.erase(key);
    const std::map<char, double> words = wordsOf(ctx.text(ctx.blockRange()));
    const auto has = [&](llvm::StringRef letters) {
      return words.size() == letters.size() &&
             llvm::all_of(letters, [&](char letter) { return words.count(letter); });
    };
    if (has("GIJR"))
      circles_[key] = {{words.at('I') * *unit, words.at('J') * *unit},
                       std::fabs(words.at('R')) * *unit};
    else if (has("XY"))
      points_[key] = {words.at('X') * *unit, words.at('Y') * *unit};
  }

  /// Of elements by name only a circle between one point and the same is followed.
  void named(const Word &name, bool attaches) {
    const auto key = std::pair(name.address, name.mantissa);
    const auto point = points_.find(key);
    const auto circle = circles_.find(key);
    if (attaches && point != points_.end()) {
      startName_ = key;
      return current_.start(point->second);
    }
    if (circle != circles_.end() && startName_ && !circle_ && current_.hasStart()) {
      circle_ = circle->second;
      return;
    }
    const bool closes = circle_ && startName_ == key && current_.hasStart();
    if (!closes || std::fabs(std::hypot(current_.first()[0] - circle_->centre[0],
                                        current_.first()[1] - circle_->centre[1]) -
                             circle_->radius) > least)
      return current_.loseTrack();
    current_.arc(circle_->centre, current_.first(), false);
  }

  static constexpr llvm::StringLiteral id{"cycle-features-overlap"};
  bool pockets_ = false;  ///< the control has pockets with islands
  unsigned profiles_ = 0; ///< profiles of the pocket so far; the first one is its outline
  SourceRange begin_, pocketBegin_;
  std::optional<Point> attach_;
  Outline pocket_, current_;
  using Name = std::pair<AddressId, int64_t>;
  std::map<Name, Point> points_;
  std::map<Name, Circle> circles_;
  std::optional<Name> startName_;
  std::optional<Circle> circle_; ///< of the profile at hand
};

} // namespace
NCVET_RULE(CycleFeaturesOverlap, cycle_features_overlap)
} // namespace ncvet
