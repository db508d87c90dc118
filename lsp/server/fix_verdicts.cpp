// Which fixes of findings an editor may offer.
#include "lsp/server/fix_verdicts.h"

#include "analyzer/check/fix.h"
#include "lsp/transport/json_message.h"

namespace ncvet::lsp {

namespace {

/// A try costs two checks. Hover and completion wait for it: of longer texts, fixes are offered as
/// the rules have made them.
constexpr size_t mostTriedBytes = 1 << 20;

/// Whether the fix edits the document alone; what it says of another file is not tried.
bool staysInside(const Problem &problem, const std::string &uri) {
  const Json changes = parseMessage(problem.changes);
  return changes.size() == 1 && changes.contains(uri);
}

} // namespace

void FixVerdicts::decide(View &view, Session &session,
                         const std::shared_ptr<const CheckResult> &result,
                         llvm::ArrayRef<const Problem *> problems) {
  if (result_ != result)
    verdicts_.clear();
  result_ = result;
  const SourceFile &file = view.snapshot.source();
  if (file.text().size() > mostTriedBytes)
    return;
  std::vector<FindingPlace> places;
  std::vector<const Problem *> tried;
  for (const Problem *problem : problems)
    if (!problem->fixTitle.empty() && problem->path == view.document.path &&
        !verdicts_.count(problem) && staysInside(*problem, view.document.uri)) {
      places.push_back({problem->rule, problem->begin, problem->end});
      tried.push_back(problem);
    }
  if (places.empty())
    return;
  const std::set<FindingPlace> held = fixesThatHold(session, file, places, view.job.overlay);
  for (size_t i = 0; i < tried.size(); ++i)
    verdicts_[tried[i]] = held.count(places[i]) > 0;
}

bool FixVerdicts::holds(const Problem &problem) const {
  const auto found = verdicts_.find(&problem);
  return found == verdicts_.end() || found->second;
}

} // namespace ncvet::lsp
