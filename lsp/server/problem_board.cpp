// All problems by the file in which they lie: which of them count, and what the client must be
// told.
#include "lsp/server/problem_board.h"

#include "formats/text/file_uri.h"
#include "lsp/transport/rpc.h"

#include <set>

namespace ncvet::lsp {

namespace {

constexpr llvm::StringLiteral none = "[]";

} // namespace

bool ProblemBoard::isPresent(const std::string &path,
                             const std::shared_ptr<const std::string> &text) const {
  const auto document = documents_.find(path);
  return document == documents_.end() ? !text : document->second.text.bytes == text;
}

std::string ProblemBoard::collect(const std::string &path) const {
  std::vector<const CheckResult *> telling;
  for (const auto &[checked, result] : results_)
    if (const auto file = result->files.find(path);
        file != result->files.end() && isPresent(path, file->second))
      telling.push_back(result.get());
  std::string all = none.str();
  std::set<std::tuple<uint32_t, uint32_t, RuleId>> known;
  // A check tells of one place once; what several tell is to be told once.
  const bool repeats = telling.size() > 1;
  for (const CheckResult *result : telling)
    for (const Problem &problem : result->problems)
      if (problem.path == path &&
          (!repeats || known.emplace(problem.begin, problem.end, problem.rule).second))
        appendJson(all, problem.diagnostic);
  return all;
}

void ProblemBoard::send(const std::string &path, bool own) {
  const std::string diagnostics = collect(path);
  const auto document = documents_.find(path);
  const bool open = document != documents_.end();
  if (diagnostics == none && !sent_.count(path) && !open)
    return;
  if (diagnostics == none)
    sent_.erase(path);
  else
    sent_.insert(path);
  const auto spelled = spelled_.find(path);
  send_({path, spelled == spelled_.end() ? uriOfPath(path) : spelled->second,
         open ? std::optional(document->second.version) : std::nullopt},
        diagnostics, own);
}

void ProblemBoard::opened(const Document &document) {
  const std::lock_guard<std::mutex> lock(mutex_);
  documents_[document.path] = document;
  spelled_[document.path] = document.uri;
}

void ProblemBoard::closed(const std::string &path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::set<std::string> changed{path};
  if (const auto result = results_.find(path); result != results_.end())
    for (const auto &[file, text] : result->second->files)
      changed.insert(file);
  results_.erase(path);
  documents_.erase(path);
  sent_.insert(path); // it is told in any case
  for (const std::string &file : changed)
    send(file, file == path);
}

void ProblemBoard::take(std::shared_ptr<const CheckResult> result) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string path = result->document.path;
  if (!isPresent(path, result->document.text.bytes))
    return;
  std::set<std::string> changed{path};
  const auto note = [&](const CheckResult &of) {
    for (const Problem &problem : of.problems)
      changed.insert(problem.path);
  };
  note(*result);
  auto &kept = results_[path];
  if (kept == result)
    return;
  // What was found in a text that is the same is another where other files are: who asks for the
  // documents that it changes does not know that.
  const bool isSameText = kept && kept->document.text.bytes == result->document.text.bytes;
  const std::string before = isSameText ? collect(path) : std::string();
  if (kept)
    note(*kept);
  kept = std::move(result);
  const bool isNews = isSameText && collect(path) != before;
  for (const std::string &file : changed)
    send(file, file == path && !isNews);
}

std::string ProblemBoard::diagnostics(const std::string &path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return collect(path);
}

std::vector<std::shared_ptr<const CheckResult>>
ProblemBoard::othersThatTellOf(const std::string &path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::shared_ptr<const CheckResult>> others;
  for (const auto &[checked, result] : results_)
    if (const auto file = result->files.find(path);
        checked != path && file != result->files.end() && isPresent(path, file->second) &&
        llvm::any_of(result->problems, [&](const Problem &one) { return one.path == path; }))
      others.push_back(result);
  return others;
}

std::vector<std::string> ProblemBoard::relatedTo(const std::string &path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::set<std::string> files;
  if (const auto result = results_.find(path); result != results_.end())
    for (const Problem &problem : result->second->problems)
      if (problem.path != path)
        files.insert(problem.path);
  return {files.begin(), files.end()};
}

std::vector<std::string> ProblemBoard::usersOf(const std::string &path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> users;
  for (const auto &[checked, result] : results_)
    if (checked != path && result->files.count(path))
      users.push_back(checked);
  return users;
}

bool ProblemBoard::uses(const std::string &document, const std::string &path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto result = results_.find(document);
  return result != results_.end() && result->second->files.count(path);
}

std::shared_ptr<const CheckResult> ProblemBoard::result(const std::string &path) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = results_.find(path);
  return found != results_.end() && isPresent(path, found->second->document.text.bytes)
             ? found->second
             : nullptr;
}

} // namespace ncvet::lsp
