// What checks of many files share.
#pragma once

#include "analyzer/flow/body_memos.h"
#include "analyzer/flow/outer_calls.h"
#include "analyzer/setup/session.h"

#include <list>

namespace ncvet {

/// The files that programs call, opened and indexed once for all the files that one thread checks
/// one after the other. Belongs to one thread.
class CheckStore {
public:
  /// What the check of the next file does with calls of others.
  OuterCalls outer;

  /// The project for files with this setup.
  Project &projectFor(const FileSetup &setup, SourceSet &sources) {
    const auto known = llvm::find_if(shared_, [&](const Shared &one) {
      return one.setup.dialect == setup.dialect && one.setup.machine == setup.machine &&
             one.setup.config == setup.config && one.setup.folders == setup.folders;
    });
    if (known != shared_.end())
      return *known->project;
    if (shared_.size() == mostProjects)
      shared_.pop_front();
    shared_.push_back(
        {setup, std::make_unique<Project>(sources, setup.dialect, *setup.machine,
                                          setup.config->searchFolders, setup.folders)});
    return *shared_.back().project;
  }
  /// After a crash: what it leaves can be neither used nor given back.
  void abandon() {
    if (outer.bodies)
      outer.bodies->abandon();
    for (Shared &one : shared_)
      static_cast<void>(one.project.release());
    shared_.clear();
  }

private:
  /// Setups of one folder's files: the programs of a few controls.
  static constexpr size_t mostProjects = 8;

  struct Shared {
    FileSetup setup;
    std::unique_ptr<Project> project;
  };
  std::list<Shared> shared_;
};

} // namespace ncvet
