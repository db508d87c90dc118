// Paths as reports show them.
#pragma once

#include "analyzer/cli/check_job.h"

namespace ncvet::cli {

/// Makes `folder` the current folder of the process, so that all paths of a report are relative to
/// it, and changes the paths of the request so that they lead to the same files as before.
llvm::Error showRelativeTo(const std::string &folder, CheckRequest &request);

/// The current folder as seen from the nearest folder above that holds all files of the jobs;
/// empty when the current one does.
std::string folderFromRoot(llvm::ArrayRef<Job> jobs);

} // namespace ncvet::cli
