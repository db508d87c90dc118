// A session: configuration, dialect, machine and rules for each file, made once for all that share
// them.
#include "analyzer/setup/session.h"

#include "analyzer/setup/remaps.h"
#include "formats/dialect/control_facts.h"
#include "formats/dialect/json_reader.h"
#include "formats/packed/shipped.h"
#include "formats/text/failure.h"
#include "formats/text/formatted.h"
#include "formats/text/read_file.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"
#include "llvm/Support/xxhash.h"

namespace ncvet {

namespace path = llvm::sys::path;

namespace {

std::string nearestDialect(llvm::StringRef given, llvm::ArrayRef<DialectSummary> own) {
  std::vector<std::string> ids;
  for (const std::vector<DialectSummary> &list : {own.vec(), shippedDialects()})
    for (const DialectSummary &dialect : list)
      if (!dialect.abstract)
        ids.push_back(dialect.id);
  const std::vector<llvm::StringRef> known(ids.begin(), ids.end());
  return suggest(given, known);
}

/// What comes with the program is the same for all sessions: made once, for as long as it runs.
template <typename T>
class Shipped {
public:
  llvm::Expected<T> get(const std::string &name, llvm::function_ref<llvm::Expected<T>()> make) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = made_.find(name);
    if (known != made_.end())
      return known->second;
    auto fresh = make();
    if (fresh)
      made_.emplace(name, *fresh);
    return fresh;
  }

private:
  std::mutex mutex_;
  std::map<std::string, T> made_;
};

llvm::Expected<std::shared_ptr<const Dialect>> shippedDialect(const std::string &id) {
  static auto &tables = *new Shipped<std::shared_ptr<const Dialect>>; // never taken apart
  return tables.get(
      id, [&]() -> llvm::Expected<std::shared_ptr<const Dialect>> { return loadShipped(id); });
}

llvm::Expected<std::shared_ptr<const Detector>> makeDetector(llvm::ArrayRef<DialectSummary> own) {
  auto detector = Detector::create(own);
  if (!detector)
    return detector.takeError();
  return std::make_shared<const Detector>(std::move(*detector));
}

llvm::Expected<std::shared_ptr<const Detector>> shippedDetector() {
  static auto &detectors = *new Shipped<std::shared_ptr<const Detector>>;
  return detectors.get("", [] { return makeDetector({}); });
}

} // namespace

llvm::Expected<std::string> OwnDialects::add(llvm::StringRef file) {
  auto text = readFile(file);
  if (!text)
    return text.takeError();
  if (llvm::Error wrong = refuseRepeatedKeys(file, (*text)->getBuffer()))
    return wrong;
  auto summary = summarize(file, (*text)->getBuffer());
  if (!summary)
    return summary.takeError();
  if (summary->id.empty())
    return failure(file + ":1: a dialect needs an \"id\"");
  tables_.push_back({summary->id, file.str(), std::move(*text)});
  summaries_.push_back(std::move(*summary));
  return tables_.back().id;
}

std::optional<std::pair<std::string, llvm::StringRef>> OwnDialects::find(llvm::StringRef id) {
  for (const Table &table : tables_)
    if (table.id == id)
      return std::pair(table.file, table.text->getBuffer());
  if (auto builtin = builtinDialects()(id))
    return builtin;
  if (!path::filename(id).equals(id) || id.startswith("."))
    return std::nullopt; // never out of the folder
  for (size_t i = 0; i < tables_.size(); ++i) {
    llvm::SmallString<256> beside = path::parent_path(tables_[i].file);
    path::append(beside, id + ".json");
    auto text = readFile(beside);
    if (!text) {
      llvm::consumeError(text.takeError());
      continue;
    }
    tables_.push_back({id.str(), std::string(beside), std::move(*text)});
    return std::pair(tables_.back().file, tables_.back().text->getBuffer());
  }
  return std::nullopt;
}

std::vector<std::string> OwnDialects::files() const {
  std::vector<std::string> files;
  for (const Table &table : tables_)
    files.push_back(table.file);
  return files;
}

llvm::Error OwnDialects::checkRules() const {
  for (const Table &table : tables_)
    if (llvm::Error wrong = checkRulesOfTable(table.file, table.text->getBuffer()))
      return wrong;
  return llvm::Error::success();
}

DialectSource OwnDialects::source() {
  return [this](llvm::StringRef id) { return find(id); };
}

