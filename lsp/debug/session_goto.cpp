// One debugging session: blocks that the run is sent to.
#include "analyzer/program/block_reading.h"
#include "formats/text/failure.h"
#include "lsp/debug/debug_session.h"
#include "lsp/debug/session_json.h"

namespace ncvet::dap {

namespace {

/// Targets that are kept: one is asked for at each click of the user.
constexpr size_t mostTargets = 10000;

} // namespace

/// The block at the line, or the first one after it.
llvm::Expected<Json> DebugSession::gotoTargets(const Json &arguments) {
  const std::string path = pathIn(arguments.at("source"), "path");
  const int64_t line = fromClient(numberOf(arguments, "line", -1), linesStartAt1_);
  Json targets = Json::array();
  whileStill([&] {
    FileUnit *const unit = program_->unitOf(path);
    const auto at = unit && line > 0 && line < std::numeric_limits<uint32_t>::max()
                        ? blockFromLine(*unit, uint32_t(line))
                        : std::nullopt;
    if (!at)
      return;
    if (targets_.size() == mostTargets)
      targets_.clear();
    targets_.emplace_back(unit->source.id(), *at);
    Block block;
    unit->reader->read(*at, block);
    Json target = {{"id", targets_.size()},
                   {"label", "run to line " + std::to_string(unit->source.lines().lineOf(*at))}};
    setPlace(target, *unit, block.begin, block.end);
    targets.push_back(std::move(target));
  });
  return Json{{"targets", std::move(targets)}};
}

void DebugSession::bindGoto() {
  channel_.on("gotoTargets", [this](const Json &arguments) -> llvm::Expected<Json> {
    if (!program_)
      return failure("no program is launched");
    return gotoTargets(arguments);
  });
  channel_.on("goto", [this](const Json &arguments) -> llvm::Expected<Json> {
    if (llvm::Error wrong = needStop())
      return wrong;
    const int64_t id = numberOf(arguments, "targetId", 0);
    if (id < 1 || id > int64_t(targets_.size()))
      return failure("there is no such target");
    channel_.afterResponse([this, target = targets_[size_t(id - 1)]] { run_->goTo(target); });
    return Json();
  });
}

} // namespace ncvet::dap
