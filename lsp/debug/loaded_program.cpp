// A program that is debugged: loading it, and finding its blocks.
#include "lsp/debug/loaded_program.h"

#include "analyzer/check/checker.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule_table.h"
#include "formats/finding/plain_message.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace ncvet::dap {

std::string plainPath(llvm::StringRef path) {
  llvm::SmallString<256> plain = path;
  static_cast<void>(llvm::sys::fs::make_absolute(plain)); // else it stays as it is
  llvm::sys::path::remove_dots(plain, /*remove_dot_dot=*/true);
  return plain.str().str();
}

llvm::Expected<std::unique_ptr<LoadedProgram>> LoadedProgram::load(const std::string &path,
                                                                   SessionOptions options) {
  std::unique_ptr<LoadedProgram> program(new LoadedProgram(std::move(options)));
  const std::string plain = plainPath(path);
  auto file = program->sources_.open(plain, plain);
  if (!file)
    return file.takeError();
  auto setup = program->session_.setup(plain, (*file)->text());
  if (!setup)
    return setup.takeError();
  program->setup_ = std::move(*setup);
  const FileSetup &known = program->setup_;
  program->project_ = std::make_unique<Project>(program->sources_, known.dialect, *known.machine,
                                                known.config->searchFolders, known.folders);
  program->main_ = &program->project_->unit(**file);
  program->check();
  return program;
}

/// Finds what `ncvet check` finds. Its files are others than those of the run, with the same paths.
void LoadedProgram::check() {
  SourceSet sources;
  const SourceFile &file =
      sources.add(main_->source.display(), main_->source.text(), main_->source.path());
  const FileOutcome outcome = checkFile(session_, sources, file);
  for (const CheckedFinding &checked : outcome.findings) {
    const Finding &finding = checked.finding;
    if (finding.suppressed || finding.baselined)
      continue;
    const FileUnit *unit = unitOf(sources.get(finding.range.file).path());
    if (!unit)
      continue;
    findings_.push_back({{unit->source.id(), finding.range.begin, finding.range.end},
                         finding.severity,
                         (toString(finding.severity) + ": " + plainMessage(finding.message) + " [" +
                          allRules()[finding.rule].info.id + "]")
                             .str()});
  }
  llvm::stable_sort(findings_, [](const ReachedFinding &a, const ReachedFinding &b) {
    return std::pair(a.range.file, a.range.begin) < std::pair(b.range.file, b.range.begin);
  });
}

std::pair<size_t, size_t> LoadedProgram::findingsWithin(FileId file, uint32_t begin,
                                                        uint32_t end) const {
  const auto from = [&](uint32_t offset) {
    return size_t(llvm::partition_point(findings_,
                                        [&](const ReachedFinding &one) {
                                          return std::pair(one.range.file, one.range.begin) <
                                                 std::pair(file, offset);
                                        }) -
                  findings_.begin());
  };
  return {from(begin), from(end)};
}

FileUnit *LoadedProgram::unitOf(const std::string &path) {
  const std::string plain = plainPath(path);
  for (size_t i = 0; i < sources_.size(); ++i)
    if (plainPath(sources_.get(FileId(i)).path()) == plain)
      return &project_->unit(sources_.get(FileId(i)));
  return project_->open(plain);
}

std::optional<uint32_t> blockFromLine(const FileUnit &unit, uint32_t line) {
  const SourceFile &source = unit.source;
  const auto size = uint32_t(source.text().size());
  if (line == 0 || line > source.lines().lineOf(size))
    return std::nullopt;
  const bool spans = unit.dialect->lexical.blocksSpanLines;
  const uint32_t at = source.lines().beginOfLine(line);
  const uint32_t from = spans ? unit.reader->first() : std::max(at, unit.reader->first());
  for (const Block &block : blocks(*unit.reader, from, size)) {
    const bool isHead = block.kind == BlockKind::Tape || block.kind == BlockKind::ProgramHeader;
    if (block.kind != BlockKind::Empty && !(isHead && block.isEmpty()) && block.end > at)
      return block.begin;
  }
  return std::nullopt;
}

} // namespace ncvet::dap
