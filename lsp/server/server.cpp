// The language server: initialization, what it can do, and the loop that takes messages.
#include "lsp/server/server.h"

#include "formats/packed/shipped.h"
#include "formats/text/file_uri.h"
#include "formats/text/system/system.h"
#include "lsp/server/bindings.h"

#include "llvm/ADT/StringExtras.h"

#include <set>

namespace ncvet::lsp {

namespace {

constexpr int nobody =
    -1; ///< a descriptor from which nothing is read, or to which nothing is written

/// A member of nested objects; null when one of them is absent.
Json lookUp(const Json &object, std::initializer_list<const char *> names) {
  const Json *at = &object;
  for (const char *name : names) {
    if (!at->is_object())
      return nullptr;
    const auto found = at->find(name);
    if (found == at->end())
      return nullptr;
    at = &*found;
  }
  return *at;
}

bool says(const Json &object, std::initializer_list<const char *> names) {
  const Json value = lookUp(object, names);
  return value.is_boolean() && value.get<bool>();
}

ClientSupport readSupport(const Json &capabilities) {
  ClientSupport client;
  const auto has = [&](std::initializer_list<const char *> names) {
    return says(capabilities, names);
  };
  // The client names them in the order of its preference.
  for (const Json &name : lookUp(capabilities, {"general", "positionEncodings"}))
    if (name.is_string())
      if (const auto known = parsePositionEncoding(name.get<std::string>())) {
        client.encoding = *known;
        break;
      }
  client.diagnostics.related = has({"textDocument", "publishDiagnostics", "relatedInformation"}) ||
                               has({"textDocument", "diagnostic", "relatedInformation"});
  client.diagnostics.tags =
      lookUp(capabilities, {"textDocument", "publishDiagnostics", "tagSupport"}).is_object() ||
      lookUp(capabilities, {"textDocument", "diagnostic", "tagSupport"}).is_object();
  client.diagnostics.codeLink =
      has({"textDocument", "publishDiagnostics", "codeDescriptionSupport"}) ||
      has({"textDocument", "diagnostic", "codeDescriptionSupport"});
  client.pullsDiagnostics = lookUp(capabilities, {"textDocument", "diagnostic"}).is_object();
  client.takesRelatedDocuments = has({"textDocument", "diagnostic", "relatedDocumentSupport"});
  client.registersDiagnostics = has({"textDocument", "diagnostic", "dynamicRegistration"});
  for (const Json &name :
       lookUp(capabilities, {"textDocument", "codeAction", "resolveSupport", "properties"}))
    client.resolvesEdits |= name == "edit";
  for (const Json &name :
       lookUp(capabilities, {"textDocument", "inlayHint", "resolveSupport", "properties"}))
    client.resolvesHints |= name == "tooltip";
  client.annotatesChanges =
      has({"workspace", "workspaceEdit", "documentChanges"}) &&
      lookUp(capabilities, {"workspace", "workspaceEdit", "changeAnnotationSupport"}).is_object();
  client.showsControl = has({"experimental", "ncvet", "control"});
  client.refreshesDiagnostics = has({"workspace", "diagnostics", "refreshSupport"});
  client.progress = has({"window", "workDoneProgress"});
  client.configuration = has({"workspace", "configuration"});
  client.watchesFiles = has({"workspace", "didChangeWatchedFiles", "dynamicRegistration"});
  client.snippets = has({"textDocument", "completion", "completionItem", "snippetSupport"});
  client.labelDetails =
      has({"textDocument", "completion", "completionItem", "labelDetailsSupport"});
  for (const Json &name :
       lookUp(capabilities, {"textDocument", "completion", "completionList", "itemDefaults"}))
    client.sharesEditRange |= name == "editRange";
  for (const Json &format : lookUp(capabilities, {"textDocument", "hover", "contentFormat"}))
    client.markdown |= format == "markdown";
  client.nestedSymbols =
      has({"textDocument", "documentSymbol", "hierarchicalDocumentSymbolSupport"});
  client.lineFoldingOnly = has({"textDocument", "foldingRange", "lineFoldingOnly"});
  if (has({"workspace", "workspaceEdit", "documentChanges"}))
    for (const Json &name :
         lookUp(capabilities, {"workspace", "workspaceEdit", "resourceOperations"})) {
      client.renamesFiles |= name == "rename";
      client.createsFiles |= name == "create";
    }
  client.refreshesTokens = has({"workspace", "semanticTokens", "refreshSupport"});
  client.refreshesHints = has({"workspace", "inlayHint", "refreshSupport"});
  client.refreshesLenses = has({"workspace", "codeLens", "refreshSupport"});
  return client;
}

/// Files that may be named after the program in them.
Json filesOfPrograms() {
  std::set<std::string> endings;
  for (const DialectSummary &dialect : shippedDialects())
    endings.insert(dialect.extensions.begin(), dialect.extensions.end());
  const std::string glob = "**/*.{" + llvm::join(endings, ",") + "}";
  return {
      {{"scheme", "file"},
       {"pattern", {{"glob", glob}, {"matches", "file"}, {"options", {{"ignoreCase", true}}}}}}};
}

Json capabilities(const Context &context) {
  const ClientSupport &client = context.client;
  Json can = {
      {"positionEncoding", toString(client.encoding).str()},
      {"textDocumentSync",
       {{"openClose", true}, {"change", 2}, {"save", {{"includeText", false}}}}},
      {"hoverProvider", true},
      {"definitionProvider", true},
      {"declarationProvider", true},
      {"implementationProvider", true},
      {"inlineValueProvider", true},
      {"referencesProvider", {{"workDoneProgress", true}}},
      {"linkedEditingRangeProvider", true},
      {"documentHighlightProvider", true},
      {"documentSymbolProvider", true},
      {"workspaceSymbolProvider", {{"workDoneProgress", true}}},
      {"foldingRangeProvider", true},
      {"selectionRangeProvider", true},
      {"documentLinkProvider", Json::object()},
      {"callHierarchyProvider", true},
      {"renameProvider", {{"prepareProvider", true}}},
      {"documentFormattingProvider", true},
      {"documentRangeFormattingProvider", true},
      {"documentOnTypeFormattingProvider", {{"firstTriggerCharacter", "\n"}}},
      {"completionProvider",
       {{"triggerCharacters", {"G", "M", "L", "(", ",", "#", "<", "$"}},
        {"resolveProvider", true}}},
      {"signatureHelpProvider", {{"triggerCharacters", {"(", ",", ";", " "}}}},
      {"inlayHintProvider", {{"resolveProvider", true}}},
      {"codeLensProvider", {{"resolveProvider", true}}},
      {"semanticTokensProvider",
       {{"legend", tokensLegend()}, {"full", {{"delta", true}}}, {"range", true}}},
      {"codeActionProvider",
       {{"codeActionKinds",
         {"quickfix", "refactor.rewrite.ncvet", "refactor.inline.ncvet", "refactor.extract.ncvet",
          "source.fixAll.ncvet", "source.explain.ncvet"}},
        {"resolveProvider", true}}},
      {"executeCommandProvider", {{"commands", {"ncvet.explain", "ncvet.transform"}}}},
      {"workspace",
       {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}},
        {"fileOperations", {{"willRename", {{"filters", filesOfPrograms()}}}}}}},
      {"experimental", {{"ncvet", {{"path", true}}}}},
  };
  if (client.pullsDiagnostics && !client.registersDiagnostics)
    can["diagnosticProvider"] = context.diagnosticOptions();
  return can;
}

} // namespace

