// Pull diagnostics: of one document with the files that it calls, and of the whole workspace.
#include "analyzer/setup/input_files.h"
#include "formats/text/file_uri.h"
#include "lsp/server/bindings.h"
#include "lsp/server/file_stamp.h"
#include "lsp/server/progress.h"
#include "lsp/transport/json_message.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/xxhash.h"

namespace ncvet::lsp {

namespace {

/// A report in full, or that it is what the client has already. `diagnostics`: a list as JSON.
Json report(const std::string &diagnostics, const std::string &previous) {
  std::string id = llvm::utohexstr(llvm::xxHash64(diagnostics));
  if (id == previous)
    return {{"kind", "unchanged"}, {"resultId", std::move(id)}};
  return {{"kind", "full"}, {"resultId", std::move(id)}, {"items", parseMessage(diagnostics)}};
}

Json ofDocument(Context &context, const std::string &path, const std::string &previous) {
  Json answer = report(context.problems.diagnostics(path), previous);
  if (context.client.takesRelatedDocuments)
    for (const std::string &file : context.problems.relatedTo(path))
      answer["relatedDocuments"][uriOfPath(file)] = report(context.problems.diagnostics(file), "");
  return answer;
}

/// Checks programs of the workspace that are not open, and keeps what it found as long as the files
/// that it looked at are what they were.
class WorkspaceChecks {
public:
  /// What was not sent as a part of the answer.
  Json report(const CheckJob &base, llvm::ArrayRef<std::string> folders, const Json &params,
              ProblemBoard &board, const std::atomic<bool> &cancelled, WorkDone &work,
              PartialAnswer &parts) {
    if (base.session != session_) {
      session_ = base.session;
      closed_.clear();
    }
    std::map<std::string, std::string> previous;
    for (const Json &known : params.value("previousResultIds", Json::array()))
      previous[known.at("uri")] = known.at("value");
    Json items = Json::array();
    const std::vector<Input> files = collectInputs(folders, *base.session).files;
    size_t done = 0;
    for (const Input &input : files) {
      if (cancelled)
        break;
      work.report(done++, files.size());
      const bool open = base.overlay->count(input.path);
      const std::string uri = uriOfPath(input.path);
      const std::string known = board.diagnostics(input.path);
      Json one = lsp::report(open ? known : merged(ofFile(base, input.path, cancelled), known),
                             previous[uri]);
      one["uri"] = uri;
      one["version"] = nullptr;
      items.push_back(std::move(one));
      if (parts.isWanted() && items.size() == filesOfPart)
        parts.send({{"items", std::exchange(items, Json::array())}});
    }
    return {{"items", std::move(items)}};
  }

private:
  /// A client that takes parts of an answer gets one for so many files.
  static constexpr size_t filesOfPart = 32;

  /// Lists of diagnostics in one, each once: a file's own check and those of its callers find the
  /// same, the latter with the call that leads there.
  static std::string merged(const std::string &own, const std::string &others) {
    if (others == "[]")
      return own;
    Json all = parseMessage(own);
    for (Json &other : parseMessage(others))
      if (llvm::none_of(all, [&](const Json &one) {
            return one["range"] == other["range"] && one["code"] == other["code"];
          }))
        all.push_back(std::move(other));
    return jsonText(all);
  }

  /// What a check of a closed file has found, and what it rests on.
  struct Kept {
    std::string diagnostics = "[]";          ///< a list as JSON
    std::shared_ptr<ProgramFolders> folders; ///< null: nothing was found out
    std::map<std::string, FileStamp> files;  ///< that it looked at

    /// Whether a check would find the same.
    bool holds(const CheckJob &job) const {
      if (!folders || folders != job.session->folders())
        return false;
      return llvm::all_of(files, [&](const auto &file) {
        return file.second == stampOf(file.first, *job.overlay);
      });
    }
  };

  const std::string &ofFile(const CheckJob &base, const std::string &path,
                            const std::atomic<bool> &cancelled) {
    Kept &kept = closed_[path];
    if (kept.holds(base))
      return kept.diagnostics;
    kept = {};
    auto text = llvm::MemoryBuffer::getFile(path, /*IsText=*/false);
    if (!text)
      return kept.diagnostics;
    CheckJob job = base;
    job.document = {uriOfPath(path), path, "", 0, textOf((*text)->getBuffer().str())};
    const auto result = check(job, &cancelled);
    if (!result)
      return kept.diagnostics;
    for (const Problem &problem : result->problems)
      if (problem.path == path)
        appendJson(kept.diagnostics, problem.diagnostic);
    kept.folders = job.session->folders();
    for (const auto &[file, open] : result->files)
      kept.files[file] = stampOf(file, *job.overlay);
    return kept.diagnostics;
  }

  std::shared_ptr<Session> session_; ///< under which the files were checked
  std::map<std::string, Kept> closed_;
};

} // namespace

void bindDiagnostics(Context &context) {
  context.rpc.onRequest("textDocument/diagnostic", [&context](const Json &params, Reply reply) {
    const std::string uri = params.at("textDocument").at("uri");
    const Document *document = context.documents.find(uri);
    if (!document)
      return reply.fail(RpcError::InvalidParams, "the document is not open: " + uri);
    context.withCheck(
        *document, std::move(reply),
        [&context, previous = params.value("previousResultId", "")](const CheckResult &result) {
          return ofDocument(context, result.document.path, previous);
        });
  });
  auto workspace = std::make_shared<WorkspaceChecks>(); // of the workspace's thread
  context.rpc.onRequest(
      "workspace/diagnostic", [&context, workspace](const Json &params, Reply reply) {
        if (!context.settings.workspaceDiagnostics)
          return reply({{"items", Json::array()}});
        auto held = std::make_shared<Reply>(std::move(reply));
        context.workspace->post([&context, workspace, held, params, job = context.job(Document()),
                                 folders = context.folders] {
          Json report;
          {
            WorkDone work(context.rpc, params, "programs of the workspace");
            PartialAnswer parts(context.rpc, params);
            report = workspace->report(job, folders, params, context.problems, held->cancelled(),
                                       work, parts);
          }
          (*held)(std::move(report));
        });
      });
}

} // namespace ncvet::lsp
