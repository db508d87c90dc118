// Projects that checks of many files share.
#include "analyzer/check/check_store.h"

#include "analyzer/flow/body_memos.h"

namespace ncvet {

Project &CheckStore::projectFor(const FileSetup &setup, SourceSet &sources) {
  const auto known = llvm::find_if(shared_, [&](const Shared &one) {
    return one.setup.dialect == setup.dialect && one.setup.machine == setup.machine &&
           one.setup.config == setup.config && one.setup.folders == setup.folders;
  });
  if (known != shared_.end())
    return *known->project;
  if (shared_.size() == mostProjects)
    shared_.pop_front();
  shared_.push_back({setup, std::make_unique<Project>(sources, setup.dialect, *setup.machine,
                                                      setup.config->searchFolders, setup.folders)});
  return *shared_.back().project;
}

void CheckStore::abandon() {
  if (outer.bodies)
    outer.bodies->abandon();
  for (Shared &one : shared_)
    static_cast<void>(one.project.release());
  shared_.clear();
}

} // namespace ncvet
