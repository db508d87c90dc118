// How far a long request is, and answers in parts.
#include "lsp/server/progress.h"

namespace ncvet::lsp {

WorkDone::WorkDone(Rpc &rpc, const Json &params, llvm::StringRef title)
    : rpc_(rpc), token_(params.value("workDoneToken", Json())) {
  tell({{"kind", "begin"}, {"title", ("ncvet: " + title).str()}, {"percentage", 0}});
}

WorkDone::~WorkDone() { tell({{"kind", "end"}}); }

void WorkDone::report(size_t done, size_t all) {
  const size_t percent = all == 0 ? 0 : 100 * done / all;
  if (percent > percent_)
    tell({{"kind", "report"}, {"percentage", percent}});
  percent_ = std::max(percent, percent_);
}

void WorkDone::tell(Json value) {
  if (!token_.is_null())
    rpc_.notify("$/progress", {{"token", token_}, {"value", std::move(value)}});
}

PartialAnswer::PartialAnswer(Rpc &rpc, const Json &params)
    : rpc_(rpc), token_(params.value("partialResultToken", Json())) {}

void PartialAnswer::send(Json part) {
  if (isWanted())
    rpc_.notify("$/progress", {{"token", token_}, {"value", std::move(part)}});
}

} // namespace ncvet::lsp