class Server {
public:
  Server(int in, int out, llvm::StringRef version)
      : reader_(in), writer_(out), context_(writer_), version_(version.str()) {
    bindLifeCycle();
    bindDocuments(context_);
    bindDiagnostics(context_);
    bindActions(context_);
    bindHover(context_);
    bindNavigation(context_);
    bindWriting(context_);
    bindEditing(context_);
    bindPaths(context_);
  }

  std::vector<std::string> requestMethods() const { return context_.rpc.requestMethods(); }

  void take(llvm::StringRef body) { context_.rpc.handle(body); }

  std::optional<std::chrono::milliseconds> work() {
    const auto until = context_.doNext();
    if (!until)
      return std::nullopt;
    return std::chrono::ceil<std::chrono::milliseconds>(*until);
  }

  std::optional<int> exitCode() const {
    if (!exited_ && !writer_.isBroken())
      return std::nullopt;
    return shutdown_ ? 0 : 1;
  }

  int run() {
    std::string body;
    while (!exited_) {
      switch (reader_.read(body)) {
      case MessageReader::Result::Message:
        take(body);
        break;
      case MessageReader::Result::Bad:
        context_.rpc.complain(RpcError::ParseError, body);
        break;
      case MessageReader::Result::End:
        exited_ = true;
        break;
      }
      if (writer_.isBroken())
        exited_ = true;
    }
    return shutdown_ ? 0 : 1;
  }

private:
  void bindLifeCycle() {
    Rpc &rpc = context_.rpc;
    rpc.setGate([this](llvm::StringRef method, Reply &reply) {
      if (shutdown_ && method != "shutdown") // some clients say it twice
        reply.fail(RpcError::InvalidRequest, "the server has been shut down");
      else if (!initialized_ && method != "initialize")
        reply.fail(RpcError::ServerNotInitialized, "initialize comes first");
      else
        return false;
      return true;
    });
    rpc.onRequest("initialize", [this](const Json &params, Reply reply) {
      initialize(params, std::move(reply));
    });
    rpc.onNotification("initialized", [this](const Json &) {
      registerWatchers();
      context_.registerDiagnostics();
    });
    rpc.onRequest("shutdown", [this](const Json &, Reply reply) {
      shutdown_ = true;
      context_.checks->stop();
      reply(nullptr);
    });
    rpc.onNotification("exit", [this](const Json &) { exited_ = true; });
    rpc.onNotification("$/setTrace", [](const Json &) {});
  }

