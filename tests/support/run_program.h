// Runs the analysis on programs that a test holds as text, and reads the marks that say what is
// due.
#pragma once

#include "analyzer/flow/analyze.h"
#include "analyzer/rule/rule_table.h"
#include "formats/dialect/loader.h"
#include "tests/support/temporary_folder.h"

#include "gtest/gtest.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ncvet::test {

/// A file of a test program.
struct ProgramFile {
  std::string name;
  std::string text;
};

/// One finding, or one that is due; the parts that tests compare.
struct Seen {
  uint32_t line = 0;
  uint32_t column = 0;
  uint32_t endColumn = 0; ///< 0: not compared
  std::string rule;
  std::string certainty;
  std::string message;
  std::string file; ///< of the files beside the first one; empty: the first one

  std::string describe() const {
    return (file.empty() ? "" : file + ":") + std::to_string(line) + ":" + std::to_string(column) +
           (endColumn ? "-" + std::to_string(endColumn) : "") + " " + rule + " " + certainty +
           (message.empty() ? "" : ": " + message);
  }
};

/// A built-in dialect, loaded once for the whole test binary; fails the run when it does not load.
inline std::shared_ptr<const Dialect> dialectNamed(const std::string &id) {
  static std::map<std::string, std::shared_ptr<const Dialect>> loaded;
  auto &entry = loaded[id];
  if (!entry) {
    auto dialect = loadDialect(id, builtinDialects());
    if (!dialect) {
      ADD_FAILURE() << "dialect " << id << ": " << llvm::toString(dialect.takeError());
      return nullptr;
    }
    entry = *dialect;
  }
  return entry;
}

inline std::optional<size_t> ruleNamed(llvm::StringRef id) {
  const auto rules = allRules();
  for (size_t i = 0; i < rules.size(); ++i)
    if (rules[i].info.id == id)
      return i;
  return std::nullopt;
}

/// Only this rule, whatever the tables say of it.
inline RuleSelection only(const Dialect &dialect, size_t rule) {
  RuleSelection selection = RuleSelection::defaults(dialect);
  std::fill(selection.enabled.begin(), selection.enabled.end(), false);
  selection.enabled[rule] = selection.asked[rule] = true;
  return selection;
}

/// A control with its machine's profile; without a dialect where one of them does not load.
struct ProfiledMachine {
  std::shared_ptr<const Dialect> dialect;
  MachineProfile profile;
};

/// The built-in dialect with a profile's text laid over it (empty: none), made once for the whole
/// test binary; fails the test when it does not load.
inline const ProfiledMachine &machineOf(const std::string &dialectId, const std::string &machine) {
  static std::map<std::pair<std::string, std::string>, ProfiledMachine> made;
  const auto [entry, isNew] = made.try_emplace({dialectId, machine});
  ProfiledMachine &profiled = entry->second;
  if (isNew || !profiled.dialect) {
    profiled.dialect = dialectNamed(dialectId);
    if (!profiled.dialect || machine.empty())
      return profiled;
    auto parsed = parseMachineProfile("machine.json", machine);
    auto overlaid = overlay(profiled.dialect, "machine.json", machine);
    profiled.dialect = nullptr;
    if (!parsed || !overlaid) {
      ADD_FAILURE() << "machine profile: " << (parsed ? "" : llvm::toString(parsed.takeError()))
                    << (overlaid ? "" : llvm::toString(overlaid.takeError()));
      return profiled;
    }
    profiled.profile = *parsed;
    profiled.dialect = *overlaid;
  }
  return profiled;
}

/// Does `what` with the first file; what it calls is looked for in the others. `machine` is the
/// text of a machine profile, or empty.
inline void withProgram(const std::string &dialectId, const std::vector<ProgramFile> &files,
                        const std::string &machine,
                        llvm::function_ref<void(Project &, FileUnit &)> what) {
  const auto [dialect, profile] = machineOf(dialectId, machine);
  if (!dialect)
    return;
  SourceSet sources;
  std::optional<TemporaryFolder> folder;
  const SourceFile *main = nullptr;
  if (files.size() == 1) {
    main = &sources.add(files[0].name, files[0].text);
  } else {
    folder.emplace();
    for (const ProgramFile &file : files)
      std::ofstream(folder->path() / file.name, std::ios::binary) << file.text;
    auto opened = sources.open((folder->path() / files[0].name).string(), files[0].name);
    if (!opened) {
      ADD_FAILURE() << llvm::toString(opened.takeError());
      return;
    }
    main = *opened;
  }
  Project project(sources, dialect, profile);
  what(project, project.unit(*main));
}

