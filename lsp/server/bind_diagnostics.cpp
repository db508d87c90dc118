// Pull diagnostics: of one document with the files that it calls, and of the whole workspace.
#include "analyzer/setup/input_files.h"
#include "lsp/protocol/uri.h"
#include "lsp/server/bindings.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/xxhash.h"

namespace ncvet::lsp {

namespace {

/// A report in full, or that it is what the client has already. `diagnostics`: a list as JSON.
Json report(const std::string &diagnostics, const std::string &previous) {
  std::string id = llvm::utohexstr(llvm::xxHash64(diagnostics));
  if (id == previous)
    return {{"kind", "unchanged"}, {"resultId", std::move(id)}};
  return {{"kind", "full"}, {"resultId", std::move(id)}, {"items", Json::parse(diagnostics)}};
}

Json ofDocument(Context &context, View &view, const Json &params) {
  const auto result = context.checks->wait(view.document, view.cancelled);
  if (!result)
    return outdated;
  // The thread of checks puts results on the board after it has woken those that wait for them.
  context.problems.take(result);
  const std::string &path = view.document.path;
  Json answer = report(context.problems.diagnostics(path), params.value("previousResultId", ""));
  for (const std::string &file : context.problems.relatedTo(path))
    answer["relatedDocuments"][uriOfPath(file)] = report(context.problems.diagnostics(file), "");
  return answer;
}

/// Checks programs of the workspace that are not open, and keeps what it found as long as the files
/// that it looked at are what they were.
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
      const std::string uri = uriOfPath(input.path);
      Json one =
          lsp::report(open ? board.diagnostics(input.path) : ofFile(base, input.path, cancelled),
                      previous[uri]);
      one["uri"] = uri;
      one["version"] = nullptr;
      items.push_back(std::move(one));
    }
    return {{"items", std::move(items)}};
  }

private:
  /// What a check of a closed file has found, and what it rests on.
  struct Kept {
    std::string diagnostics = "[]";          ///< a list as JSON
    std::shared_ptr<ProgramFolders> folders; ///< null: nothing was found out
    std::map<std::string, std::shared_ptr<const std::string>> files; ///< see `CheckResult`
    std::map<std::string, llvm::sys::TimePoint<>> written;

    /// Whether a check would find the same.
    bool holds(const CheckJob &job) const {
      if (!folders || folders != job.session->folders())
        return false;
      return llvm::all_of(files, [&](const auto &file) {
        const auto open = job.overlay->find(file.first);
        const bool same = open == job.overlay->end() ? !file.second : open->second == file.second;
        return same && writtenAt(file.first) == written.at(file.first);
      });
    }
  };
  static llvm::sys::TimePoint<> writtenAt(llvm::StringRef path) {
    llvm::sys::fs::file_status status;
    return llvm::sys::fs::status(path, status) ? llvm::sys::TimePoint<>()
                                               : status.getLastModificationTime();
  }

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
    kept.files = result->files;
    for (const auto &[file, open] : kept.files)
      kept.written[file] = writtenAt(file);
    return kept.diagnostics;
  }

  std::shared_ptr<Session> session_; ///< under which the files were checked
  std::map<std::string, Kept> closed_;
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