  void initialize(const Json &params, Reply reply) {
    if (initialized_)
      return reply.fail(RpcError::InvalidRequest, "initialize comes once");
    context_.client = readSupport(lookUp(params, {"capabilities"}));
    context_.documents.setEncoding(context_.client.encoding);
    for (const Json &folder : lookUp(params, {"workspaceFolders"}))
      if (const Json uri = lookUp(folder, {"uri"}); uri.is_string())
        context_.folders.push_back(pathOfUri(uri.get<std::string>()));
    if (const Json root = lookUp(params, {"rootUri"}); context_.folders.empty() && root.is_string())
      context_.folders.push_back(pathOfUri(root.get<std::string>()));
    std::vector<std::string> wrong;
    context_.initialOptions = lookUp(params, {"initializationOptions"});
    context_.givenOptions = context_.initialOptions;
    context_.settings = readSettings(context_.givenOptions, wrong);
    initialized_ = true;
    reply({{"capabilities", capabilities(context_)},
           {"serverInfo", {{"name", "ncvet"}, {"version", version_}}}});
    for (const std::string &why : wrong)
      context_.warn(why);
  }

  void registerWatchers() {
    if (!context_.client.watchesFiles)
      return;
    Json watchers = Json::array();
    watchers.push_back({{"globPattern", "**/*"}});
    context_.rpc.request("client/registerCapability",
                         {{"registrations",
                           {{{"id", "ncvet-files"},
                             {"method", "workspace/didChangeWatchedFiles"},
                             {"registerOptions", {{"watchers", std::move(watchers)}}}}}}},
                         nullptr);
  }

  MessageReader reader_;
  MessageWriter writer_;
  Context context_;
  std::string version_;
  bool initialized_ = false, shutdown_ = false, exited_ = false;
};

EventServer::EventServer(int out, llvm::StringRef version)
    : server_(std::make_unique<Server>(nobody, out, version)) {}

EventServer::~EventServer() = default;

void EventServer::take(llvm::StringRef body) { server_->take(body); }

std::optional<std::chrono::milliseconds> EventServer::work() { return server_->work(); }

std::optional<int> EventServer::exitCode() const { return server_->exitCode(); }

int serve(int in, int out, llvm::StringRef version) {
  // A client that goes away is seen when it is written to.
  system::ignoreBrokenPipes();
  return Server(in, out, version).run();
}

std::vector<std::string> answeredRequests() { return Server(nobody, nobody, "").requestMethods(); }

} // namespace ncvet::lsp
