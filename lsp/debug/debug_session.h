// One debugging session: what the client asks for, bound to a dry run.
#pragma once

#include "lsp/debug/debug_channel.h"
#include "lsp/debug/dry_run.h"
#include "lsp/debug/state_view.h"
#include "lsp/features/names.h"

namespace ncvet::dap {

/// Binds the protocol's commands. The observer's functions run on the thread of the dry run, all
/// others on that of the messages.
class DebugSession final : public RunObserver {
public:
  explicit DebugSession(DebugChannel &channel);
  ~DebugSession() override;

  /// The client has said that it is done.
  bool isOver() const { return over_; }

private:
  void stopped(const Stop &stop) override;
  void said(const char *category, const std::string &text, const FileUnit &unit,
            uint32_t offset) override;
  void ended(bool complete) override;

  void bindLifeCycle();
  void bindBreakpoints();
  void bindMovement();
  void bindGoto();
  void bindInspection();

  Json initialize(const Json &arguments);
  llvm::Error readSettings();
  llvm::Error load();
  void begin();
  llvm::Error restart(const Json &arguments);
  llvm::Expected<Json> setBreakpoints(const Json &arguments);
  llvm::Expected<Json> setFunctionBreakpoints(const Json &arguments);
  llvm::Expected<Json> setExceptionBreakpoints(const Json &arguments);
  llvm::Expected<Json> breakpointLocations(const Json &arguments);
  llvm::Expected<Json> gotoTargets(const Json &arguments);
  Json placeBreakpoint(FileUnit *unit, const Json &wanted, int id);
  Json placeFunction(const Json &wanted, int id);
  Json placeAll(const std::string &path);
  Json placeFunctions();
  void placeAgain();
  llvm::Error needStop() const;
  llvm::Expected<Json> stackTrace(const Json &arguments);
  llvm::Expected<Json> scopes(const Json &arguments);
  llvm::Expected<Json> variables(const Json &arguments);
  llvm::Expected<Json> setVariable(const Json &arguments);
  llvm::Expected<Json> setExpression(const Json &arguments);
  llvm::Expected<Json> evaluate(const Json &arguments);
  llvm::Expected<Json> exceptionInfo(const Json &arguments);
  llvm::Expected<Json> loadedSources();

  llvm::Expected<const Frame *> frameOf(const Json &arguments) const;
  const MachineState &stateOf(const Frame &frame) const;
  const lsp::Names &namesOf(const FileUnit &unit);
  bool hasVariables(const FileUnit &unit);
  std::vector<NamedValue> programVariables(const Frame &frame);
  llvm::Expected<Json> changed(llvm::StringRef name, llvm::StringRef value);
  int64_t fromClient(int64_t number, bool startsAt1) const;
  uint32_t toClient(uint32_t number, bool startsAt1) const;
  /// The path of a file that the client names.
  std::string pathIn(const Json &object, const char *member) const;
  Json sourceOf(const FileUnit &unit) const;
  void setPlace(Json &at, const FileUnit &unit, uint32_t begin, uint32_t end) const;
  /// Changes breakpoints while the run does not look at them.
  void whileStill(const std::function<void()> &task);

  DebugChannel &channel_;
  std::unique_ptr<LoadedProgram> program_;
  Breakpoints breakpoints_;
  std::unique_ptr<DryRun> run_;
  RunSettings settings_;
  Json launchArguments_;
  bool linesStartAt1_ = true, columnsStartAt1_ = true;
  bool namesFilesByUri_ = false;
  bool isConfigured_ = false, over_ = false;
  bool isEnded_ = false; ///< the user has ended the program, and begun no other
  int lastBreakpoint_ = 0;
  /// What the client wants in one file, with the ids of the breakpoints: kept for a program that is
  /// loaded later, or again.
  struct Wishes {
    Json wanted = Json::array();
    std::vector<int> ids;
  };
  std::map<std::string, Wishes> wishes_; ///< by path
  Wishes functions_;
  /// Blocks that the run can be sent to, by the ids that the client was given less one.
  std::vector<Breakpoints::Place> targets_;
  Stop lastStop_;
  std::map<FileId, std::unique_ptr<lsp::Names>> names_; ///< of files whose variables were asked for
};

} // namespace ncvet::dap
