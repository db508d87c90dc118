// What all parts of the server share: sessions, snapshots and checks, and how a request reaches
// them.
#include "lsp/server/context.h"

#include "analyzer/setup/input_files.h"
#include "formats/text/crash_guard.h"
#include "formats/text/file_uri.h"
#include "lsp/features/showing/document_states.h"
#include "lsp/server/live_paths.h"
#include "lsp/server/states_in_time.h"

#include "llvm/Support/raw_ostream.h"

namespace ncvet::lsp {

namespace {

/// Snapshots that are kept: a few documents are at work at a time.
constexpr size_t mostSnapshots = 4;
/// A document of so many bytes is looked at before the first question: 20,000 blocks or more.
constexpr size_t longText = 512 * 1024;
/// Languages that name a control begin so: `ncvet-haas-lathe`.
constexpr llvm::StringLiteral languagePrefix = "ncvet-";

} // namespace

std::vector<std::string> View::programs() const {
  std::vector<std::string> paths;
  for (const Input &input : collectInputs(folders, session).files)
    paths.push_back(input.path);
  return paths;
}

std::shared_ptr<const DocumentStates> View::statesAt(uint32_t offset) {
  Block block;
  snapshot.readAt(offset, block);
  return states.at(job, block.begin, cancelled);
}

Context::Context(MessageWriter &writer)
    : rpc(writer), problems([this](const ProblemBoard::ShownFile &file, llvm::StringRef diagnostics,
                                   bool own) { sendProblems(file, diagnostics, own); }) {
  states = std::make_unique<StatesInTime>();
  features = std::make_unique<Worker>();
  waiting = std::make_unique<Worker>();
  workspace = std::make_unique<Worker>();
  livePaths = std::make_unique<LivePaths>();
  paths = std::make_unique<Worker>();
  checks = std::make_unique<Checks>([this](std::shared_ptr<const CheckResult> result) {
    if (!result->error.empty())
      tellSetup(result->error);
    tellControl(*result);
    problems.take(std::move(result));
    if (wantsRefresh.exchange(false) && client.refreshesDiagnostics)
      rpc.request("workspace/diagnostic/refresh", Json(), nullptr);
  });
}

/// What the user waits for comes first, what concerns all programs last.
std::optional<Checks::Clock::duration> Context::doNext() {
  constexpr auto atOnce = Checks::Clock::duration::zero();
  if (features->doNext() || waiting->doNext())
    return atOnce;
  const auto until = checks->doNext();
  if (until == atOnce || paths->doNext() || workspace->doNext())
    return atOnce;
  return until;
}

void Context::tellControl(const CheckResult &result) {
  if (client.showsControl && !result.dialect.empty())
    rpc.notify("ncvet/control", {{"uri", result.document.uri},
                                 {"dialect", result.dialect},
                                 {"title", result.dialectTitle},
                                 {"guessed", result.guessed},
                                 {"sure", result.sure},
                                 {"reason", result.reason}});
}

void Context::sendProblems(const ProblemBoard::ShownFile &file, llvm::StringRef diagnostics,
                           bool own) {
  std::optional<int64_t> version = file.version;
  if (client.pullsDiagnostics) {
    // The client asks for a document that it changed; of other open ones it has to be told.
    wantsRefresh = wantsRefresh || !own;
    // It asks for no closed file, and forgets one that it was told of only when it is told again.
    const bool open = version.has_value();
    if (client.takesRelatedDocuments || settings.workspaceDiagnostics)
      return;
    if (open && !published_.erase(file.path))
      return;
    if (open)
      diagnostics = "[]";
    else
      published_.insert(file.path);
    version.reset();
  }
  Json params = {{"uri", file.uri}};
  if (version)
    params["version"] = *version;
  std::string text = jsonText(params);
  text.pop_back();
  rpc.notifyText("textDocument/publishDiagnostics",
                 text + R"(,"diagnostics":)" + diagnostics.str() + "}");
}

Context::~Context() {
  // The threads use what is above them.
  checks->stop();
  waiting->stop();
  workspace->stop();
  paths->stop();
  features->stop();
  states->stop();
}

void Context::forget(const std::string &path) {
  checks->drop(path);
  states->forget(path);
  problems.closed(path);
  paths->post([this, path] { livePaths->forget(path); });
  features->post([this, path] {
    kept_.remove_if([&](const Kept &old) { return old.snapshot->source().path() == path; });
    indexes_.erase(path); // after the snapshot that looks into it
  });
}

void Context::log(const llvm::Twine &line) const {
  static std::mutex lines; // every thread has something to say
  const std::lock_guard<std::mutex> lock(lines);
  llvm::errs() << "ncvet: " + line + "\n";
}

void Context::tellSetup(llvm::StringRef error) {
  if (!setupNotices.add(error))
    return;
  log(error);
  show(SetupNotices::message(error));
}

void Context::warn(const llvm::Twine &message) {
  log(message);
  show(message);
}

void Context::show(const llvm::Twine &warning) {
  rpc.notify("window/showMessage", {{"type", 2}, {"message", warning.str()}});
}

std::shared_ptr<Session> Context::session(const Document &document) {
  SessionOptions options = settings.session;
  llvm::StringRef language = document.language;
  // Editors give it by the file's ending: a configuration knows better.
  if (language.consume_front(languagePrefix) && builtinDialects()(language))
    options.usualDialect = language.str();
  std::shared_ptr<Session> &session = sessions_[options.usualDialect];
  if (!session)
    session = std::make_shared<Session>(options);
  if (const auto former = former_.find(options.usualDialect);
      former != former_.end() && document.text.bytes) {
    if (!givesSetups(*session))
      session = former->second;
    former_.erase(former);
  }
  return session;
}

bool Context::givesSetups(Session &session) {
  bool all = true;
  for (const auto &[uri, document] : documents.all())
    if (auto setup = session.setup(document.path, *document.text.bytes); !setup) {
      tellSetup(llvm::toString(setup.takeError()));
      all = false;
    }
  return all;
}

void Context::forgetFiles() {
  for (const auto &[dialect, session] : sessions_)
    session->forgetFolders();
  documents.touch(); // snapshots that know the folders as they were are not used again
}

CheckJob Context::job(const Document &document) {
  return {document, session(document), documents.overlay(), client.encoding, client.diagnostics};
}

void Context::check(const Document &document) {
  problems.opened(document);
  states->textChanged(document.path);
  checks->schedule(job(document));
}

void Context::checkAll() {
  for (const auto &[uri, document] : documents.all())
    check(document);
}

bool Context::setupsDependOn(const std::string &path) const {
  if (setupNotices.any() && llvm::StringRef(path).endswith_insensitive(".json"))
    return true; // what was missing or wrong may be right now
  return path == settings.machineFile || llvm::any_of(sessions_, [&](const auto &session) {
           return session.second->dependsOn(path);
         });
}

void Context::renew(Json options) {
  givenOptions = std::move(options);
  std::vector<std::string> wrong;
  settings = readSettings(givenOptions, wrong);
  for (const std::string &why : wrong)
    warn(why);
  setupNotices.renew();
  for (auto &[dialect, session] : std::exchange(sessions_, {}))
    former_[dialect] = std::move(session);
  wantsRefresh = true; // the client has findings of the setups before
  registerDiagnostics();
  checkAll();
}

Json Context::diagnosticOptions() const {
  return {{"documentSelector", nullptr},
          {"identifier", "ncvet"},
          {"interFileDependencies", true},
          {"workDoneProgress", true},
          {"workspaceDiagnostics", !client.registersDiagnostics || settings.workspaceDiagnostics}};
}

void Context::registerDiagnostics() {
  if (!client.registersDiagnostics || registeredWorkspace_ == settings.workspaceDiagnostics)
    return;
  const Json which = {{"id", "ncvet-diagnostics"}, {"method", "textDocument/diagnostic"}};
  if (registeredWorkspace_)
    rpc.request("client/unregisterCapability", {{"unregisterations", Json::array({which})}},
                nullptr);
  registeredWorkspace_ = settings.workspaceDiagnostics;
  Json registration = which;
  registration["registerOptions"] = diagnosticOptions();
  rpc.request("client/registerCapability",
              {{"registrations", Json::array({std::move(registration)})}}, nullptr);
}

llvm::Expected<std::shared_ptr<Snapshot>> Context::snapshotOf(const CheckJob &job) {
  for (auto at = kept_.begin(); at != kept_.end(); ++at)
    if (at->text == job.document.text.bytes && at->session == job.session &&
        at->overlay == job.overlay && at->snapshot->source().path() == job.document.path) {
      kept_.splice(kept_.begin(), kept_, at);
      return at->snapshot;
    }
  auto made = Snapshot::make(*job.session, job.overlay, job.document.path, job.document.text,
                             &indexes_[job.document.path]);
  if (!made)
    return made.takeError();
  kept_.remove_if(
      [&](const Kept &old) { return old.snapshot->source().path() == job.document.path; });
  if (kept_.size() >= mostSnapshots)
    kept_.pop_back();
  kept_.push_front({job.document.text.bytes, job.session, job.overlay, std::move(*made)});
  return kept_.front().snapshot;
}

void Context::prepare(const Document &document) {
  if (document.text.bytes->size() < longText)
    return;
  features->post([this, job = job(document), number = ++prepared_] {
    if (number != prepared_) // another text is there already
      return;
    auto snapshot = snapshotOf(job);
    if (!snapshot)
      return llvm::consumeError(snapshot.takeError()); // whoever asks first is told
    FileUnit &unit = (*snapshot)->unit();
    for (const ProgramInfo &program : unit.index.programs())
      unit.index.definitions(program);
  });
}

void Context::answerFor(const Document &document, Reply reply, std::function<Json(View &)> answer) {
  answerOrFail(document, std::move(reply), [answer = std::move(answer)](View &view) {
    return llvm::Expected<Json>(answer(view));
  });
}

void Context::answerGuarded(Reply &reply, const std::string &path,
                            llvm::function_ref<void()> answer) {
  const auto crash = runGuarded(answer);
  if (!crash)
    return;
  log(path + ": a request failed: " + *crash);
  // What was being looked at can be neither used nor given back.
  for (Kept &kept : kept_)
    if (kept.snapshot->source().path() == path)
      new Kept(kept); // on purpose without an owner
  kept_.remove_if([&](const Kept &old) { return old.snapshot->source().path() == path; });
  indexes_[path].abandon();
  reply.fail(RpcError::InternalError, "the request failed: " + *crash);
}

Context::Asked Context::asked(const Document &document, Reply reply) {
  return {std::make_shared<Reply>(std::move(reply)), job(document), settings, folders};
}

void Context::withView(const Asked &asked, llvm::function_ref<void(View &)> use) {
  const auto &[held, job, settings, folders] = asked;
  if (held->cancelled())
    return held->fail(RpcError::RequestCancelled, "cancelled");
  answerGuarded(*held, job.document.path, [&, &held = held, &job = job] {
    auto snapshot = snapshotOf(job);
    if (!snapshot)
      return held->fail(RpcError::RequestFailed, llvm::toString(snapshot.takeError()));
    Places places((*snapshot)->project().sources(), client.encoding);
    places.spell((*snapshot)->source().id(), job.document.uri);
    View view{job.document,
              **snapshot,
              places.of((*snapshot)->source().id()),
              asked.settings,
              client,
              held->cancelled(),
              places,
              *job.session,
              asked.folders,
              job,
              *states};
    try {
      use(view);
    } catch (const Json::exception &) {
      held->fail(RpcError::InvalidParams, "the parameters are wrong");
    }
  });
}

void Context::answerNow(const Asked &asked, const Answer &answer) {
  withView(asked, [&](View &view) {
    auto json = answer(view);
    if (json)
      (*asked.reply)(std::move(*json));
    else
      asked.reply->fail(RpcError::RequestFailed, llvm::toString(json.takeError()));
  });
}

void Context::doFirst(const Asked &asked, const Worker::Task &task) {
  if (asked.reply->cancelled())
    return;
  if (const auto crash = runGuarded(task))
    log(asked.job.document.path + ": a request failed: " + *crash);
}

void Context::answerOrFail(const Document &document, Reply reply, Answer answer) {
  features->post([this, asked = asked(document, std::move(reply)), answer = std::move(answer)] {
    answerNow(asked, answer);
  });
}

void Context::answerAfterCheck(const Document &document, Reply reply, Answer answer,
                               std::function<Worker::Task(View &)> before) {
  const auto now = [this, answer = std::move(answer)](const Asked &asked) {
    answerNow(asked, answer);
  };
  waiting->post([this, asked = asked(document, std::move(reply)), now, before = std::move(before)] {
    checks->wait(asked.job.document, asked.reply->cancelled());
    features->post([this, asked, now, before] {
      Worker::Task first;
      if (before && !asked.reply->cancelled())
        withView(asked, [&](View &view) { first = before(view); });
      if (!first)
        return now(asked);
      workspace->post([this, asked, now, first] {
        doFirst(asked, first);
        features->post([asked, now] { now(asked); });
      });
    });
  });
}

void Context::withCheck(const Document &document, Reply reply,
                        std::function<Json(const CheckResult &)> answer) {
  waiting->post([this, asked = asked(document, std::move(reply)), answer = std::move(answer)] {
    Reply &held = *asked.reply;
    const auto result = checks->wait(asked.job.document, held.cancelled());
    if (held.cancelled())
      return held.fail(RpcError::RequestCancelled, "cancelled");
    if (!result)
      return held.fail(RpcError::ContentModified, "the document has changed");
    // The thread of checks puts results on the board after it has woken those that wait for them.
    problems.take(result);
    held(answer(*result));
  });
}

void Context::onDocument(llvm::StringRef method,
                         std::function<Json(View &, const Json &params)> answer) {
  rpc.onRequest(method, [this, answer = std::move(answer)](const Json &params, Reply reply) {
    const std::string uri = params.at("textDocument").at("uri");
    const Document *document = documents.find(uri);
    if (!document)
      return reply.fail(RpcError::InvalidParams, "the document is not open: " + uri);
    answerFor(*document, std::move(reply),
              [answer, params](View &view) { return answer(view, params); });
  });
}

} // namespace ncvet::lsp