namespace {

std::string absolute(llvm::StringRef file) {
  llvm::SmallString<256> full = file;
  if (llvm::sys::fs::make_absolute(full))
    return file.str();
  path::remove_dots(full, /*remove_dot_dot=*/true);
  return std::string(full);
}

} // namespace

void Session::noteRead(llvm::ArrayRef<std::string> files) {
  for (const std::string &file : files)
    readFiles_.insert(absolute(file));
}

std::vector<std::string> Session::readFiles() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {readFiles_.begin(), readFiles_.end()};
}

bool Session::dependsOn(llvm::StringRef file) {
  if (path::filename(file) == configFileName)
    return true;
  const std::lock_guard<std::mutex> lock(mutex_);
  return readFiles_.count(absolute(file)) || (failed_ && file.endswith_insensitive(".json"));
}

template <typename T>
llvm::Expected<T> Session::keep(std::map<std::string, Kept<T>> &cache, const std::string &key,
                                llvm::function_ref<llvm::Expected<T>()> make) {
  const auto [entry, isNew] = cache.try_emplace(key);
  if (isNew) {
    if (auto made = make())
      entry->second.value = std::move(*made);
    else
      entry->second.error = llvm::toString(made.takeError());
    failed_ |= !entry->second.error.empty();
  }
  return entry->second.get();
}

llvm::Expected<std::shared_ptr<const Config>> Session::config(llvm::StringRef folder) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string file = options_.configFile;
  if (file.empty()) {
    const auto [entry, isNew] = configOfFolder_.try_emplace(folder.str());
    if (isNew)
      entry->second = findConfig(folder);
    file = entry->second;
  }
  return keep<std::shared_ptr<const Config>>(
      configs_, file, [&]() -> llvm::Expected<std::shared_ptr<const Config>> {
        if (file.empty())
          return std::make_shared<const Config>();
        auto config = loadConfig(file);
        if (!config)
          return config.takeError();
        noteRead(config->readFrom);
        return std::make_shared<const Config>(std::move(*config));
      });
}

llvm::Expected<std::shared_ptr<const Config>> Session::configOf(llvm::StringRef fileName) {
  auto found = config(path::parent_path(fileName));
  if (!found || (*found)->overrides.empty())
    return found;
  const Config &whole = **found; // the session keeps it
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Globs> &globs = overrideGlobs_[&whole];
  if (globs.empty())
    for (const ConfigOverride &over : whole.overrides)
      globs.emplace_back(over.files);
  std::vector<size_t> which;
  for (size_t i = 0; i < globs.size(); ++i)
    if (globs[i].match(pathBelow(whole.overrides[i].folder, fileName)))
      which.push_back(i);
  if (which.empty())
    return found;
  auto &made = overridden_[{&whole, which}];
  if (!made)
    made = std::make_shared<const Config>(overridden(whole, which));
  return made;
}

llvm::Expected<std::shared_ptr<const Detector>> Session::detector(const Config &config) {
  const std::string key = llvm::join(config.dialectFiles, "\n");
  return keep<std::shared_ptr<const Detector>>(
      detectors_, key, [&]() -> llvm::Expected<std::shared_ptr<const Detector>> {
        if (config.dialectFiles.empty())
          return shippedDetector();
        noteRead(config.dialectFiles); // also when they cannot be read
        OwnDialects own;
        for (const std::string &file : config.dialectFiles)
          if (auto id = own.add(file); !id)
            return id.takeError();
        noteRead(own.files());
        return makeDetector(own.summaries());
      });
}

llvm::Expected<Session::Language> Session::language(llvm::StringRef dialect, const Config &config,
                                                    const MachineSource *machine) {
  // One file may hold several profiles.
  const std::string key = (dialect + "\n" + (machine ? machine->name : "") + "\n" +
                           llvm::Twine(machine ? llvm::xxHash64(machine->text) : 0) + "\n" +
                           llvm::join(config.dialectFiles, "\n"))
                              .str();
  return keep<Language>(languages_, key, [&]() -> llvm::Expected<Language> {
    OwnDialects own;
    std::string id = dialect.str();
    for (const std::string &file : config.dialectFiles)
      if (auto added = own.add(file); !added)
        return added.takeError();
    if (dialect.endswith(".json")) {
      auto added = own.add(dialect);
      if (!added)
        return added.takeError();
      id = *added;
    }
    if (!own.source()(id))
      return failure("unknown dialect \"" + id + "\"" + nearestDialect(id, own.summaries()));
    const bool shipped = config.dialectFiles.empty() && id == dialect;
    auto table = shipped ? shippedDialect(id) : loadDialect(id, own.source());
    if (!table)
      return table.takeError();
    if (llvm::Error wrong = own.checkRules())
      return wrong;
    if ((*table)->abstract)
      return failure("dialect \"" + id +
                     "\" is only a base of others; "
                     "`ncvet dialects` lists those that can be chosen");
    noteRead(own.files());
    auto profile = std::make_shared<MachineProfile>();
    if (machine) {
      auto parsed = parseMachineProfile(machine->name, machine->text);
      if (!parsed)
        return parsed.takeError();
      if (llvm::Error wrong = refuseRepeatedKeys(machine->name, machine->text))
        return wrong;
      *profile = std::move(*parsed);
      table = overlay(*table, machine->name, machine->text);
      if (!table)
        return table.takeError();
    }
    return Language{*table, std::move(profile)};
  });
}

