// All problems that the checks found, put together by the file in which they lie.
#pragma once

#include "lsp/server/checks.h"

#include <set>

namespace ncvet::lsp {

/// What is known of the problems of each file. A file's problems come from its own check and from
/// those of the programs that call it; only those that were found in its present text count. Safe
/// for several threads.
class ProblemBoard {
public:
  /// A file as the client knows it.
  struct ShownFile {
    std::string path;
    std::string uri;                ///< as the client has spelled it when it was open last
    std::optional<int64_t> version; ///< none: the document is not open
  };
  /// Sends the diagnostics of a file, a list as JSON. `own`: they come from the file's own check.
  using Send = std::function<void(const ShownFile &file, llvm::StringRef diagnostics, bool own)>;
  explicit ProblemBoard(Send send) : send_(std::move(send)) {}

  /// A document has this text now; what was found in another text of it no longer counts.
  void opened(const Document &document);
  void closed(const std::string &path);
  /// Takes the result of a check and sends what has changed by it; does nothing when the document
  /// has another text by now.
  void take(std::shared_ptr<const CheckResult> result);
  /// The diagnostics of a file, a list as JSON.
  std::string diagnostics(const std::string &path);
  /// Results of other documents' checks that count and tell of problems in the file.
  std::vector<std::shared_ptr<const CheckResult>> othersThatTellOf(const std::string &path);
  /// Files other than `path` itself in which its check found problems.
  std::vector<std::string> relatedTo(const std::string &path);
  /// Open documents whose check looked at the file.
  std::vector<std::string> usersOf(const std::string &path);
  /// Whether the check of an open document looked at the file.
  bool uses(const std::string &document, const std::string &path);
  /// The last result of an open document; null when there is none of its present text.
  std::shared_ptr<const CheckResult> result(const std::string &path);

private:
  bool isPresent(const std::string &path, const std::shared_ptr<const std::string> &text) const;
  std::string collect(const std::string &path) const;
  void send(const std::string &path, bool own);

  Send send_;
  mutable std::mutex mutex_;
  std::map<std::string, Document> documents_; ///< by path
  std::map<std::string, std::shared_ptr<const CheckResult>> results_;
  std::map<std::string, std::string> spelled_; ///< URIs of documents, by path
  std::set<std::string> sent_;                 ///< files of which the client shows problems
};

} // namespace ncvet::lsp
