// One debugging session: what a stopped program shows, and what may be changed in it.
#include "formats/text/failure.h"
#include "lsp/debug/debug_session.h"
#include "lsp/debug/session_json.h"

namespace ncvet::dap {

namespace {

/// Groups of values, in the order in which they are shown.
enum class Scope : uint8_t { Variables, Position, Modes, Offsets, Drives, Count };
constexpr llvm::StringLiteral scopeNames[] = {"Variables", "Position", "Modes", "Offsets",
                                              "Spindle and feed"};
constexpr int64_t scopeCount = int64_t(Scope::Count);

/// Variables of a program that are shown: a list for people has an end.
constexpr size_t mostVariables = 2000;

/// A reference to a group of one frame; zero means none.
int64_t referenceOf(size_t frame, int64_t scope) { return int64_t(frame) * scopeCount + scope + 1; }

/// Whether the text is an assignment, `#101 = 5`: both sides.
std::optional<std::pair<llvm::StringRef, llvm::StringRef>> assignmentIn(llvm::StringRef text) {
  const size_t at = text.find('=');
  if (at == text.npos || at == 0 || at + 1 == text.size() || text[at + 1] == '=' ||
      llvm::StringRef("<>!=").contains(text[at - 1]))
    return std::nullopt;
  return std::pair(text.take_front(at).trim(), text.drop_front(at + 1).trim());
}

} // namespace

void DebugSession::bindInspection() {
  channel_.on("threads", [](const Json &) -> llvm::Expected<Json> {
    return Json{{"threads", {{{"id", onlyThread}, {"name", "program"}}}}};
  });
  const auto bind = [this](const char *command,
                           llvm::Expected<Json> (DebugSession::*answer)(const Json &)) {
    channel_.on(command, [this, answer](const Json &arguments) -> llvm::Expected<Json> {
      if (llvm::Error wrong = needStop())
        return wrong;
      return (this->*answer)(arguments);
    });
  };
  // A client may still ask for what it showed when the user ended the program: there is nothing.
  const auto bindList = [this](const char *command, const char *list,
                               llvm::Expected<Json> (DebugSession::*answer)(const Json &)) {
    channel_.on(command, [this, list, answer](const Json &arguments) -> llvm::Expected<Json> {
      if (isEnded_)
        return Json{{list, Json::array()}};
      if (llvm::Error wrong = needStop())
        return wrong;
      return (this->*answer)(arguments);
    });
  };
  bindList("stackTrace", "stackFrames", &DebugSession::stackTrace);
  bindList("scopes", "scopes", &DebugSession::scopes);
  bindList("variables", "variables", &DebugSession::variables);
  bind("setVariable", &DebugSession::setVariable);
  bind("setExpression", &DebugSession::setExpression);
  bind("evaluate", &DebugSession::evaluate);
  bind("exceptionInfo", &DebugSession::exceptionInfo);
  channel_.on("loadedSources", [this](const Json &) { return loadedSources(); });
}

llvm::Expected<Json> DebugSession::stackTrace(const Json &arguments) {
  const llvm::ArrayRef<Frame> frames = run_->frames();
  const auto total = int64_t(frames.size());
  const int64_t first = std::clamp<int64_t>(numberOf(arguments, "startFrame"), 0, total);
  const int64_t wanted = numberOf(arguments, "levels");
  const int64_t last = wanted > 0 && wanted < total - first ? first + wanted : total;
  Json list = Json::array();
  for (int64_t i = first; i < last; ++i) { // innermost first
    const size_t index = size_t(total - 1 - i);
    const Frame &frame = frames[index];
    Json one = {{"id", index + 1}, {"name", frame.name}, {"source", sourceOf(*frame.unit)}};
    setPlace(one, *frame.unit, frame.begin, frame.end);
    list.push_back(std::move(one));
  }
  return Json{{"stackFrames", std::move(list)}, {"totalFrames", total}};
}

llvm::Expected<const Frame *> DebugSession::frameOf(const Json &arguments) const {
  const llvm::ArrayRef<Frame> frames = run_->frames();
  const int64_t id = numberOf(arguments, "frameId", int64_t(frames.size()));
  if (id < 1 || id > int64_t(frames.size()))
    return failure("there is no such frame");
  return &frames[size_t(id - 1)];
}

const MachineState &DebugSession::stateOf(const Frame &frame) const {
  return &frame == &run_->frames().back() ? run_->state() : frame.state;
}

llvm::Expected<Json> DebugSession::scopes(const Json &arguments) {
  auto frame = frameOf(arguments);
  if (!frame)
    return frame.takeError();
  const auto index = size_t(*frame - run_->frames().data());
  // Editors open the first group: an empty one shows nothing of the machine.
  const int64_t first = int64_t(hasVariables(*(*frame)->unit) ? Scope() : Scope::Position);
  Json list = Json::array();
  for (int64_t i = 0; i < scopeCount; ++i) {
    const int64_t scope = (first + i) % scopeCount;
    Json one = {{"name", scopeNames[scope].str()},
                {"variablesReference", referenceOf(index, scope)},
                {"expensive", false}};
    if (Scope(scope) == Scope::Variables)
      one["presentationHint"] = "locals";
    list.push_back(std::move(one));
  }
  return Json{{"scopes", std::move(list)}};
}

const lsp::Names &DebugSession::namesOf(const FileUnit &unit) {
  auto &names = names_[unit.source.id()];
  if (!names)
    names = std::make_unique<lsp::Names>(unit);
  return *names;
}

bool DebugSession::hasVariables(const FileUnit &unit) {
  return llvm::any_of(namesOf(unit).all(), [](const lsp::Occurrence &one) {
    return one.kind == lsp::NameKind::Variable;
  });
}

/// The variables that the file of a frame names, in the order in which it names them.
std::vector<NamedValue> DebugSession::programVariables(const Frame &frame) {
  const FileUnit &unit = *frame.unit;
  const lsp::Names &names = namesOf(unit);
  std::vector<NamedValue> shown;
  std::set<uint64_t> known;
  const MachineState &state = stateOf(frame);
  for (const lsp::Occurrence &one : names.all()) {
    if (one.kind != lsp::NameKind::Variable || !known.insert(one.key).second)
      continue;
    const llvm::StringRef text = names.text(one);
    for (const std::string &spelled : {("#" + text).str(), ("#<" + text + ">").str(), text.str()}) {
      auto value = WatchExpression::parse(unit, spelled);
      if (!value) {
        llvm::consumeError(value.takeError());
        continue;
      }
      shown.push_back({spelled, valueText(value->evaluate(state)), ""});
      break;
    }
    if (shown.size() == mostVariables)
      break;
  }
  return shown;
}

llvm::Expected<Json> DebugSession::variables(const Json &arguments) {
  const int64_t reference = numberOf(arguments, "variablesReference") - 1;
  const llvm::ArrayRef<Frame> frames = run_->frames();
  if (reference < 0 || reference / scopeCount >= int64_t(frames.size()))
    return failure("there are no such variables");
  const Frame &frame = frames[size_t(reference / scopeCount)];
  const MachineState &state = stateOf(frame);
  const Dialect &dialect = *frame.unit->dialect;
  const auto scope = Scope(reference % scopeCount);
  const bool isInnermost = &frame == &frames.back();
  std::vector<NamedValue> values;
  switch (scope) {
  case Scope::Variables:
    values = programVariables(frame);
    break;
  case Scope::Position:
    values = positionOf(dialect, state);
    break;
  case Scope::Modes:
    values = modesOf(dialect, state);
    break;
  case Scope::Offsets:
    values = offsetsOf(dialect, state);
    break;
  case Scope::Drives:
  case Scope::Count:
    values = drivesOf(dialect, state);
    break;
  }
  Json list = Json::array();
  for (const NamedValue &one : values) {
    Json shown = {{"name", one.name}, {"value", one.value}, {"variablesReference", 0}};
    if (!one.type.empty())
      shown["type"] = one.type;
    if (scope == Scope::Variables)
      shown["evaluateName"] = one.name;
    if (scope != Scope::Variables || !isInnermost)
      shown["presentationHint"] = {{"attributes", {"readOnly"}}};
    list.push_back(std::move(shown));
  }
  return Json{{"variables", std::move(list)}};
}

/// Gives a variable of the innermost program a value; the answer has the one that it has now.
llvm::Expected<Json> DebugSession::changed(llvm::StringRef name, llvm::StringRef value) {
  if (llvm::Error wrong = run_->assignVariable(name, value))
    return wrong;
  auto now = WatchExpression::parse(*run_->frames().back().unit, name);
  if (!now)
    return now.takeError();
  return Json{{"value", valueText(now->evaluate(run_->state()))}};
}

llvm::Expected<Json> DebugSession::setVariable(const Json &arguments) {
  const int64_t reference = numberOf(arguments, "variablesReference") - 1;
  const auto innermost = int64_t(run_->frames().size()) - 1;
  if (reference != innermost * scopeCount + int64_t(Scope::Variables))
    return failure("only variables of the innermost program can be given a value");
  return changed(textOf(arguments, "name"), textOf(arguments, "value"));
}

llvm::Expected<Json> DebugSession::setExpression(const Json &arguments) {
  return changed(textOf(arguments, "expression"), textOf(arguments, "value"));
}

llvm::Expected<Json> DebugSession::evaluate(const Json &arguments) {
  auto frame = frameOf(arguments);
  if (!frame)
    return frame.takeError();
  const std::string text = textOf(arguments, "expression");
  const llvm::StringRef expression = llvm::StringRef(text).trim();
  const auto result = [](std::string value) {
    return Json{{"result", std::move(value)}, {"variablesReference", 0}};
  };
  if (textOf(arguments, "context") == "repl") {
    const bool yes = expression.equals_insensitive("yes"), no = expression.equals_insensitive("no");
    if ((yes || no) && run_->isOpen()) {
      run_->answer(yes);
      return result(yes ? "the condition holds" : "the condition does not hold");
    }
    if (const auto sides = assignmentIn(expression)) {
      auto now = changed(sides->first, sides->second);
      if (!now)
        return now.takeError();
      return result((*now)["value"]);
    }
  }
  const MachineState &state = stateOf(**frame);
  if (auto value = letterValue(expression, state))
    return result(valueText(*value));
  auto parsed = WatchExpression::parse(*(*frame)->unit, expression);
  if (!parsed)
    return parsed.takeError();
  return result(valueText(parsed->evaluate(state)));
}

llvm::Expected<Json> DebugSession::exceptionInfo(const Json &) {
  const Stop &stop = lastStop_;
  Json info = {{"exceptionId", stop.description.empty() ? stop.reason : stop.description},
               {"breakMode", "always"}};
  if (!stop.text.empty())
    info["description"] = stop.text;
  return info;
}

llvm::Expected<Json> DebugSession::loadedSources() {
  Json list = Json::array();
  if (program_)
    whileStill([&] {
      const SourceSet &sources = program_->project().sources();
      for (size_t i = 0; i < sources.size(); ++i)
        list.push_back(sourceOf(program_->project().unit(sources.get(FileId(i)))));
    });
  return Json{{"sources", std::move(list)}};
}

} // namespace ncvet::dap
