// The paths that clients look at while they edit.
#include "lsp/server/live_paths.h"

#include "lsp/server/live_path.h"

namespace ncvet::lsp {

LivePaths::LivePaths() = default;
LivePaths::~LivePaths() = default;

llvm::Expected<std::string> LivePaths::answer(const CheckJob &job, const PathWish &wish,
                                              const std::atomic<bool> &cancelled) {
  const std::string &path = job.document.path;
  const auto found = llvm::find_if(kept_, [&](const Kept &kept) { return kept.path == path; });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
  } else {
    if (kept_.size() >= mostPaths)
      kept_.pop_back();
    kept_.push_front({path, std::make_unique<LivePath>()});
  }
  return kept_.front().live->answer(job, wish, cancelled);
}

void LivePaths::forget(const std::string &path) {
  kept_.remove_if([&](const Kept &kept) { return kept.path == path; });
}

void LivePaths::abandon(const std::string &path) {
  for (Kept &kept : kept_)
    if (kept.path == path)
      static_cast<void>(kept.live.release()); // on purpose without an owner
  forget(path);
}

} // namespace ncvet::lsp
