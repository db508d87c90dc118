// Named elements of a contour as points, lines and circles of the plane.
#include "analyzer/facts/element_geometry.h"

#include "analyzer/facts/defined_elements.h"
#include "analyzer/facts/lookahead.h"
#include "interp/geometry/line.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

namespace {

constexpr double tolerance = 0.01; // mm

/// The number after an address in the words of a definition, which the reader keeps as one text;
/// none where it is missing or computed.
std::optional<double> numberOf(llvm::StringRef text, llvm::StringRef address) {
  for (size_t at = text.find_insensitive(address); at != llvm::StringRef::npos;
       at = text.find_insensitive(address, at + 1)) {
    if (at > 0 && llvm::isAlpha(text[at - 1]))
      continue;
    const llvm::StringRef rest = text.drop_front(at + address.size()).ltrim();
    const llvm::StringRef digits = rest.take_while(
        [](char c) { return llvm::isDigit(c) || c == '.' || c == '-' || c == '+'; });
    double value = 0;
    if (!digits.empty() && !digits.ltrim('+').getAsDouble(value))
      return value;
  }
  return std::nullopt;
}

/// Whether a definition has no other letters than these: more of them say something else.
bool madeOf(llvm::StringRef text, llvm::StringRef letters) {
  return llvm::all_of(
      text, [&](char c) { return !llvm::isAlpha(c) || letters.contains(llvm::toUpper(c)); });
}

/// The words of a definition, to its comment.
llvm::StringRef definitionText(const Word &word, const RuleContext &ctx) {
  const llvm::StringRef text = ctx.text(word).split('=').second;
  return text.take_until([](char c) { return c == '\'' || c == '{' || c == '('; });
}

/// Distance of a point from a line, in millimetres.
double distanceFrom(const ElementGeometry &line, double x, double y) {
  return distanceFromLine({line.x, line.y}, radiansOf(line.size), {x, y});
}

bool lineMeets(const ElementGeometry &line, const ElementGeometry &other) {
  switch (other.kind) {
  case ElementGeometry::Kind::Point:
    return distanceFrom(line, other.x, other.y) <= tolerance;
  case ElementGeometry::Kind::Circle:
    return distanceFrom(line, other.x, other.y) <= other.size + tolerance;
  case ElementGeometry::Kind::Line:
    break;
  }
  return std::fabs(sineOf(line.size - other.size)) > parallelSine ||
         distanceFrom(line, other.x, other.y) <= tolerance;
}

bool circleMeets(const ElementGeometry &circle, const ElementGeometry &other) {
  const double apart = distance({circle.x, circle.y}, {other.x, other.y});
  const double size = other.kind == ElementGeometry::Kind::Point ? 0 : other.size;
  return apart <= circle.size + size + tolerance &&
         apart >= std::fabs(circle.size - size) - tolerance;
}

} // namespace

std::optional<ElementGeometry> definedElement(const RuleContext &ctx) {
  const MachineState &state = ctx.after();
  const CodeUse *definition = ctx.find({Action::DefineElement});
  const auto unit = millimetresPer(ctx.dialect(), state);
  if (!definition || !definition->word || !unit || !state.frames.empty() ||
      planeAxes(ctx.dialect(), state) != (1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y)))
    return std::nullopt;
  const llvm::StringRef text = definitionText(*definition->word, ctx);
  const bool circle = numberOf(text, "R").has_value();
  const auto x = numberOf(text, circle ? "I" : "X"), y = numberOf(text, circle ? "J" : "Y");
  const bool line = !circle && madeOf(text, "GXYRC") && !madeOf(text, "GXY");
  if (!x || !y || !madeOf(text, circle ? "GIJR" : line ? "GXYRC" : "GXY"))
    return std::nullopt;
  ElementGeometry element;
  element.switches = state.switches.mayBeOn(~0u);
  element.x = *x * *unit;
  element.y = *y * *unit;
  if (circle) {
    element.kind = ElementGeometry::Kind::Circle;
    element.size = *numberOf(text, "R") * *unit;
  } else if (const auto direction = numberOf(text, "RC")) {
    element.kind = ElementGeometry::Kind::Line;
    element.size = *direction;
  } else if (line) {
    return std::nullopt; // a direction that is computed
  }
  return element;
}

void ElementTable::define(const RuleContext &ctx) {
  const Word *word = DefinedElements::definedBy(ctx);
  if (!word)
    return;
  const std::pair key(word->address, word->mantissa);
  if (const auto element = definedElement(ctx))
    elements_[key] = *element;
  else
    elements_.erase(key);
}

const ElementGeometry *ElementTable::find(const Word &word) const {
  const auto at = elements_.find({word.address, word.mantissa});
  return at == elements_.end() ? nullptr : &at->second;
}

bool meet(const ElementGeometry &a, const ElementGeometry &b) {
  if (a.kind == ElementGeometry::Kind::Line)
    return lineMeets(a, b);
  if (b.kind == ElementGeometry::Kind::Line)
    return lineMeets(b, a);
  if (a.kind == ElementGeometry::Kind::Circle)
    return circleMeets(a, b);
  return b.kind != ElementGeometry::Kind::Circle || circleMeets(b, a);
}

} // namespace ncvet
