// Codes that lay frames over the work offset: shift, rotation, scale, mirror.
#include "formats/dialect/variable_key.h"
#include "interp/evaluate/formula.h"
#include "interp/execute/execution.h"

namespace ncvet {

namespace {

constexpr unsigned spatial = 3; ///< X, Y and Z

/// The frame that a code without a switch of its own has.
constexpr uint8_t nameless = 0xFE;

uint8_t nameOf(const CodeInfo &code) {
  return code.effect.index == 0xFF ? nameless : code.effect.index;
}

FrameKind kindOf(const CodeInfo &code) {
  switch (code.action) {
  case Action::LocalShift:
    return FrameKind::Shift;
  case Action::RotationOn:
  case Action::RotationOff:
    return FrameKind::Rotation;
  case Action::ScalingOn:
  case Action::ScalingOff:
    return FrameKind::Scale;
  case Action::MirrorOn:
  case Action::MirrorOff:
    return FrameKind::Mirror;
  default:
    return code.frame;
  }
}

/// Whether a frame is put together axis by axis: those that a block does not name keep theirs.
bool byAxis(const CodeInfo &code) {
  return code.action == Action::LocalShift || code.action == Action::MirrorOn ||
         code.action == Action::MirrorOff || code.frame == FrameKind::Offset ||
         code.frame == FrameKind::MirrorAxes;
}

/// The axis of space that an argument names by its letter.
std::optional<size_t> axisNamed(const Interval &argument) {
  static const double keys[] = {double(variableKey("X")), double(variableKey("Y")),
                                double(variableKey("Z"))};
  for (size_t axis = 0; axis < spatial; ++axis)
    if (argument == Interval::exactly(keys[axis]))
      return axis;
  return std::nullopt;
}

} // namespace

/// Changes the frames, with the tool where it is: its coordinates are others.
void Execution::rebase(const FrameStack &frames) {
  const std::optional<Frame> from = state_.frames.total(), to = frames.total();
  const std::optional<Frame> back = to ? to->inverse() : std::nullopt;
  state_.frames = frames;
  // What was cut so far lies elsewhere in the new coordinates.
  state_.fedFrom.forget();
  CutArea::Box area = state_.cutArea.get();
  for (Interval &side : area)
    if (side.lo <= side.hi)
      side = Interval::unknown();
  state_.cutArea.set(area);
  Point3 place;
  for (unsigned i = 0; i < spatial; ++i)
    place[i] = state_.machineAxes >> i & 1 ? Interval::unknown() : state_.position[i];
  if (from && back)
    place = *back * (*from * place);
  else
    place = {};
  for (unsigned i = 0; i < spatial; ++i)
    if (!(state_.machineAxes >> i & 1))
      state_.position[i] = place[i];
}

/// What the axis words of the block give, per axis of space; none: a value is not known.
std::optional<Execution::FrameWords> Execution::frameWords(FrameKind kind, bool lengths) const {
  FrameWords words;
  for (const Word &word : block_.words) {
    if (kind == FrameKind::MirrorAxes && word.address == argumentAddress)
      if (const auto axis = axisNamed(value(word)))
        words.given[*axis] = true;
    if (!(dialect_.axisWords & maskOf(word.address)))
      continue;
    const AddressInfo &address = dialect_.addresses[word.address];
    if (unsigned(address.axis) >= spatial)
      continue;
    const auto axis = size_t(address.axis);
    words.given[axis] = true;
    if (word.has(wordNoValue))
      continue;
    const Interval v = lengths ? lengthOfWord(word) : value(word);
    words.adds[axis] = kind == FrameKind::Offset && address.kind == AddressKind::Increment;
    if (!v.isConstant() || (address.kind == AddressKind::Increment && !words.adds[axis]) ||
        word.has(wordIncremental))
      return std::nullopt;
    words.value[axis] = v.value();
  }
  return words;
}

/// The angle or the ratio that the block gives; none when it is not clear.
std::optional<double> Execution::frameNumber(const CodeInfo &code, Role role) const {
  for (const WordSpec &spec : code.words)
    if (spec.role == role)
      if (const Word *word = wordFor(block_, spec)) {
        // A ratio without a point counts in thousandths on some controls; an angle under
        // incremental input may add up.
        const bool clear = role == Role::Ratio ? word->has(wordPoint) || !word->isNumber()
                                               : countsFromBefore(*word) == Truth::No;
        const Interval v = value(*word);
        if (v.isConstant() && (clear || !isTransformation(code)))
          return v.value();
      }
  return std::nullopt;
}

/// The map that the code describes in its block; none when something is not known.
std::optional<Frame> Execution::frameOf(const CodeInfo &code) const {
  const FrameKind kind = kindOf(code);
  // The words of a frame that turns or scales are angles and factors, those of a function its
  // centre.
  if (isTransformation(code) && llvm::any_of(block_.words, [&](const Word &word) {
        return dialect_.axisWords & maskOf(word.address) && countsFromBefore(word) != Truth::No;
      }))
    return std::nullopt; // a centre that counts from the present place
  const std::optional<FrameWords> words =
      frameWords(kind, isTransformation(code) || kind == FrameKind::Shift ||
                           kind == FrameKind::Offset || kind == FrameKind::Mirror);
  if (kind == FrameKind::Steps)
    return frameOfSteps(code);
  if (!words)
    return std::nullopt;
  switch (kind) {
  case FrameKind::Shift:
    return Frame::shifted(words->value);
  case FrameKind::Offset: // under incremental input it is not clear from where it counts
    return incremental() == Truth::No ? std::optional(Frame::shifted(words->value)) : std::nullopt;
  case FrameKind::Rotation:
    return isTransformation(code) ? rotationAbout(*words, frameNumber(code, Role::Angle))
                                  : rotationOf(*words, frameNumber(code, Role::Angle));
  case FrameKind::Scale: {
    if (!isTransformation(code)) { // a factor per axis, about the zero point
      std::array<double, 3> factors{1, 1, 1};
      for (size_t i = 0; i < spatial; ++i)
        if (words->given[i])
          factors[i] = words->value[i];
      return Frame::scaled(factors, {});
    }
    const auto ratio = frameNumber(code, Role::Ratio);
    if (!ratio)
      return std::nullopt;
    return Frame::scaled({*ratio, *ratio, *ratio}, centreOf(*words, (1u << spatial) - 1));
  }
  case FrameKind::Mirror:
  case FrameKind::MirrorAxes: {
    std::array<double, 3> factors{1, 1, 1}, line{};
    for (size_t i = 0; i < spatial; ++i)
      if (words->given[i]) {
        factors[i] = -1;
        line[i] = isTransformation(code) ? words->value[i] : 0;
      }
    return Frame::scaled(factors, line);
  }
  case FrameKind::Steps:
  case FrameKind::None:
    return std::nullopt;
  }
  return std::nullopt;
}

/// The map that the table's steps make of the block and what is before it.
std::optional<Frame> Execution::frameOfSteps(const CodeInfo &code) const {
  const Interval unit = lengthFactor();
  if (!unit.isConstant() || dialect_.isLathe() || // X may be a diameter
      (!code.frameWhen.empty() && truthOf(code.frameWhen, code, context_) != Truth::Yes))
    return std::nullopt;
  Frame frame;
  for (const FrameStep &step : code.frameSteps) {
    std::array<double, 12> numbers{};
    for (size_t i = 0; i < step.numbers.size(); ++i) {
      const Interval number = levelOf(step.numbers[i], code, context_);
      if (!number.isConstant())
        return std::nullopt;
      numbers[i] = number.value();
    }
    frame = frame * frameOfStep(step, numbers, unit.value());
  }
  return frame;
}

/// `unit`: millimetres of a length.
Frame Execution::frameOfStep(const FrameStep &step, std::array<double, 12> numbers,
                             double unit) const {
  using Kind = FrameStep::Kind;
  const std::array<double, 3> three{numbers[0], numbers[1], numbers[2]};
  switch (step.kind) {
  case Kind::Shift:
    return Frame::shifted({three[0] * unit, three[1] * unit, three[2] * unit});
  case Kind::Turn: {
    const auto axis =
        step.axis == FrameStep::toolAxis ? unsigned(toolAxis(dialect_, state_)) : step.axis;
    return Frame::turned(axis, numbers[0],
                         {numbers[1] * unit, numbers[2] * unit, numbers[3] * unit});
  }
  case Kind::Scale:
    return Frame::scaled(three, {});
  case Kind::Matrix:
    constexpr size_t width = 4;
    for (size_t row = 0; row < 3; ++row)
      numbers[row * width + 3] *= unit;
    return Frame::ofRows(numbers);
  }
  return {};
}

/// Whether it is one of the functions that each are switched on and off and name their centre (G51,
/// G51.1, G68), other than the frames that replace one another (TRANS, ROT).
bool Execution::isTransformation(const CodeInfo &code) {
  return code.action == Action::RotationOn || code.action == Action::ScalingOn ||
         code.action == Action::MirrorOn;
}

/// Centre of a transformation: the present place where the block does not name it.
std::array<double, 3> Execution::centreOf(const FrameWords &words, unsigned axes) const {
  std::array<double, 3> centre{};
  for (size_t i = 0; i < spatial; ++i) {
    if (!(axes >> i & 1))
      continue;
    if (words.given[i]) {
      centre[i] = words.value[i];
      continue;
    }
    centre[i] = !state_.position[i].isConstant() || state_.machineAxes >> i & 1
                    ? std::numeric_limits<double>::quiet_NaN()
                    : state_.position[i].value();
  }
  return centre;
}

/// In the active plane, about a centre.
std::optional<Frame> Execution::rotationAbout(const FrameWords &words,
                                              std::optional<double> degrees) const {
  const uint16_t plane = planeAxes(dialect_, state_);
  if (!degrees || (dialect_.isLathe() && plane & 1)) // X is a diameter
    return std::nullopt;
  return Frame::turned(unsigned(toolAxis(dialect_, state_)), *degrees, centreOf(words, plane));
}

/// About the zero point: in the active plane by one angle, or about X, Y and Z by theirs, Z being
/// the outermost.
Frame Execution::rotationOf(const FrameWords &words, std::optional<double> degrees) const {
  if (degrees)
    return Frame::turned(unsigned(toolAxis(dialect_, state_)), *degrees, {});
  Frame frame;
  for (unsigned i = 0; i < spatial; ++i)
    if (words.given[i])
      frame = Frame::turned(i, words.value[i], {}) * frame;
  return frame;
}

/// Puts a frame together of what the block says of the axes that it names, and what the others
/// had.
std::optional<Frame> Execution::frameByAxis(const CodeInfo &code,
                                            const std::optional<Frame> &old) const {
  const std::optional<FrameWords> words = frameWords(code.frame, true);
  std::optional<Frame> whole = frameOf(code);
  if (!old || !words || !whole)
    return whole;
  for (size_t i = 0; i < spatial; ++i)
    if (!words->given[i]) {
      whole->shift[i] = old->shift[i];
      whole->turn[i] = old->turn[i];
    } else if (words->adds[i]) {
      whole->shift[i] += old->shift[i];
    }
  return whole;
}

/// Takes a mirror away from the axes that the block names; from all where it names none.
void Execution::endMirror(const CodeInfo &code, FrameStack &frames) const {
  const uint8_t name = nameOf(code);
  const std::optional<FrameWords> words = frameWords(code.frame, true);
  std::optional<Frame> left = frames.find(name);
  if (!words || !left || !llvm::is_contained(words->given, true))
    return frames.remove(name);
  for (size_t i = 0; i < spatial; ++i)
    if (words->given[i]) {
      left->shift[i] = 0;
      left->turn[i] = Frame().turn[i];
    }
  frames.put(name, left);
}

/// Lays the frame of a code over the others, replaces it, or takes it away.
void Execution::applyFrame(const CodeUse &use) {
  const CodeInfo &code = info(use);
  const uint8_t name = nameOf(code);
  FrameStack frames = state_.frames;
  switch (code.action) {
  case Action::FrameSet:
  case Action::RotationOn:
  case Action::ScalingOn:
    frames.put(name, frameOf(code));
    break;
  case Action::LocalShift:
  case Action::MirrorOn:
    frames.put(name, frameByAxis(code, frames.find(name)));
    break;
  case Action::FrameAdd: {
    if (code.frame == FrameKind::Steps) { // whole by itself
      frames.put(name, frameOf(code));
      break;
    }
    const std::optional<Frame> old = frames.find(name);
    if (!frames.has(name) || byAxis(code)) {
      frames.put(name, frames.has(name) && !old ? std::nullopt : frameByAxis(code, old));
      break;
    }
    const std::optional<Frame> more = frameOf(code);
    frames.put(name, more && old ? std::optional(*old * *more) : std::nullopt);
    break;
  }
  case Action::MirrorOff:
    endMirror(code, frames);
    break;
  default:
    if (code.frame == FrameKind::MirrorAxes)
      endMirror(code, frames);
    else
      frames.remove(name);
    break;
  }
  rebase(frames);
  if (!code.losesPlace.empty() && truthOf(code.losesPlace, code, context_) != Truth::No)
    for (Interval &place : state_.position)
      place = Interval::unknown();
}

} // namespace ncvet
