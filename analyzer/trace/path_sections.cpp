// Which moves of a tool path are made under the same modes, and which are one operation.
#include "analyzer/trace/path_sections.h"

#include "analyzer/flow/activation.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
#include "interp/evaluate/tool_data.h"

#include "llvm/Support/raw_ostream.h"

namespace ncvet {

namespace {

/// A longer comment is no name.
constexpr size_t longestComment = 80;
/// A wider gap between two blocks is a jump, not comments.
constexpr uint32_t widestGap = 4096;

std::optional<double> known(const Interval &value) {
  if (value.isConstant())
    return value.value();
  return std::nullopt;
}

int known(int32_t number) { return number < 0 ? -1 : number; }

PathSpindle spindleOf(uint8_t state) {
  return state == spindleOff        ? PathSpindle::Off
         : state == spindleCw       ? PathSpindle::Clockwise
         : state == spindleCcw      ? PathSpindle::CounterClockwise
         : state == spindleOriented ? PathSpindle::Oriented
                                    : PathSpindle::Unknown;
}

/// The cycle that makes the moves of the block; empty: the block itself makes them.
std::string cycleOf(const Step &step) {
  const Dialect &dialect = *step.unit().dialect;
  const CodeInfo *cycle = nullptr;
  for (const Event &event : step.outcome.events)
    if (event.code != noCode &&
        (event.kind == EventKind::CycleRun || (event.kind == EventKind::CycleStart && !cycle)))
      cycle = &dialect.codes[event.code];
  return cycle ? cycle->name : std::string();
}

PathSetting settingOf(const Step &step) {
  const Dialect &dialect = *step.unit().dialect;
  const MachineState &state = step.live.state;
  PathSetting setting;
  setting.tool = known(state.tool);
  setting.lengthOffset = known(state.lengthOffset);
  setting.radiusOffset = known(radiusOffsetNumber(dialect, state));
  if (const CodeInfo *offset = state.activeCode(dialect, StandardGroup::WorkOffset))
    setting.workOffset = offset->name;
  setting.cycle = cycleOf(step);
  if (state.compensation == phaseOn)
    setting.side = compensatedSide(dialect, state);
  setting.spindle = spindleOf(state.spindle);
  setting.speed = known(state.speed);
  setting.surfaceSpeed =
      state.activeAction(dialect, StandardGroup::SpeedMode) == Action::SurfaceSpeed;
  setting.speedLimit = known(state.speedLimit);
  return setting;
}

/// All of a setting in one text.
std::string keyOf(const PathSetting &setting) {
  std::string key;
  llvm::raw_string_ostream out(key);
  out << setting.tool << ' ' << setting.lengthOffset << ' ' << setting.radiusOffset << ' '
      << setting.workOffset << ' ' << setting.cycle << ' ' << setting.side << ' '
      << int(setting.spindle) << ' ' << setting.surfaceSpeed << ' ' << setting.speed.value_or(-1)
      << ' ' << setting.speedLimit.value_or(-1);
  return out.str();
}

/// What a comment says, without its marks; empty when that is no word.
std::string wordsOf(const SourceFile &source, const Comment &comment) {
  llvm::StringRef text = source.text(comment.begin, comment.end);
  text = text.trim("(){};*-= \t\r\n").take_front(longestComment);
  if (llvm::none_of(text, [](char c) { return llvm::isAlnum(c) || c & 0x80; }))
    return {};
  return source.displayText(text);
}

} // namespace

/// The last comment between the block before and this one.
void PathSections::readComments(const Step &step) {
  comment_.clear();
  const FileUnit &unit = step.unit();
  const uint32_t begin = step.block.begin;
  if (unit.source.id() == file_ && begin > next_ && begin - next_ <= widestGap) {
    Block block;
    for (uint32_t at = next_; at < begin; at = block.next) {
      unit.reader->read(at, block);
      if (block.kind != BlockKind::Empty || block.next <= at)
        break;
      for (const Comment &comment : block.comments)
        if (std::string words = wordsOf(unit.source, comment); !words.empty())
          comment_ = std::move(words);
    }
  }
  file_ = unit.source.id();
  next_ = step.block.next;
}

uint32_t PathSections::indexOf(const PathSetting &setting) {
  if (!path_.settings.empty() && !marks_.empty() && path_.settings[marks_.back().first] == setting)
    return marks_.back().first;
  if (path_.settings.size() >= mostSettings)
    return uint32_t(path_.settings.size() - 1);
  const auto [entry, isNew] =
      settings_.try_emplace(keyOf(setting), uint32_t(path_.settings.size()));
  if (isNew)
    path_.settings.push_back(setting);
  return entry->second;
}

/// Whether an operation begins with the block, and which.
void PathSections::divide(const Step &step, uint16_t file, const PathSetting &setting) {
  std::vector<PathOperation> &all = path_.operations;
  const bool hasCut = !all.empty() && lastCut_ == all.size() - 1;
  const bool isOther = all.empty() || setting.tool != all.back().tool ||
                       (hasCut && !comment_.empty()) ||
                       (hasCut && !setting.cycle.empty() && setting.cycle != all.back().cycle);
  if (!isOther || all.size() >= mostOperations) {
    if (hasCut)
      return;
    if (all.back().cycle.empty())
      all.back().cycle = setting.cycle;
    if (all.back().comment.empty() && all.size() > 1)
      all.back().comment = comment_;
    return;
  }
  PathOperation operation;
  operation.comment = comment_;
  if (operation.comment.empty() && !step.block.comments.empty())
    operation.comment = wordsOf(step.unit().source, step.block.comments.front());
  // The comment before the tool change is about what is done with the new tool.
  if (operation.comment.empty() && !hasCut && all.size() > 1)
    operation.comment = std::exchange(all.back().comment, {});
  operation.cycle = setting.cycle;
  operation.tool = setting.tool;
  operation.file = file;
  operation.line = step.unit().source.lines().lineOf(step.block.begin);
  all.push_back(std::move(operation));
}

uint32_t PathSections::enter(const Step &step, uint16_t file) {
  readComments(step);
  const PathSetting setting = settingOf(step);
  divide(step, file, setting);
  const Mark mark{indexOf(setting), uint32_t(path_.operations.size() - 1)};
  if (marks_.empty() || marks_.back() != mark)
    marks_.push_back(mark);
  return uint32_t(marks_.size() - 1);
}

PathSections::Rest PathSections::rest() const {
  Rest rest;
  rest.operations = uint32_t(path_.operations.size());
  if (!path_.operations.empty()) {
    rest.tool = path_.operations.back().tool;
    rest.cycle = path_.operations.back().cycle;
    rest.hasCut = lastCut_ == path_.operations.size() - 1;
  }
  if (!marks_.empty()) {
    rest.setting = marks_.back().first;
    rest.isLast = marks_.back().second + 1 == path_.operations.size();
    rest.isTold = lastMark_ + 1 == marks_.size();
  }
  rest.file = file_;
  rest.next = next_;
  return rest;
}

void PathSections::resume(const Rest &rest) {
  marks_.clear();
  if (rest.operations)
    marks_.push_back({rest.setting, rest.operations - 1});
  lastMark_ = rest.isTold ? 0 : uint32_t(-1);
  lastCut_ = rest.hasCut ? rest.operations - 1 : uint32_t(-1);
  file_ = rest.file;
  next_ = rest.next;
}

bool goOnAlike(const PathSections::Rest &before, const PathSections::Rest &after) {
  // An operation that has cut is what it will be: later blocks do not name it any more.
  return before.setting == after.setting && before.tool == after.tool &&
         before.cycle == after.cycle && before.hasCut && after.hasCut && before.isLast &&
         after.isLast && before.isTold == after.isTold && before.file == after.file &&
         before.next == after.next;
}

void PathSections::moved(uint32_t number, uint32_t mark, bool isCut) {
  if (mark >= marks_.size())
    return;
  const auto [setting, operation] = marks_[mark];
  if (isCut)
    lastCut_ = operation;
  if (std::exchange(lastMark_, mark) != mark)
    path_.sections.push_back({number, setting, operation});
}

} // namespace ncvet
