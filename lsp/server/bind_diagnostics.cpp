// Pull diagnostics: of one document with the files that it calls, and of the whole workspace.
#include "analyzer/inputs.h"
#include "lsp/protocol/uri.h"
#include "lsp/server/bindings.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/xxhash.h"

namespace ncvet::lsp {

namespace {

std::string resultId(const Json &diagnostics) {
  return llvm::utohexstr(
      llvm::xxHash64(diagnostics.dump(-1, ' ', false, Json::error_handler_t::replace)));
}

/// A report in full, or that it is what the client has already.
Json report(Json diagnostics, const std::string &previous) {
  std::string id = resultId(diagnostics);
  if (id == previous)
    return {{"kind", "unchanged"}, {"resultId", std::move(id)}};
  return {{"kind", "full"}, {"resultId", std::move(id)}, {"items", std::move(diagnostics)}};
}

Json ofDocument(Context &context, View &view, const Json &params) {
  const auto result = context.checks->wait(view.document, view.cancelled);
  if (!result)
    return outdated;
  // The thread of checks puts results on the board behind those that wait for them.
  context.problems.take(result);
  const std::string &path = view.document.path;
  Json answer = report(context.problems.diagnostics(path), params.value("previousResultId", ""));
  for (const std::string &file : context.problems.relatedTo(path)) {
    Json items = context.problems.diagnostics(file);
    answer["relatedDocuments"][uriOfPath(file)] = {
        {"kind", "full"}, {"resultId", resultId(items)}, {"items", std::move(items)}};
  }
  return answer;
}

/// Checks programs of the workspace that are not open, and remembers them until files change.
class WorkspaceChecks {
public:
  Json report(const CheckJob &base, llvm::ArrayRef<std::string> folders, const Json &params,
              ProblemBoard &board, const std::atomic<bool> &cancelled) {
    if (base.session != session_) {
      session_ = base.session;
      closed_.clear();
    }
    std::map<std::string, std::string> previous;
    for (const Json &known : params.value("previousResultIds", Json::array()))
      previous[known.at("uri")] = known.at("value");
    Json items = Json::array();
    for (const Input &input : collectInputs(folders, *base.session).files) {
      if (cancelled)
        break;
      const bool open = base.overlay->count(input.path);
      Json diagnostics = open ? board.diagnostics(input.path) : ofFile(base, input.path, cancelled);
      const std::string uri = uriOfPath(input.path);
      Json one = lsp::report(std::move(diagnostics), previous[uri]);
      one["uri"] = uri;
      one["version"] = nullptr;
      items.push_back(std::move(one));
    }
    return {{"items", std::move(items)}};
  }

private:
  Json ofFile(const CheckJob &base, const std::string &path, const std::atomic<bool> &cancelled) {
    const auto [entry, isNew] = closed_.try_emplace(path);
    if (!isNew)
      return entry->second;
    auto text = llvm::MemoryBuffer::getFile(path, /*IsText=*/false);
    CheckJob job = base;
    job.document = {uriOfPath(path), path, "", 0, nullptr};
    std::shared_ptr<const CheckResult> result;
    if (text) {
      job.document.text = std::make_shared<const std::string>((*text)->getBuffer().str());
      result = check(job, &cancelled);
    }
    entry->second = Json::array();
    if (!result && cancelled) {
      closed_.erase(path);
      return Json::array();
    }
    for (const Problem &problem : result ? result->problems : std::vector<Problem>())
      if (problem.path == path)
        entry->second.push_back(problem.diagnostic);
    return entry->second;
  }

  std::shared_ptr<Session> session_; ///< under which the files were checked
  std::map<std::string, Json> closed_;
};

} // namespace

void bindDiagnostics(Context &context) {
  context.onDocument("textDocument/diagnostic", [&context](View &view, const Json &params) {
    return ofDocument(context, view, params);
  });
  auto workspace = std::make_shared<WorkspaceChecks>(); // of the thread of features
  context.rpc.onRequest(
      "workspace/diagnostic", [&context, workspace](const Json &params, Reply reply) {
        if (!context.settings.workspaceDiagnostics)
          return reply({{"items", Json::array()}});
        auto held = std::make_shared<Reply>(std::move(reply));
        context.features->post([&context, workspace, held, params, job = context.job(Document()),
                                folders = context.folders] {
          (*held)(workspace->report(job, folders, params, context.problems, held->cancelled()));
        });
      });
}

} // namespace ncvet::lsp