llvm::Expected<Session::Language> Session::withRemaps(Language known, llvm::StringRef folder) {
  const auto [entry, isNew] =
      remapped_.try_emplace({known.dialect.get(), folder.str()}, known.dialect);
  if (isNew)
    if (const auto remaps = remapsNear(folder, *known.dialect)) {
      auto table = overlay(known.dialect, remaps->name, remaps->text);
      if (!table)
        return table.takeError();
      entry->second = *table;
      noteRead({remaps->name});
    }
  return Language{entry->second, known.machine};
}

llvm::Expected<std::shared_ptr<const RuleSelection>>
Session::selection(const std::shared_ptr<const Dialect> &dialect, const Config &config,
                   const UnsureReports *unsure) {
  // Both live as long as the session, so their addresses are their names.
  const std::string key = formatted("{0}\n{1}\n{2}", reinterpret_cast<uintptr_t>(dialect.get()),
                                    reinterpret_cast<uintptr_t>(&config), unsure != nullptr);
  return keep<std::shared_ptr<const RuleSelection>>(
      selections_, key, [&]() -> llvm::Expected<std::shared_ptr<const RuleSelection>> {
        auto layers = loadProfile(options_.profile.empty() ? config.profile : options_.profile);
        if (!layers)
          return layers.takeError();
        auto selection = std::make_shared<RuleSelection>(RuleSelection::defaults(*dialect));
        if (unsure) {
          RuleSettings narrowed;
          narrowed.ignore = unsure->ignore;
          applySettings(*selection, narrowed);
          selection->highest = unsure->highest;
        }
        for (const RuleSettings &layer : *layers)
          applySettings(*selection, layer);
        applySettings(*selection, config.rules);
        for (const RuleSettings &layer : config.furtherRules)
          applySettings(*selection, layer);
        applySettings(*selection, options_.rules);
        return std::shared_ptr<const RuleSelection>(std::move(selection));
      });
}

Detection Session::detect(const Detector &detector, llvm::StringRef fileName,
                          llvm::StringRef text) {
  constexpr size_t mostKept = 64;
  std::shared_ptr<Looked> looked;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (looked_.size() >= mostKept)
      looked_.clear();
    auto &known = looked_[{&detector, fileName.str()}];
    if (!known)
      known = std::make_shared<Looked>();
    looked = known;
  }
  const std::lock_guard<std::mutex> lock(looked->mutex);
  const uint64_t head = llvm::xxHash64(text.take_front(Detector::shownBytes));
  if (!looked->detection || looked->head != head) {
    looked->detection = detector.detect(fileName, text);
    looked->head = head;
  }
  return *looked->detection;
}

std::shared_ptr<ProgramFolders> Session::folders() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return folders_;
}

void Session::forgetFolders() {
  const std::lock_guard<std::mutex> lock(mutex_);
  folders_ = std::make_shared<ProgramFolders>();
}

llvm::Expected<std::string> Session::namedDialect(FileSetup &setup,
                                                  const MachineSource *machine) const {
  std::string dialect;
  if (options_.dialect != "auto") {
    dialect = options_.dialect;
    setup.reason = "--dialect";
  } else if (!setup.config->dialect.empty() && setup.config->dialect != "auto") {
    dialect = setup.config->dialect;
    setup.reason = setup.config->setBy.at("dialect");
  } else if (machine) {
    auto profile = parseMachineProfile(machine->name, machine->text);
    if (!profile)
      return profile.takeError();
    dialect = profile->dialect;
    setup.reason = "machine profile " + machine->name;
  }
  if (dialect.empty() && !options_.usualDialect.empty()) {
    dialect = options_.usualDialect;
    setup.reason = "the language of the text";
  }
  return dialect;
}

