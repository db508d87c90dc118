// One debugging session: its breakpoints.
#include "analyzer/program/block_reading.h"
#include "formats/text/failure.h"
#include "lsp/debug/debug_session.h"
#include "lsp/debug/session_json.h"

namespace ncvet::dap {

namespace {

/// Breakpoints of one request: nobody sets more by hand.
constexpr size_t mostBreakpoints = 10000;

Json unverified(int id, const std::string &why) {
  return {{"id", id}, {"verified", false}, {"message", why}};
}

BreakpointWish wishOf(const Json &wanted) {
  return {textOf(wanted, "condition"), textOf(wanted, "hitCondition"),
          textOf(wanted, "logMessage")};
}

const Json &listIn(const Json &arguments, const char *name) {
  static const Json none = Json::array();
  const auto found = arguments.find(name);
  return found != arguments.end() && found->is_array() ? *found : none;
}

} // namespace

void DebugSession::bindBreakpoints() {
  const auto bind = [this](const char *command,
                           llvm::Expected<Json> (DebugSession::*answer)(const Json &)) {
    channel_.on(command,
                [this, answer](const Json &arguments) { return (this->*answer)(arguments); });
  };
  bind("setBreakpoints", &DebugSession::setBreakpoints);
  bind("setFunctionBreakpoints", &DebugSession::setFunctionBreakpoints);
  bind("setExceptionBreakpoints", &DebugSession::setExceptionBreakpoints);
  bind("breakpointLocations", &DebugSession::breakpointLocations);
}

void DebugSession::whileStill(const std::function<void()> &task) {
  if (run_)
    run_->perform(task);
  else
    task();
}

/// Sets one breakpoint, and tells where it is.
Json DebugSession::placeBreakpoint(FileUnit *unit, const Json &wanted, int id) {
  if (!unit)
    return unverified(id, program_ ? "the file cannot be read" : "no program is launched");
  const int64_t line = fromClient(numberOf(wanted, "line", -1), linesStartAt1_);
  const auto at = line > 0 && line < std::numeric_limits<uint32_t>::max()
                      ? blockFromLine(*unit, uint32_t(line))
                      : std::nullopt;
  if (!at)
    return unverified(id, "no block follows");
  auto made = Breakpoint::make(*unit, wishOf(wanted), id);
  if (!made)
    return unverified(id, llvm::toString(made.takeError()));
  breakpoints_.atBlocks[{unit->source.id(), *at}].push_back(std::move(*made));
  Json placed = {{"id", id}, {"verified", true}, {"source", sourceOf(*unit)}};
  Block block;
  unit->reader->read(*at, block);
  setPlace(placed, *unit, block.begin, block.end);
  return placed;
}

/// Sets all breakpoints that are wanted in a file, in place of those before.
Json DebugSession::placeAll(const std::string &path) {
  FileUnit *const unit = program_ ? program_->unitOf(path) : nullptr;
  if (unit) {
    auto &all = breakpoints_.atBlocks;
    const FileId file = unit->source.id();
    all.erase(all.lower_bound({file, 0}), all.upper_bound({file, ~0u}));
  }
  Json placed = Json::array();
  const Wishes &wishes = wishes_[path];
  for (size_t i = 0; i < wishes.ids.size(); ++i)
    placed.push_back(placeBreakpoint(unit, wishes.wanted[i], wishes.ids[i]));
  return placed;
}

Json DebugSession::placeFunction(const Json &wanted, int id) {
  if (!program_)
    return unverified(id, "no program is launched");
  const std::string name = programKeyOf(textOf(wanted, "name"));
  if (name.empty())
    return unverified(id, "the name of a program is missing");
  auto made = Breakpoint::make(program_->main(), wishOf(wanted), id);
  if (!made)
    return unverified(id, llvm::toString(made.takeError()));
  breakpoints_.atPrograms.insert_or_assign(name, std::move(*made));
  return {{"id", id}, {"verified", true}};
}

Json DebugSession::placeFunctions() {
  breakpoints_.atPrograms.clear();
  Json placed = Json::array();
  for (size_t i = 0; i < functions_.ids.size(); ++i)
    placed.push_back(placeFunction(functions_.wanted[i], functions_.ids[i]));
  return placed;
}

/// After a program was loaded: sets what was wanted before, and tells what has become of it.
void DebugSession::placeAgain() {
  breakpoints_.atBlocks.clear();
  Json placed = placeFunctions();
  for (const auto &[path, wishes] : wishes_)
    for (Json &one : placeAll(path))
      placed.push_back(std::move(one));
  for (Json &one : placed)
    channel_.event("breakpoint", {{"reason", "changed"}, {"breakpoint", std::move(one)}});
}

llvm::Expected<Json> DebugSession::setBreakpoints(const Json &arguments) {
  const Json &source = arguments.at("source");
  if (textOf(source, "path").empty())
    return failure("the source has no path");
  const std::string path = plainPath(pathIn(source, "path"));
  Wishes wishes;
  wishes.wanted = listIn(arguments, "breakpoints");
  if (wishes.wanted.empty()) // the older form
    for (const Json &line : listIn(arguments, "lines"))
      wishes.wanted.push_back({{"line", line}});
  if (wishes.wanted.size() > mostBreakpoints)
    return failure("too many breakpoints");
  for (size_t i = 0; i < wishes.wanted.size(); ++i)
    wishes.ids.push_back(++lastBreakpoint_);
  Json placed;
  whileStill([&] {
    wishes_[path] = std::move(wishes);
    placed = placeAll(path);
  });
  return Json{{"breakpoints", std::move(placed)}};
}

llvm::Expected<Json> DebugSession::setFunctionBreakpoints(const Json &arguments) {
  Wishes wishes;
  wishes.wanted = listIn(arguments, "breakpoints");
  if (wishes.wanted.size() > mostBreakpoints)
    return failure("too many breakpoints");
  for (size_t i = 0; i < wishes.wanted.size(); ++i)
    wishes.ids.push_back(++lastBreakpoint_);
  Json placed;
  whileStill([&] {
    functions_ = std::move(wishes);
    placed = placeFunctions();
  });
  return Json{{"breakpoints", std::move(placed)}};
}

llvm::Expected<Json> DebugSession::setExceptionBreakpoints(const Json &arguments) {
  ExceptionFilters filters;
  Json placed = Json::array();
  const std::pair<const char *, bool ExceptionFilters::*> known[] = {
      {"finding:error", &ExceptionFilters::errors},
      {"finding:warning", &ExceptionFilters::warnings},
      {"toolChange", &ExceptionFilters::toolChange},
      {"programStop", &ExceptionFilters::programStop},
      {"unknown", &ExceptionFilters::unknown}};
  for (const Json &name : listIn(arguments, "filters")) {
    const auto *const filter =
        llvm::find_if(known, [&](const auto &one) { return name == Json(one.first); });
    const bool isKnown = filter != std::end(known);
    if (isKnown)
      filters.*filter->second = true;
    placed.push_back({{"verified", isKnown}});
  }
  whileStill([&] { breakpoints_.filters = filters; });
  return Json{{"breakpoints", std::move(placed)}};
}

/// Blocks that begin on the lines that are asked for.
llvm::Expected<Json> DebugSession::breakpointLocations(const Json &arguments) {
  const std::string path = pathIn(arguments.at("source"), "path");
  const int64_t first = fromClient(numberOf(arguments, "line", -1), linesStartAt1_);
  const int64_t last = arguments.contains("endLine")
                           ? fromClient(numberOf(arguments, "endLine", -1), linesStartAt1_)
                           : first;
  if (!program_)
    return failure("no program is launched");
  Json places = Json::array();
  whileStill([&] {
    FileUnit *const unit = program_->unitOf(path);
    for (int64_t line = first; unit && line > 0 && line <= last;) {
      const auto at = line < std::numeric_limits<uint32_t>::max()
                          ? blockFromLine(*unit, uint32_t(line))
                          : std::nullopt;
      if (!at || places.size() == mostBreakpoints)
        break;
      const int64_t found = unit->source.lines().lineOf(*at);
      if (found > last)
        break;
      Block block;
      unit->reader->read(*at, block);
      if (found >= first) {
        Json place = Json::object();
        setPlace(place, *unit, block.begin, block.end);
        places.push_back(std::move(place));
      }
      line = std::max<int64_t>(line + 1, unit->source.lines().lineOf(block.end) + 1);
    }
  });
  return Json{{"breakpoints", std::move(places)}};
}

} // namespace ncvet::dap
