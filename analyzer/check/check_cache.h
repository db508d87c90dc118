// Outcomes of earlier runs: a file that is checked again, and rests on what it rested on, is not.
#pragma once

#include "analyzer/check/checker.h"
#include "analyzer/program/lookup_answers.h"

#include "llvm/ADT/StringMap.h"

namespace ncvet {

/// Outcomes in a folder, one file each. An outcome counts when all is as it was: the program
/// `ncvet`, the options and the configuration, tables of one's own, the text and the name of the
/// file, and the answers to all that its check looked up elsewhere. Texts and answers are compared
/// by hashes of their bytes, times only for files of more than a megabyte that are not programs
/// which the check has read. Safe for several threads.
class CheckCache {
public:
  /// Called files that one thread has opened for outcomes of this cache.
  using Opened = llvm::StringMap<const SourceFile *>;

  /// The cache in `folder`, which is made; empty: that of the user. Null where there is none:
  /// nobody says where, or ncvet cannot tell which build it is.
  static std::unique_ptr<CheckCache> open(llvm::StringRef folder, Session &session,
                                          SourceSet &sources);

  /// As `checkFile`, which is asked only when no outcome is known.
  FileOutcome check(const SourceFile &file, const std::atomic<bool> *cancel, CheckStore &store,
                    Opened &opened);
  /// Files whose outcomes were known.
  size_t known() const { return known_; }
  /// Removes what was not used for a month, and the oldest beyond some size; now and then.
  void prune() const;

private:
  CheckCache(std::string folder, std::string build, Session &session, SourceSet &sources)
      : folder_(std::move(folder)), build_(std::move(build)), session_(session), sources_(sources),
        answers_(session.folders()) {}

  /// Where the outcome is; none: the file's configuration cannot be read.
  std::optional<std::string> pathFor(const SourceFile &file, const OuterCalls &outer);
  std::string settingsFor(const std::shared_ptr<const Config> &config);
  std::optional<FileOutcome> find(const std::string &path, const SourceFile &file, Opened &opened);
  void keep(const std::string &path, const SourceFile &file, const FileOutcome &outcome,
            const LookupRecord &record);

  const std::string folder_, build_;
  Session &session_;
  SourceSet &sources_;
  LookupAnswers answers_;
  std::mutex mutex_;
  std::map<std::shared_ptr<const Config>, std::string> settings_; ///< as texts
  std::atomic<size_t> known_ = 0;
  std::atomic<bool> full_ = false; ///< nothing can be written
};

} // namespace ncvet
