// Which fixes of findings an editor may offer.
#include "lsp/server/fix_verdicts.h"

#include "analyzer/check/fix.h"
#include "lsp/transport/json_message.h"

namespace ncvet::lsp {

namespace {

/// A try costs two checks. Hover and completion wait for it up to this length; of texts of the
/// second length it takes about a second on a thread for which nobody waits, and of longer ones
/// fixes are offered as the rules have made them.
constexpr size_t mostTriedAtOnce = 1 << 20, mostTried = 64 << 20;

/// Whether the fix edits the document alone; what it says of another file is not tried.
bool staysInside(const Problem &problem, const std::string &uri) {
  const Json changes = parseMessage(problem.changes);
  return changes.size() == 1 && changes.contains(uri);
}

} // namespace

Worker::Task FixVerdicts::decide(View &view, const std::shared_ptr<const CheckResult> &result,
                                 llvm::ArrayRef<const Problem *> problems) {
  const SourceFile &file = view.snapshot.source();
  std::vector<const Problem *> tried;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (result_ != result)
      verdicts_.clear();
    result_ = result;
    for (const Problem *problem : problems)
      if (!problem->fixTitle.empty() && problem->path == view.document.path &&
          !verdicts_.count(problem) && staysInside(*problem, view.document.uri))
        tried.push_back(problem);
  }
  if (tried.empty() || file.text().size() > mostTried)
    return nullptr;
  if (!isLong(file.text())) {
    decideNow(view.job, file, result, tried);
    return nullptr;
  }
  return [this, job = view.job, result, tried = std::move(tried)] {
    SourceSet sources(job.overlay);
    const Document &document = job.document;
    decideNow(job, sources.add(document.path, document.text, document.path), result, tried);
  };
}

void FixVerdicts::decideNow(const CheckJob &job, const SourceFile &file,
                            const std::shared_ptr<const CheckResult> &result,
                            llvm::ArrayRef<const Problem *> tried) {
  std::vector<FindingPlace> places;
  for (const Problem *problem : tried)
    places.push_back({problem->rule, problem->begin, problem->end});
  const std::set<FindingPlace> held = fixesThatHold(*job.session, file, places, job.overlay);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (result_ != result)
    return;
  for (size_t i = 0; i < tried.size(); ++i)
    verdicts_[tried[i]] = held.count(places[i]) > 0;
}

bool FixVerdicts::isLong(llvm::StringRef text) { return text.size() > mostTriedAtOnce; }

bool FixVerdicts::knows(const Problem &problem) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return verdicts_.count(&problem) > 0;
}

bool FixVerdicts::holds(const Problem &problem) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = verdicts_.find(&problem);
  return found == verdicts_.end() || found->second;
}

} // namespace ncvet::lsp
