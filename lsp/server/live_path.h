// The path of one program that is being edited, as `ncvet/path` tells it.
#pragma once

#include "analyzer/program/lookups.h"
#include "analyzer/trace/tool_path_memory.h"
#include "lsp/server/checks.h"
#include "lsp/server/file_stamp.h"
#include "lsp/server/path_wish.h"

namespace ncvet::lsp {

/// The path of one document, carried from each of its versions to the next.
class LivePath {
public:
  /// What `ncvet/path` answers, as JSON: the whole path, or what is another since the last answer.
  /// Null when it was cancelled. Errors are those of configurations and tables.
  llvm::Expected<std::string> answer(const CheckJob &job, const PathWish &wish,
                                     const std::atomic<bool> &cancelled);

private:
  bool isOfTheSame(const FileSetup &setup, const SourceSet::Overlay &open,
                   LookupSource &answers) const;
  void note(const FileSetup &setup, const FileUnit &unit, const CheckJob &job);

  CheckMemory scan_; ///< of the text, for whoever looks for programs in it
  ToolPathMemory memory_{mostMoves};
  SharedText text_; ///< that was followed last
  std::shared_ptr<const Dialect> dialect_;
  std::shared_ptr<const MachineProfile> machine_;
  std::shared_ptr<ProgramFolders> folders_;
  std::string programs_;                   ///< which programs the text held
  std::map<std::string, FileStamp> files_; ///< other ones that the path goes through
  /// What was looked up in folders, with the answers: after a file was saved they are the same
  /// again in most cases.
  std::map<Lookup, uint64_t> lookups_;
  unsigned lastId_ = 0;
  uint64_t piece_ = 0; ///< blocks of the last piece

  /// More take longer than an editor waits.
  static constexpr size_t mostMoves = 3'000'000;
};

} // namespace ncvet::lsp
