// A session: everything that must be known before a file is checked, found once and shared.
#pragma once

#include "analyzer/program/project.h"
#include "analyzer/rule/analysis_limits.h"
#include "analyzer/rule/rule_settings.h"
#include "analyzer/setup/config.h"
#include "analyzer/setup/detect.h"
#include "analyzer/setup/globs.h"
#include "formats/text/failure.h"

#include <mutex>
#include <set>

namespace ncvet {

/// What the command line says; it goes before every configuration.
struct SessionOptions {
  std::string dialect = "auto";         ///< id, path of a table (`….json`), or `auto`
  std::string usualDialect;             ///< where nobody names one; empty: it is found out
  std::optional<MachineSource> machine; ///< profile for all files
  std::string configFile;               ///< instead of the nearest one; empty: the nearest
  std::string profile;                  ///< empty: as configured
  RuleSettings rules;
  AnalysisLimits limits;
  bool contours = false; ///< compensated contours are to be told
};

/// A control that a text is for.
struct OtherControl {
  std::string name;  ///< empty: none
  std::string marks; ///< what speaks for it
  bool hasTable = false;
  bool isAlike = false;     ///< it has no table, but its language is nearly the one that is used
  bool isNoMachine = false; ///< no machine runs such a text
  Severity highest = Severity::Error;
  /// Whether findings of this category say something of its texts.
  std::function<bool(llvm::StringRef category)> isTold = {};
  /// Whether a line is its own: with a mark of it.
  std::function<bool(llvm::StringRef)> hasMark = {};
};

/// All that the check of one file needs.
struct FileSetup {
  std::shared_ptr<const Config> config;
  std::shared_ptr<const Dialect> dialect;
  std::shared_ptr<const MachineProfile> machine;
  std::shared_ptr<const RuleSelection> rules;
  std::shared_ptr<ProgramFolders> folders; ///< for programs that it calls
  AnalysisLimits limits;
  std::string reason;    ///< why this dialect
  bool detected = false; ///< the dialect was found out from the file, nobody named it
  bool sure = false;     ///< … without doubt
};

/// Finds and keeps configurations, dialects and machine profiles. Safe for several threads.
class Session {
public:
  explicit Session(SessionOptions options) : options_(std::move(options)) {}

  /// Configuration for the files of `folder`.
  llvm::Expected<std::shared_ptr<const Config>> config(llvm::StringRef folder);
  /// That for one file: with the overrides that are for it.
  llvm::Expected<std::shared_ptr<const Config>> configOf(llvm::StringRef fileName);
  /// Setup for the file of this name and text. Errors are those of configurations and tables.
  llvm::Expected<FileSetup> setup(llvm::StringRef fileName, llvm::StringRef text);
  const SessionOptions &options() const { return options_; }
  /// Whether setups may change when this file is made, removed or written: a configuration, a table
  /// or a machine profile in use; any JSON file while one of these cannot be read.
  bool dependsOn(llvm::StringRef path);
  /// Absolute paths of configurations, tables and machine profiles that setups came from, or would.
  std::vector<std::string> readFiles();
  /// Files were made, removed or written: folders are read again for later setups.
  void forgetFolders();
  /// Where programs are looked up; another object when they were forgotten.
  std::shared_ptr<ProgramFolders> folders();
  /// The control that the text is for by its own marks where that is not `dialect`: one without a
  /// table, or surely one of another maker.
  OtherControl otherControl(const FileSetup &setup, llvm::StringRef fileName, llvm::StringRef text);

private:
  struct Language {
    std::shared_ptr<const Dialect> dialect;
    std::shared_ptr<const MachineProfile> machine;
  };
  /// A result or the error's text: a file that cannot be read is tried once.
  template <typename T>
  struct Kept {
    T value;
    std::string error;
    llvm::Expected<T> get() const {
      if (error.empty())
        return value;
      return failure(error);
    }
  };
  template <typename T>
  llvm::Expected<T> keep(std::map<std::string, Kept<T>> &cache, const std::string &key,
                         llvm::function_ref<llvm::Expected<T>()> make);

  /// What a detector said of a file.
  struct Looked {
    std::mutex mutex;
    std::optional<Detection> detection;
    uint64_t head = 0; ///< hash of the text that it looked at
  };

  /// The dialect that an option, the configuration or the machine names, with the reason in
  /// `setup`; empty: none, and the text decides.
  llvm::Expected<std::string> namedDialect(FileSetup &setup, const MachineSource *machine) const;
  llvm::Expected<std::shared_ptr<const Detector>> detector(const Config &config);
  /// What the detector says; the same head of the same file is looked at once.
  Detection detect(const Detector &detector, llvm::StringRef fileName, llvm::StringRef text);
  llvm::Expected<Language> language(llvm::StringRef dialect, const Config &config,
                                    const MachineSource *machine);
  /// `known` with the codes that INI files near `folder` make.
  llvm::Expected<Language> withRemaps(Language known, llvm::StringRef folder);
  /// `unsure`: how the reports are narrowed because the dialect is a guess; null when it is not.
  llvm::Expected<std::shared_ptr<const RuleSelection>>
  selection(const std::shared_ptr<const Dialect> &dialect, const Config &config,
            const UnsureReports *unsure);

  void noteRead(llvm::ArrayRef<std::string> files);

  SessionOptions options_;
  std::shared_ptr<ProgramFolders> folders_ = std::make_shared<ProgramFolders>();
  std::mutex mutex_;
  std::set<std::string> readFiles_; ///< absolute paths of what setups come from
  bool failed_ = false;             ///< something that setups come from cannot be read
  std::map<std::string, std::string> configOfFolder_;
  std::map<std::pair<const Dialect *, std::string>, std::shared_ptr<const Dialect>> remapped_;
  std::map<std::string, Kept<std::shared_ptr<const Config>>> configs_; ///< by file
  std::map<const Config *, std::vector<Globs>> overrideGlobs_;
  /// By the configuration and the overrides that count.
  std::map<std::pair<const Config *, std::vector<size_t>>, std::shared_ptr<const Config>>
      overridden_;
  std::map<std::string, Kept<std::shared_ptr<const Detector>>> detectors_;
  std::map<std::string, Kept<Language>> languages_;
  std::map<std::pair<const Detector *, std::string>, std::shared_ptr<Looked>> looked_; ///< by file
  std::map<std::string, Kept<std::shared_ptr<const RuleSelection>>> selections_;
};

/// Tables of one's own before the built-in ones. `extends` also finds the file `<id>.json`
/// beside one of them.
class OwnDialects {
public:
  /// Reads `file`; an error when it cannot be read. Returns the table's id.
  llvm::Expected<std::string> add(llvm::StringRef file);
  llvm::ArrayRef<DialectSummary> summaries() const { return summaries_; }
  /// Those that were added, and those beside them that they extend.
  std::vector<std::string> files() const;
  /// Valid as long as this object.
  DialectSource source();
  /// An error that names the file and the line of a rule, or an option of one, that ncvet does not
  /// have.
  llvm::Error checkRules() const;

private:
  std::optional<std::pair<std::string, llvm::StringRef>> find(llvm::StringRef id);

  struct Table {
    std::string id, file;
    std::unique_ptr<llvm::MemoryBuffer> text;
  };
  std::vector<Table> tables_;
  std::vector<DialectSummary> summaries_;
};

} // namespace ncvet