namespace {

/// The error with the place where the control is named, which a table that cannot be found has not.
llvm::Error withPlace(llvm::Error error, const FileSetup &setup, const MachineSource *machine) {
  const std::string message = llvm::toString(std::move(error));
  if (setup.detected || !llvm::StringRef(message).startswith("unknown dialect"))
    return failure(message);
  const auto &setBy = setup.config->setBy;
  const auto said = setBy.find("dialect");
  if (!setup.config->dialectPlace.empty() && said != setBy.end() && setup.reason == said->second)
    return failure(setup.config->dialectPlace + ": " + message);
  if (machine && llvm::StringRef(setup.reason).startswith("machine profile"))
    return failure(machine->name + ": dialect: " + message);
  return failure(message);
}

} // namespace

llvm::Expected<FileSetup> Session::setup(llvm::StringRef fileName, llvm::StringRef text) {
  auto config = configOf(fileName);
  if (!config)
    return config.takeError();
  FileSetup setup;
  setup.config = *config;
  setup.limits = options_.limits;
  const MachineSource *machine = nullptr;
  if (options_.machine)
    machine = &*options_.machine;
  else if (setup.config->machine)
    machine = &*setup.config->machine;

  auto named = namedDialect(setup, machine);
  if (!named)
    return named.takeError();
  std::string dialect = std::move(*named);
  // Detection compiles expressions, but it runs unlocked: only making the detector needs the lock.
  std::unique_lock<std::mutex> lock(mutex_);
  setup.folders = folders_;
  const UnsureReports *unsure = nullptr; // kept by the session's detector
  if (dialect.empty()) {
    auto found = detector(*setup.config);
    if (!found)
      return found.takeError();
    lock.unlock();
    Detection detection = detect(**found, fileName, text);
    lock.lock();
    dialect = std::move(detection.dialect);
    setup.reason = std::move(detection.reason);
    setup.detected = true;
    setup.sure = detection.sure;
    if (!detection.sure) {
      setup.reason += "; not sure: what rests on facts of the control is not reported";
      unsure = &(*found)->unsure();
    }
  }
  auto known = language(dialect, *setup.config, machine);
  if (!known)
    return withPlace(known.takeError(), setup, machine);
  if (known->dialect->facts->program.remapsInIni) {
    const llvm::StringRef folder = path::parent_path(fileName);
    noteRemapsNear(folder.empty() ? "." : folder);
    known = withRemaps(std::move(*known), folder.empty() ? "." : folder);
    if (!known)
      return known.takeError();
  }
  setup.dialect = known->dialect;
  setup.machine = known->machine;
  auto rules = selection(setup.dialect, *setup.config, unsure);
  if (!rules)
    return rules.takeError();
  setup.rules = *rules;
  return setup;
}

namespace {

/// Dialects of one maker begin with its name.
llvm::StringRef makerOf(llvm::StringRef dialect) { return dialect.split('-').first; }

/// Controls of one maker for the same kind of machine read each other's programs.
bool areAlike(llvm::StringRef found, const Dialect &used) {
  auto table = shippedDialect(found.str());
  if (!table) {
    llvm::consumeError(table.takeError());
    return true;
  }
  return makerOf(found) == makerOf(used.id) && (*table)->isLathe() == used.isLathe();
}

} // namespace

OtherControl Session::otherControl(const FileSetup &setup, llvm::StringRef fileName,
                                   llvm::StringRef text) {
  std::unique_lock<std::mutex> lock(mutex_);
  auto found = detector(*setup.config);
  lock.unlock();
  if (!found) {
    llvm::consumeError(found.takeError());
    return {};
  }
  const Detection detection = detect(**found, fileName, text);
  if (!detection.other.empty()) {
    const auto hasMark = [detector = *found, name = detection.other](llvm::StringRef line) {
      return detector->marks(name, line);
    };
    const auto isTold = [detector = *found, alike = detection.otherIsAlike](llvm::StringRef what) {
      return detector->isTold(what, alike);
    };
    return {detection.other,
            detection.otherMarks,
            false,
            detection.otherIsAlike,
            detection.otherIsNoMachine,
            detection.otherHighest,
            isTold,
            hasMark};
  }
  if (!detection.sure || areAlike(detection.dialect, *setup.dialect))
    return {};
  return {detection.dialect, detection.reason, true};
}

} // namespace ncvet
