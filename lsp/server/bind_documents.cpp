// Documents as the client opens, changes and closes them; settings and files that change.
#include "formats/text/file_uri.h"
#include "lsp/server/bindings.h"

#include "llvm/Support/Path.h"

namespace ncvet::lsp {

namespace {

/// Programs that call the document's text are checked again with it.
void checkWithUsers(Context &context, const Document &document) {
  context.check(document);
  for (const std::string &user : context.problems.usersOf(document.path))
    for (const auto &[uri, other] : context.documents.all())
      if (other.path == user)
        context.check(other);
}

/// Of a document as the client counts; some say null where they count nothing.
int64_t versionOf(const Json &document, int64_t before) {
  const auto version = document.find("version");
  return version != document.end() && version->is_number_integer() ? version->get<int64_t>()
                                                                   : before;
}

void open(Context &context, const Json &params) {
  const Json &item = params.at("textDocument");
  Document document;
  document.uri = item.at("uri");
  document.path = pathOfUri(document.uri);
  document.language = item.value("languageId", "");
  document.version = versionOf(item, 0);
  document.text = textOf(item.at("text").get<std::string>());
  const auto [language, isFirst] = context.languages.emplace(document.path, document.language);
  if (!isFirst && std::exchange(language->second, document.language) != document.language)
    context.wantsRefresh = true; // the client has findings of another control
  const Document &opened = context.documents.open(std::move(document));
  checkWithUsers(context, opened);
  context.prepare(opened);
}

void change(Context &context, const Json &params) {
  const Json &item = params.at("textDocument");
  const std::string uri = item.at("uri");
  const Document *document = context.documents.find(uri);
  if (document)
    document = context.documents.change(uri, versionOf(item, document->version),
                                        params.at("contentChanges"));
  if (document) {
    checkWithUsers(context, *document);
    context.prepare(*document);
  } else {
    context.log("a change of a document that is not open: " + uri);
  }
}

void close(Context &context, const Json &params) {
  const std::string uri = params.at("textDocument").at("uri");
  const Document *document = context.documents.find(uri);
  if (!document)
    return;
  const std::string path = document->path;
  const std::vector<std::string> users = context.problems.usersOf(path);
  context.documents.close(uri);
  context.checks->use(context.documents.overlay());
  context.forget(path);
  for (const std::string &user : users)
    for (const auto &[otherUri, other] : context.documents.all())
      if (other.path == user)
        context.check(other);
}

/// Checks again what depends on files that were written, made or removed.
void filesChanged(Context &context, llvm::ArrayRef<std::string> paths) {
  if (llvm::any_of(paths, [&](const std::string &path) { return context.setupsDependOn(path); }))
    return context.renew(context.givenOptions);
  context.forgetFiles();
  const auto concerns = [&](const Document &document) {
    const llvm::StringRef folder = llvm::sys::path::parent_path(document.path);
    return llvm::any_of(paths, [&](const std::string &path) {
      return path != document.path && (llvm::sys::path::parent_path(path) == folder ||
                                       context.problems.uses(document.path, path));
    });
  };
  for (const auto &[uri, document] : context.documents.all())
    if (concerns(document))
      context.check(document);
}

/// Takes settings that came after the start: what they leave out is as it was said there.
void configure(Context &context, const Json &section) {
  if (!section.is_object())
    return;
  Json all = context.initialOptions.is_object() ? context.initialOptions : Json::object();
  all.update(section, /*merge_objects=*/true);
  context.renew(std::move(all));
}

void fetchSettings(Context &context) {
  Json items = Json::array();
  items.push_back({{"section", "ncvet"}});
  context.rpc.request("workspace/configuration", {{"items", std::move(items)}},
                      [&context](const Json &answer, bool failed) {
                        if (!failed && answer.is_array() && !answer.empty())
                          configure(context, answer[0]);
                      });
}

void changeFolders(Context &context, const Json &params) {
  const Json &event = params.at("event");
  for (const Json &removed : event.at("removed"))
    llvm::erase_value(context.folders, pathOfUri(removed.at("uri").get<std::string>()));
  for (const Json &added : event.at("added"))
    context.folders.push_back(pathOfUri(added.at("uri").get<std::string>()));
}

} // namespace

void bindDocuments(Context &context) {
  Rpc &rpc = context.rpc;
  rpc.onNotification("textDocument/didOpen", [&](const Json &params) { open(context, params); });
  rpc.onNotification("textDocument/didChange",
                     [&](const Json &params) { change(context, params); });
  rpc.onNotification("textDocument/didClose", [&](const Json &params) { close(context, params); });
  // A new file may answer a call.
  rpc.onNotification("textDocument/didSave", [&](const Json &params) {
    filesChanged(context, {pathOfUri(params.at("textDocument").at("uri").get<std::string>())});
  });
  rpc.onNotification("workspace/didChangeWatchedFiles", [&](const Json &params) {
    std::vector<std::string> paths;
    for (const Json &change : params.at("changes"))
      paths.push_back(pathOfUri(change.at("uri").get<std::string>()));
    filesChanged(context, paths);
  });
  rpc.onNotification("workspace/didChangeConfiguration", [&](const Json &params) {
    if (context.client.configuration)
      fetchSettings(context);
    else if (params.is_object() && params.contains("settings") && params["settings"].is_object())
      configure(context, params["settings"].value("ncvet", Json()));
  });
  rpc.onNotification("workspace/didChangeWorkspaceFolders",
                     [&](const Json &params) { changeFolders(context, params); });
}

} // namespace ncvet::lsp
