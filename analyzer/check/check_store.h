// What checks of many files share.
#pragma once

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
  Project &projectFor(const FileSetup &setup, SourceSet &sources);
  /// After a crash: what it leaves can be neither used nor given back.
  void abandon();

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
