// The machine's state at a block, in words: one line per topic, sets where paths differ.
#include "lsp/features/showing/machine_state.h"

#include "analyzer/flow/states_at_block.h"
#include "formats/dialect/vocabulary.h"
#include "formats/text/formatted.h"

#include "llvm/Support/Path.h"

namespace ncvet::lsp {

namespace {

/// Three decimals at most, none that says nothing.
std::string number(double value) {
  std::string text = formatted("{0:f3}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.')
    text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string words(const Interval &value) {
  if (value.isUnknown())
    return "?";
  if (value.isConstant())
    return number(value.value());
  const auto bound = [](double end) { return std::isinf(end) ? std::string("…") : number(end); };
  return bound(value.lo) + " to " + bound(value.hi);
}

std::string words(int32_t whole) {
  return whole == notSet ? "none" : whole == notKnown ? "?" : std::to_string(whole);
}

/// What such a code did is over when the next block comes.
bool stopsOrReturns(Action action) {
  return action == Action::ProgramStop || action == Action::OptionalStop ||
         action == Action::ProgramEnd || action == Action::ProgramEndRewind ||
         action == Action::CallProgram || action == Action::CallLocal || action == Action::Return;
}

std::string list(llvm::ArrayRef<std::string> parts, llvm::StringRef between) {
  return llvm::join(parts, between);
}

/// What one state says, line by line, each with its topic.
using Lines = std::vector<std::pair<std::string, std::string>>;

class Writer {
public:
  Writer(const Dialect &dialect, const MachineState &state) : dialect_(dialect), state_(state) {}

  Lines lines() {
    codes();
    position();
    toolAndOffsets();
    feedAndSpeed();
    compensation();
    switches();
    return std::move(lines_);
  }

private:
  void add(llvm::StringRef topic, std::string text) {
    if (!text.empty())
      lines_.emplace_back(topic.str(), std::move(text));
  }

  /// The codes of a group that may be active: `G00 or G01`.
  std::string active(GroupIndex index) const {
    const GroupInfo &group = dialect_.groups[index];
    const uint64_t may = state_.group(index);
    std::vector<std::string> names;
    for (size_t member = 0; member < group.members.size() && member < 63; ++member)
      if (may >> member & 1 && !stopsOrReturns(dialect_.codes[group.members[member]].action))
        names.push_back(dialect_.codes[group.members[member]].name);
    constexpr size_t readable = 4;
    if (names.size() > readable)
      return {};
    if (!names.empty() && may & groupUnset)
      names.push_back("none");
    return list(names, " or ");
  }

  /// Whether no block has set the group, and it is one that only some controls have.
  bool isUntouched(GroupIndex index) const {
    return !state_.origin.all()[index].known() && !llvm::is_contained(dialect_.standard, index);
  }

  void codes() {
    std::vector<std::string> known;
    unsigned untouched = 0;
    for (GroupIndex index = 0; index < dialect_.groups.size(); ++index)
      if (!dialect_.groups[index].oneShot)
        if (std::string names = active(index); !names.empty()) {
          if (isUntouched(index))
            ++untouched;
          else
            known.push_back(names.find(' ') == std::string::npos ? names : "(" + names + ")");
        }
    // As a control lists them: by number, G before M.
    llvm::sort(known, [](llvm::StringRef a, llvm::StringRef b) {
      return a.ltrim('(').compare_numeric(b.ltrim('(')) < 0;
    });
    std::string text = list(known, " ");
    if (untouched)
      text += (known.empty() ? "" : ", and ") + std::to_string(untouched) + " more as at power-on";
    add("modal", std::move(text));
  }

  void position() {
    std::vector<std::string> axes;
    for (size_t axis = 0; axis < axisCount; ++axis) {
      if (state_.position[axis].isUnknown())
        continue;
      std::string text = axisNames()[axis].str() + " " + words(state_.position[axis]);
      if (state_.machineAxes >> axis & 1)
        text += " (machine)";
      axes.push_back(std::move(text));
    }
    add("position", list(axes, ", "));
  }

  void toolAndOffsets() {
    std::vector<std::string> parts;
    const auto part = [&](llvm::StringRef name, int32_t value) {
      if (value != notSet)
        parts.push_back((name + words(value)).str());
    };
    part("T", state_.tool);
    part("offset ", state_.toolOffset);
    part("next T", state_.preselected);
    part("H", state_.lengthOffset);
    part("D", state_.radiusOffset);
    add("tool", list(parts, ", "));
  }

  void feedAndSpeed() {
    if (state_.may(Fact::FeedSet))
      add("feed", "F" + words(state_.feed));
    std::string spindle;
    const auto bit = [&](uint8_t which, llvm::StringRef name) {
      if (state_.spindle & which)
        spindle += (spindle.empty() ? "" : " or ") + name.str();
    };
    if (state_.spindle != spindleAny) {
      bit(spindleOff, "stopped");
      bit(spindleCw, "clockwise");
      bit(spindleCcw, "counter-clockwise");
      bit(spindleOriented, "oriented");
    }
    if (state_.may(Fact::SpeedSet))
      spindle += (spindle.empty() ? "S" : ", S") + words(state_.speed);
    if (!state_.speedLimit->isUnknown())
      spindle += ", at most " + words(state_.speedLimit);
    add("spindle", spindle);
  }

  void compensation() {
    if (state_.compensation == phaseOff ||
        state_.compensation == (phaseOff | phaseOn | phaseStarting | phaseEnding))
      return;
    std::vector<std::string> parts;
    for (const auto &[phase, name] :
         {std::pair(phaseOff, "off"), std::pair(phaseStarting, "engages with the next move"),
          std::pair(phaseOn, "on"), std::pair(phaseEnding, "ends with the next move")})
      if (state_.compensation & phase)
        parts.push_back(name);
    add("compensation", list(parts, " or "));
  }

  void switches() {
    std::vector<std::string> on;
    for (size_t i = 0; i < dialect_.switches.size(); ++i) {
      const bool may = state_.switches.may >> i & 1, must = state_.switches.must >> i & 1;
      if (must)
        on.push_back(dialect_.switches[i].title);
      else if (may && on.size() < 4)
        on.push_back(dialect_.switches[i].title + "?");
    }
    add("on", list(on, ", "));
  }

  const Dialect &dialect_;
  const MachineState &state_;
  Lines lines_;
};

std::string pathOf(const StateOnWay &way, const SourceSet &sources) {
  std::vector<std::string> steps;
  for (const PathStep &step : way.path) {
    const SourceFile &file = sources.get(step.range.file);
    steps.push_back((llvm::sys::path::filename(file.display()) + ":" +
                     llvm::Twine(file.lines().lineOf(step.range.begin)) + " " + step.message)
                        .str());
  }
  return list(steps, ", ");
}

/// What the paths do not agree on; nothing where that is nothing that is shown.
std::string differences(llvm::ArrayRef<std::pair<std::string, std::string>> ways) {
  if (llvm::all_of(ways, [](const auto &way) { return way.second.empty(); }))
    return {};
  std::string text;
  const std::string *last = nullptr; // in the passes of a loop the paths are the same
  for (const auto &[path, differs] : ways) {
    const std::string title = path.empty() ? "straight on" : path;
    text += "\n" + (last && *last == path ? "or" : title) + ":\n\n" + differs;
    last = &path;
  }
  return text;
}

} // namespace

std::string machineState(const Dialect &dialect, const StatesAt &states, const SourceSet &sources) {
  if (states.ways.empty())
    return {};
  std::vector<Lines> ways;
  for (const StateOnWay &way : states.ways)
    ways.push_back(Writer(dialect, way.before).lines());
  std::string text;
  // What all paths agree on is said once, first.
  const auto common = [&](const std::pair<std::string, std::string> &line) {
    return llvm::all_of(ways, [&](const Lines &other) { return llvm::is_contained(other, line); });
  };
  for (const auto &line : ways.front())
    if (common(line))
      text += "- " + line.first + ": " + line.second + "\n";
  if (ways.size() > 1) {
    std::vector<std::pair<std::string, std::string>> told; // by path, each once
    for (size_t i = 0; i < ways.size(); ++i) {
      std::string differs;
      for (const auto &line : ways[i])
        if (!common(line))
          differs += "- " + line.first + ": " + line.second + "\n";
      std::pair<std::string, std::string> way(pathOf(states.ways[i], sources), std::move(differs));
      if (!llvm::is_contained(told, way))
        told.push_back(std::move(way));
    }
    text += differences(told);
  } else if (const std::string path = pathOf(states.ways.front(), sources); !path.empty())
    text += "- path: " + path + "\n";
  return text;
}

} // namespace ncvet::lsp
