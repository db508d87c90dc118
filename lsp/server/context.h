// What all parts of the server share, and how a request comes to the text that it is about.
#pragma once

#include "lsp/features/snapshot.h"
#include "lsp/protocol/places.h"
#include "lsp/server/problem_board.h"
#include "lsp/server/settings.h"
#include "lsp/server/setup_notices.h"
#include "lsp/server/worker.h"
#include "lsp/transport/rpc.h"

#include <list>
#include <map>
#include <set>

namespace ncvet::lsp {

class LivePaths;    // lsp/server/live_paths.h
class StatesInTime; // lsp/server/states_in_time.h

/// What the client said at the start that the server's answers depend on.
struct ClientSupport {
  PositionEncoding encoding = PositionEncoding::Utf16;
  DiagnosticSupport diagnostics;
  bool pullsDiagnostics = false;
  bool takesRelatedDocuments = false; ///< with the diagnostics of a document that it pulls
  bool registersDiagnostics = false;  ///< pull diagnostics may be registered later
  bool showsControl = false;          ///< takes `ncvet/control`
  bool resolvesEdits = false;         ///< the edit of a code action may come when it is chosen
  bool resolvesHints = false;         ///< what explains a hint may come when it is looked at
  bool annotatesChanges = false;      ///< a `WorkspaceEdit` may say what its edits are
  bool refreshesDiagnostics = false;
  bool progress = false;
  bool configuration = false;
  bool watchesFiles = false;
  bool snippets = false;
  bool sharesEditRange = false; ///< of completions: what they replace is said once for all
  bool labelDetails = false;    ///< of completions
  bool markdown = false;
  bool nestedSymbols = false;
  bool lineFoldingOnly = false;
  bool renamesFiles = false; ///< in a `WorkspaceEdit`
  bool createsFiles = false; ///< in a `WorkspaceEdit`
  bool refreshesTokens = false, refreshesHints = false, refreshesLenses = false;
};

/// A document under its setup, for the time of one request.
struct View {
  const Document &document;
  Snapshot &snapshot;
  Positions &positions;
  const Settings &settings;
  const ClientSupport &client;
  const std::atomic<bool> &cancelled;
  Places &places; ///< of all files of the snapshot's project
  Session &session;
  llvm::ArrayRef<std::string> folders; ///< of the workspace
  const CheckJob &job;                 ///< what a check of the document needs
  StatesInTime &states;

  /// Paths of all programs of the workspace, as the editor's settings and configurations have it.
  std::vector<std::string> programs() const;
  /// The states at the block that holds `offset`; null: they are not known in time.
  std::shared_ptr<const DocumentStates> statesAt(uint32_t offset);

  uint32_t offset(const Json &params) const {
    return positions.offset(positionOf(params.at("position")));
  }
  std::pair<uint32_t, uint32_t> range(const Json &params) const {
    return offsetsOf(positions, params.at("range"));
  }
};

/// The server's parts. All members belong to the thread that takes messages, but for those that
/// say that they are safe for several.
class Context {
public:
  using Answer = std::function<llvm::Expected<Json>(View &)>;

  Context(MessageWriter &writer);
  ~Context();

  /// Binds a request about one document: `answer` runs on the thread of features.
  void onDocument(llvm::StringRef method, std::function<Json(View &, const Json &params)> answer);
  /// Runs `answer` for `document` on the thread of features and gives what it returns.
  void answerFor(const Document &document, Reply reply, std::function<Json(View &)> answer);
  /// The same; an error is one that the user reads.
  void answerOrFail(const Document &document, Reply reply, Answer answer);
  /// The same, when the check of this version is over: nothing else waits for that. `before` may
  /// find something that is to be done first, on the thread for what takes long.
  void answerAfterCheck(const Document &document, Reply reply, Answer answer,
                        std::function<Worker::Task(View &)> before = nullptr);
  /// Runs `answer` with what the check of this version has found, on the thread that waits for
  /// checks.
  void withCheck(const Document &document, Reply reply,
                 std::function<Json(const CheckResult &)> answer);
  /// Reads all of a long document on the thread of features while it is checked, so that the first
  /// question about this version need not wait for that.
  void prepare(const Document &document);
  /// Begins the check of a document, as it is now.
  void check(const Document &document);
  void checkAll();
  /// Takes these settings, or the same again after a file that they come from has changed, and
  /// checks everything anew. The user is warned of what is wrong with them.
  void renew(Json options);
  /// How documents are pulled, as the settings have it now. The client is told where it lets itself
  /// be told; `workspace/diagnostic` is asked for ever where it is offered.
  void registerDiagnostics();
  Json diagnosticOptions() const;
  /// Whether setups come from the file, see `Session::dependsOn`.
  bool setupsDependOn(const std::string &path) const;
  /// Which programs lie in which folder is looked up again.
  void forgetFiles();
  /// The session for a document: of its own when its language names a control, which counts unless
  /// settings or a configuration name one.
  std::shared_ptr<Session> session(const Document &document);
  CheckJob job(const Document &document);
  /// The document is closed: what is kept of it is given back.
  void forget(const std::string &path);
  /// Without threads: does the next piece of what threads do elsewhere. How long it is until there
  /// is more; none: until a message comes.
  std::optional<Checks::Clock::duration> doNext();
  void log(const llvm::Twine &line) const;
  /// Why a document has no setup. The user is told, once.
  void tellSetup(llvm::StringRef error);
  /// `window/showMessage` with a warning, which is in the log as well.
  void warn(const llvm::Twine &message);
  void show(const llvm::Twine &warning);