/// Analyses the first file, as `withProgram` has it. Findings of other files than the first are
/// left out, unless `allFiles`.
inline std::vector<Seen> analyseProgram(const std::string &dialectId,
                                        const std::vector<ProgramFile> &files,
                                        const std::string &machine,
                                        llvm::function_ref<RuleSelection(const Dialect &)> select,
                                        bool allFiles = false) {
  std::vector<Seen> seen;
  withProgram(dialectId, files, machine, [&](Project &project, FileUnit &unit) {
    const AnalysisResult result = analyze(project, unit, select(*unit.dialect));
    for (const Finding &finding : result.findings) {
      if (finding.range.file != unit.source.id() && !allFiles)
        continue;
      const SourceFile &file = project.sources().get(finding.range.file);
      const LineColumn begin = file.position(finding.range.begin);
      const LineColumn end = file.position(finding.range.end);
      Seen &entry = seen.emplace_back();
      entry.line = begin.line;
      entry.column = begin.column;
      entry.endColumn = end.line == begin.line ? end.column : 0;
      entry.rule = allRules()[finding.rule].info.id.str();
      entry.certainty = toString(finding.certainty).str();
      entry.message = finding.message;
      if (&file != &unit.source)
        entry.file = std::filesystem::path(file.path()).filename().string();
    }
  });
  return seen;
}

inline std::vector<std::string> linesOf(const std::string &text) {
  std::vector<std::string> lines;
  size_t at = 0;
  while (at < text.size()) {
    size_t end = text.find('\n', at);
    if (end == std::string::npos)
      end = text.size();
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

/// Marks are comments below the block that they speak of: `(^^^ expect: rule-id definite)`, or
/// without the rule where only one runs. The carets are below the marked text as if the comment's
/// `(` were not there; a single caret gives the start only.
inline std::vector<Seen> marksOf(const std::string &text, const std::string &onlyRule = "") {
  std::vector<Seen> marks;
  uint32_t line = 0, marked = 0;
  for (const std::string &content : linesOf(text)) {
    ++line;
    const size_t word = content.find("expect:");
    const size_t caret = content.find('^');
    if (word == std::string::npos || caret == std::string::npos || caret > word ||
        content.find_first_of("(\";'") != 0) {
      marked = line;
      continue;
    }
    Seen &mark = marks.emplace_back();
    mark.line = marked;
    mark.column = uint32_t(caret);
    size_t last = caret;
    while (last + 1 < content.size() && content[last + 1] == '^')
      ++last;
    if (last > caret)
      mark.endColumn = uint32_t(last) + 1;
    std::string rest = content.substr(word + 7);
    rest.erase(std::remove(rest.begin(), rest.end(), ')'), rest.end());
    llvm::SmallVector<llvm::StringRef, 3> parts;
    llvm::StringRef(rest).split(parts, ' ', -1, false);
    mark.rule = onlyRule.empty() && parts.size() > 1 ? parts[0].str() : onlyRule;
    mark.certainty = parts.empty() ? "" : parts.back().rtrim("\r").str();
    EXPECT_TRUE(mark.certainty == "definite" || mark.certainty == "possible")
        << "line " << line << ": a mark ends in `definite` or `possible`: " << content;
  }
  return marks;
}

/// Every finding is due and every due finding is there.
inline void expectSame(std::vector<Seen> due, const std::vector<Seen> &found,
                       const std::string &where) {
  for (const Seen &finding : found) {
    const auto match = std::find_if(due.begin(), due.end(), [&](const Seen &mark) {
      return mark.file == finding.file && mark.line == finding.line && mark.rule == finding.rule &&
             mark.certainty == finding.certainty && mark.column == finding.column &&
             (!mark.endColumn || mark.endColumn == finding.endColumn);
    });
    if (match == due.end())
      ADD_FAILURE() << where << ": not marked: " << finding.describe();
    else
      due.erase(match);
  }
  for (const Seen &mark : due)
    ADD_FAILURE() << where << ": marked, but not reported: " << mark.describe();
}

} // namespace ncvet::test
