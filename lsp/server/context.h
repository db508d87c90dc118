// What all parts of the server share, and how a request comes to the text that it is about.
#pragma once

#include "lsp/features/snapshot.h"
#include "lsp/protocol/places.h"
#include "lsp/server/problem_board.h"
#include "lsp/server/settings.h"
#include "lsp/server/worker.h"
#include "lsp/transport/rpc.h"

namespace ncvet::lsp {

/// What the client said at the start that the server's answers depend on.
struct ClientSupport {
  PositionEncoding encoding = PositionEncoding::Utf16;
  DiagnosticSupport diagnostics;
  bool pullsDiagnostics = false;
  bool refreshesDiagnostics = false;
  bool progress = false;
  bool configuration = false;
  bool watchesFiles = false;
  bool snippets = false;
  bool sharesEditRange = false; ///< of completions: what they replace is said once for all
  bool markdown = false;
  bool nestedSymbols = false;
  bool lineFoldingOnly = false;
  bool refreshesTokens = false, refreshesHints = false, refreshesLenses = false;
};

/// The reply `ContentModified`.
inline const Json outdated = Json(Json::value_t::discarded);

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

  /// Paths of all programs of the workspace, as the editor's settings and configurations have it.
  std::vector<std::string> programs() const;
  /// The states at the block that holds `offset`.
  DocumentStates statesAt(uint32_t offset);

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
  Context(MessageWriter &writer);
  ~Context();

  /// Binds a request about one document: `answer` runs on the thread of features.
  void onDocument(llvm::StringRef method, std::function<Json(View &, const Json &params)> answer);
  /// Runs `answer` for `document` on the thread of features and gives what it returns; `outdated`
  /// says that the document has changed meanwhile.
  void answerFor(const Document &document, Reply reply, std::function<Json(View &)> answer);
  /// The same; an error is one that the user reads.
  void answerOrFail(const Document &document, Reply reply,
                    std::function<llvm::Expected<Json>(View &)> answer);
  /// Reads all of a long document on the thread of features while it is checked, so that the first
  /// question about this version need not wait for that.
  void prepare(const Document &document);
  /// Begins the check of a document, as it is now.
  void check(const Document &document);
  void checkAll();
  /// Takes these settings, or the same again after a file that they come from has changed, and
  /// checks everything anew. The user is warned of what is wrong with them.
  void renew(Json options);
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
  void log(const llvm::Twine &line) const;
  /// `window/showMessage` with a warning.
  void warn(const llvm::Twine &message);

  Rpc rpc; ///< answers and notifications may be sent from any thread
  ClientSupport client;
  std::vector<std::string> folders; ///< paths of the workspace's folders
  Documents documents{PositionEncoding::Utf16};
  Json initialOptions; ///< settings of the start; what the client says later goes before them
  Json givenOptions;   ///< what `settings` are read from
  Settings settings;
  ProblemBoard problems; ///< safe for several threads
  std::atomic<bool> wantsRefresh = false;
  std::unique_ptr<Checks> checks;
  std::unique_ptr<Worker> features;

private:
  struct Kept {
    std::shared_ptr<const std::string> text;
    std::shared_ptr<Session> session;
    std::shared_ptr<const SourceSet::Overlay> overlay;
    std::shared_ptr<Snapshot> snapshot;
  };
  /// Runs `answer`, which replies, on the thread of features; after a crash, replies that.
  void answerGuarded(Reply &reply, const std::string &path, llvm::function_ref<void()> answer);
  /// Of the thread of features: the snapshots that were used last.
  llvm::Expected<std::shared_ptr<Snapshot>> snapshotOf(const CheckJob &job);
  std::list<Kept> kept_;
  std::atomic<uint64_t> prepared_ = 0; ///< documents that were to be looked at
  /// Of the thread of features, by path: the indexes of the snapshots. No program is followed here.
  std::map<std::string, CheckMemory> indexes_;
  std::map<std::string, std::shared_ptr<Session>> sessions_; ///< by dialect
};

} // namespace ncvet::lsp