  Rpc rpc; ///< answers and notifications may be sent from any thread
  ClientSupport client;
  std::vector<std::string> folders; ///< paths of the workspace's folders
  Documents documents{PositionEncoding::Utf16};
  std::map<std::string, std::string> languages; ///< by path, of documents when last opened
  Json initialOptions; ///< settings of the start; what the client says later goes before them
  Json givenOptions;   ///< what `settings` are read from
  Settings settings;
  ProblemBoard problems; ///< safe for several threads
  std::atomic<bool> wantsRefresh = false;
  SetupNotices setupNotices{rpc}; ///< safe for several threads
  std::unique_ptr<Checks> checks;
  std::unique_ptr<StatesInTime> states;
  std::unique_ptr<Worker> features;     ///< answers about one text
  std::unique_ptr<Worker> waiting;      ///< waits for checks
  std::unique_ptr<Worker> workspace;    ///< answers about all programs, which take long
  std::unique_ptr<LivePaths> livePaths; ///< of the thread that follows
  std::unique_ptr<Worker> paths;        ///< follows programs for those who look at their paths

private:
  struct Kept {
    std::shared_ptr<const std::string> text;
    std::shared_ptr<Session> session;
    std::shared_ptr<const SourceSet::Overlay> overlay;
    std::shared_ptr<Snapshot> snapshot;
  };
  /// `ncvet/control`: the control that a document was checked for, and why.
  void tellControl(const CheckResult &result);
  /// Tells the client what is known of a file now, in the way in which it wants to be told.
  void sendProblems(const ProblemBoard::ShownFile &file, llvm::StringRef diagnostics, bool own);
  /// A request about a document, with all that its answer needs.
  struct Asked {
    std::shared_ptr<Reply> reply; ///< a task is copied, a reply is not
    CheckJob job;
    Settings settings;
    std::vector<std::string> folders;
  };
  Asked asked(const Document &document, Reply reply);
  /// On the thread of features. `use` may reply.
  void withView(const Asked &asked, llvm::function_ref<void(View &)> use);
  void answerNow(const Asked &asked, const Answer &answer);
  /// On the thread for what takes long.
  void doFirst(const Asked &asked, const Worker::Task &task);
  /// Runs `answer`, which replies, on the thread of features; after a crash, replies that.
  void answerGuarded(Reply &reply, const std::string &path, llvm::function_ref<void()> answer);
  /// Of the thread of features: the snapshots that were used last.
  llvm::Expected<std::shared_ptr<Snapshot>> snapshotOf(const CheckJob &job);
  std::list<Kept> kept_;
  std::atomic<uint64_t> prepared_ = 0; ///< documents that were to be looked at
  /// Of the thread of features, by path: the indexes of the snapshots. No program is followed here.
  std::map<std::string, CheckMemory> indexes_;
  /// Whether all open documents get their setup; the user is told why not.
  bool givesSetups(Session &session);
  std::map<std::string, std::shared_ptr<Session>> sessions_; ///< by dialect
  /// By dialect those before, while it is not known whether the new ones work: a configuration that
  /// is being edited is wrong now and then, and its last right version counts.
  std::map<std::string, std::shared_ptr<Session>> former_;
  std::optional<bool> registeredWorkspace_; ///< none: pull diagnostics are not registered
  std::set<std::string> published_;         ///< closed files of which a client that pulls was told
};

} // namespace ncvet::lsp
