// One debugging session: its begin and end, and how the client sends the run on.
#include "lsp/debug/debug_session.h"

#include "formats/text/failure.h"
#include "formats/text/file_uri.h"
#include "formats/text/json_text.h"
#include "lsp/debug/session_json.h"

#include "llvm/Support/Path.h"

namespace ncvet::dap {

namespace {

/// Filters of `setExceptionBreakpoints`, each with what it stops at.
Json exceptionFilters() {
  const auto filter = [](const char *id, const char *label, const char *description, bool on) {
    return Json{{"filter", id}, {"label", label}, {"description", description}, {"default", on}};
  };
  return {filter("finding:error", "Findings: errors",
                 "stops before a block that has an error, once for each", true),
          filter("finding:warning", "Findings: warnings",
                 "stops before a block that has a warning, once for each", false),
          filter("toolChange", "Tool changes", "stops before a tool is changed", false),
          filter("programStop", "Program stops", "stops before M00, M01 and their like", false),
          filter("unknown", "Open conditions",
                 "stops where the program does not say what decides, though the launch says how "
                 "such conditions go",
                 false)};
}

Json capabilities() {
  Json can = Json::object();
  for (const char *name : {"supportsConfigurationDoneRequest", "supportsFunctionBreakpoints",
                           "supportsConditionalBreakpoints", "supportsHitConditionalBreakpoints",
                           "supportsLogPoints", "supportsEvaluateForHovers", "supportsStepBack",
                           "supportsSetVariable", "supportsSetExpression", "supportsRestartRequest",
                           "supportsExceptionInfoRequest", "supportsTerminateRequest",
                           "supportsLoadedSourcesRequest", "supportsBreakpointLocationsRequest",
                           "supportsDelayedStackTraceLoading", "supportsGotoTargetsRequest"})
    can[name] = true;
  can["exceptionBreakpointFilters"] = exceptionFilters();
  return can;
}

/// Levels of block skip that are on.
llvm::Error readSkip(const Json &wanted, SkipSwitches &skip) {
  skip.fill(SkipSwitch::Off);
  if (wanted.is_boolean()) {
    skip.fill(wanted.get<bool>() ? SkipSwitch::On : SkipSwitch::Off);
    return llvm::Error::success();
  }
  if (!wanted.is_array())
    return failure("`blockSkip` is true, false, or a list of levels");
  for (const Json &level : wanted) {
    if (!level.is_number_integer() || level.get<int64_t>() < 0 ||
        level.get<int64_t>() >= int64_t(skip.size()))
      return failure("a level of `blockSkip` is a number from 0 to 9");
    // `/` and `/1` are one switch.
    const auto index = size_t(level.get<int64_t>() <= 1 ? 0 : level.get<int64_t>());
    skip[index] = SkipSwitch::On;
  }
  return llvm::Error::success();
}

llvm::Expected<OpenCondition> readOpen(const Json &wanted) {
  const std::string text = wanted.is_string() ? wanted.get<std::string>() : "";
  if (text == "ask")
    return OpenCondition::Ask;
  if (text == "holds")
    return OpenCondition::Holds;
  if (text == "fails")
    return OpenCondition::Fails;
  return failure("`openConditions` is ask, holds or fails");
}

llvm::Error readVariables(const Json &wanted, RunSettings &settings) {
  if (!wanted.is_object())
    return failure("`variables` is an object: names with their values");
  for (const auto &[name, value] : wanted.items()) {
    if (!value.is_number() && !value.is_string())
      return failure("the value of variable " + name + " is a number or a text");
    settings.variables.emplace_back(name,
                                    value.is_string() ? value.get<std::string>() : jsonText(value));
  }
  return llvm::Error::success();
}

llvm::Expected<SessionOptions> readSetup(const Json &arguments) {
  SessionOptions options;
  options.dialect = textOf(arguments, "dialect", "auto");
  options.configFile = textOf(arguments, "config");
  const auto machine = arguments.find("machine");
  if (machine == arguments.end() || machine->is_null())
    return options;
  if (machine->is_object()) {
    options.machine = MachineSource{"machine of the launch", jsonText(*machine)};
  } else if (const std::string file = textOf(arguments, "machine"); !file.empty()) {
    auto profile = readMachine(file);
    if (!profile)
      return profile.takeError();
    options.machine = std::move(*profile);
  }
  return options;
}

} // namespace

DebugSession::DebugSession(DebugChannel &channel) : channel_(channel) {
  bindLifeCycle();
  bindBreakpoints();
  bindMovement();
  bindGoto();
  bindInspection();
}

DebugSession::~DebugSession() { run_.reset(); }

void DebugSession::bindLifeCycle() {
  channel_.on("initialize", [this](const Json &arguments) -> llvm::Expected<Json> {
    return initialize(arguments);
  });
  channel_.on("launch", [this](const Json &arguments) -> llvm::Expected<Json> {
    if (program_)
      return failure("a program is launched already");
    launchArguments_ = arguments;
    if (llvm::Error wrong = load())
      return wrong;
    channel_.afterResponse([this] {
      placeAgain();
      channel_.event("initialized");
    });
    return Json();
  });
  channel_.on("attach", [](const Json &) -> llvm::Expected<Json> {
    return failure("a dry run is launched; there is nothing to attach to");
  });
  channel_.on("configurationDone", [this](const Json &) -> llvm::Expected<Json> {
    if (!program_)
      return failure("no program is launched");
    if (!std::exchange(isConfigured_, true))
      channel_.afterResponse([this] { begin(); });
    return Json();
  });
  channel_.on("restart", [this](const Json &arguments) -> llvm::Expected<Json> {
    if (llvm::Error wrong = restart(arguments))
      return wrong;
    return Json();
  });
  channel_.on("terminate", [this](const Json &) -> llvm::Expected<Json> {
    run_.reset();
    isEnded_ = true;
    channel_.afterResponse([this] { channel_.event("terminated"); });
    return Json();
  });
  channel_.on("disconnect", [this](const Json &) -> llvm::Expected<Json> {
    run_.reset();
    over_ = true;
    return Json();
  });
}

Json DebugSession::initialize(const Json &arguments) {
  const auto says = [&](const char *name) {
    const auto found = arguments.find(name);
    return found == arguments.end() || !found->is_boolean() || found->get<bool>();
  };
  linesStartAt1_ = says("linesStartAt1");
  columnsStartAt1_ = says("columnsStartAt1");
  namesFilesByUri_ = textOf(arguments, "pathFormat") == "uri";
  return capabilities();
}

/// What the launch says of the run.
llvm::Error DebugSession::readSettings() {
  settings_ = {};
  const bool noDebug = flagOf(launchArguments_, "noDebug");
  settings_.stopOnEntry = flagOf(launchArguments_, "stopOnEntry") && !noDebug;
  settings_.stopsNowhere = noDebug;
  settings_.skip.fill(SkipSwitch::Off);
  const auto given = [&](const char *name) -> const Json * {
    const auto found = launchArguments_.find(name);
    return found == launchArguments_.end() || found->is_null() ? nullptr : &*found;
  };
  if (const Json *skip = given("blockSkip"))
    if (llvm::Error wrong = readSkip(*skip, settings_.skip))
      return wrong;
  if (const Json *variables = given("variables"))
    if (llvm::Error wrong = readVariables(*variables, settings_))
      return wrong;
  if (const Json *wanted = given("openConditions")) {
    auto open = readOpen(*wanted);
    if (!open)
      return open.takeError();
    settings_.open = *open;
  }
  return llvm::Error::success();
}

/// Loads the program of the launch, as it is on disk now.
llvm::Error DebugSession::load() {
  const std::string path = pathIn(launchArguments_, "program");
  if (path.empty())
    return failure("`program` is missing: the file of the program");
  if (llvm::Error wrong = readSettings())
    return wrong;
  auto options = readSetup(launchArguments_);
  if (!options)
    return options.takeError();
  auto program = LoadedProgram::load(path, std::move(*options));
  if (!program)
    return program.takeError();
  // What is wrong with the variables is said before anything runs.
  MachineState scratch;
  for (const auto &[name, value] : settings_.variables)
    if (llvm::Error wrong = assign((*program)->main(), scratch, name, value))
      return wrong;
  program_ = std::move(*program);
  names_.clear();
  targets_.clear();
  return llvm::Error::success();
}

void DebugSession::begin() {
  channel_.event("process", {{"name", program_->main().source.display()},
                             {"isLocalProcess", false},
                             {"startMethod", "launch"}});
  isEnded_ = false;
  run_ = std::make_unique<DryRun>(*program_, breakpoints_, settings_, *this);
  channel_.event("thread", {{"reason", "started"}, {"threadId", onlyThread}});
  run_->start();
}

/// Loads the program again and begins anew, with what the client says of the launch now.
llvm::Error DebugSession::restart(const Json &arguments) {
  if (!program_ || !isConfigured_)
    return failure("no program is launched");
  const auto launch = arguments.find("arguments");
  if (launch != arguments.end() && launch->is_object())
    launchArguments_ = *launch;
  run_.reset();
  if (llvm::Error wrong = load())
    return wrong;
  channel_.afterResponse([this] {
    placeAgain();
    begin();
  });
  return llvm::Error::success();
}

llvm::Error DebugSession::needStop() const {
  if (!run_)
    return failure("no program runs");
  if (!run_->isStopped())
    return failure(notStopped.str()); // an editor asks late, when the user has gone on
  return llvm::Error::success();
}

void DebugSession::bindMovement() {
  const auto bind = [this](const char *command, std::function<void()> move) {
    channel_.on(command, [this, move](const Json &) -> llvm::Expected<Json> {
      if (llvm::Error wrong = needStop())
        return wrong;
      channel_.afterResponse(move);
      return Json();
    });
  };
  bind("next", [this] { run_->go(Go::Over); });
  bind("stepIn", [this] { run_->go(Go::Into); });
  bind("stepOut", [this] { run_->go(Go::Out); });
  bind("stepBack", [this] { run_->stepBack(); });
  bind("reverseContinue", [this] { run_->goBack(); });
  channel_.on("continue", [this](const Json &) -> llvm::Expected<Json> {
    if (llvm::Error wrong = needStop())
      return wrong;
    channel_.afterResponse([this] { run_->go(Go::On); });
    return Json{{"allThreadsContinued", true}};
  });
  channel_.on("pause", [this](const Json &) -> llvm::Expected<Json> {
    if (!run_)
      return failure("no program runs");
    channel_.afterResponse([this] { run_->pause(); });
    return Json();
  });
}

void DebugSession::stopped(const Stop &stop) {
  lastStop_ = stop;
  Json body = {{"reason", stop.reason}, {"threadId", onlyThread}, {"allThreadsStopped", true}};
  if (!stop.description.empty())
    body["description"] = stop.description;
  if (!stop.text.empty())
    body["text"] = stop.text;
  if (!stop.breakpoints.empty())
    body["hitBreakpointIds"] = stop.breakpoints;
  channel_.event("stopped", std::move(body));
}

void DebugSession::said(const char *category, const std::string &text, const FileUnit &unit,
                        uint32_t offset) {
  Json body = {{"category", category}, {"output", text + "\n"}, {"source", sourceOf(unit)}};
  setPlace(body, unit, offset, offset);
  body.erase("endLine");
  body.erase("endColumn");
  channel_.event("output", std::move(body));
}

void DebugSession::ended(bool complete) {
  channel_.event("exited", {{"exitCode", complete ? 0 : 1}});
  channel_.event("terminated");
}

uint32_t DebugSession::toClient(uint32_t number, bool startsAt1) const {
  return startsAt1 ? number : number - 1;
}

int64_t DebugSession::fromClient(int64_t number, bool startsAt1) const {
  return startsAt1 ? number : number + 1;
}

std::string DebugSession::pathIn(const Json &object, const char *member) const {
  const std::string path = textOf(object, member);
  return namesFilesByUri_ ? pathOfUri(path) : path;
}

Json DebugSession::sourceOf(const FileUnit &unit) const {
  const std::string &path = unit.source.path();
  return {{"name", llvm::sys::path::filename(path).str()},
          {"path", namesFilesByUri_ ? uriOfPath(path) : path}};
}

void DebugSession::setPlace(Json &at, const FileUnit &unit, uint32_t begin, uint32_t end) const {
  const LineColumn from = unit.source.position(begin), to = unit.source.position(end);
  at["line"] = toClient(from.line, linesStartAt1_);
  at["column"] = toClient(from.column, columnsStartAt1_);
  at["endLine"] = toClient(to.line, linesStartAt1_);
  at["endColumn"] = toClient(to.column, columnsStartAt1_);
}

} // namespace ncvet::dap
