// The path of one program that is being edited.
#include "lsp/server/live_path.h"

#include "analyzer/program/lookup_answers.h"
#include "analyzer/setup/session.h"
#include "formats/reports/tool_path_json.h"
#include "formats/text/file_uri.h"
#include "formats/text/formatted.h"

namespace ncvet::lsp {

namespace {

/// Blocks of the first piece of a path of which all is another after an edit: they take some
/// milliseconds. The pieces after it are larger each time, as each costs a copy of the rest.
constexpr uint64_t firstPiece = 16'384, growth = 8;

/// Which programs a text holds: calls may lead elsewhere when it holds others.
std::string programsOf(const FileIndex &index) {
  std::string programs;
  for (const ProgramInfo &program : index.programs())
    programs += formatted("{0} {1} {2} {3}\n", program.number, program.name, int(program.kind),
                          program.hasHeader());
  return programs;
}

/// What has become of a text, in one piece.
PathEdit editBetween(const SharedText &before, const SharedText &after) {
  PathEdit edit;
  const std::vector<TextChange> changes = changesBetween(before.bytes, after).fromFront();
  const auto size = uint32_t(before.bytes->size());
  if (changes.empty()) {
    edit.change = {size, size, 0};
  } else {
    // They are made one after the other, from the front: the end of the last one is told for a text
    // in which those before it have been made.
    int64_t by = 0;
    for (const TextChange &change : changes)
      by += int64_t(change.added) - (change.end - change.begin);
    const TextChange &first = changes.front(), &last = changes.back();
    const uint32_t endAfter = last.endAfter();
    edit.change = {first.begin, uint32_t(endAfter - by), endAfter - first.begin};
  }
  const uint32_t end = edit.change.end;
  const LineIndex linesBefore(*before.bytes), linesAfter(*after.bytes);
  const LineIndex &old = before.lines ? *before.lines : linesBefore;
  const LineIndex &now = after.lines ? *after.lines : linesAfter;
  edit.line = old.lineOf(end);
  edit.tail = old.lineBegin(end);
  if (edit.tail < end)
    edit.tail = old.beginOfLine(++edit.line);
  edit.lines = int64_t(now.lineOf(uint32_t(after.bytes->size()))) - old.lineOf(size);
  return edit;
}

std::vector<std::string> urisOf(const std::vector<std::string> &paths) {
  std::vector<std::string> uris;
  for (const std::string &path : paths)
    uris.push_back(uriOfPath(path));
  return uris;
}

} // namespace

/// Whether all but the text is as it was when the path was followed.
bool LivePath::isOfTheSame(const FileSetup &setup, const SourceSet::Overlay &open,
                           LookupSource &answers) const {
  const auto isTheSame = [&](const std::pair<const Lookup, uint64_t> &known) {
    return known.first.kind == Lookup::Kind::Text || // `files_` has their stamps
           answers.of(known.first) == known.second;
  };
  return text_.bytes && dialect_ == setup.dialect && machine_ == setup.machine &&
         llvm::all_of(files_,
                      [&](const auto &file) { return file.second == stampOf(file.first, open); }) &&
         (folders_ == setup.folders || llvm::all_of(lookups_, isTheSame));
}

void LivePath::note(const FileSetup &setup, const FileUnit &unit, const CheckJob &job) {
  text_ = job.document.text;
  dialect_ = setup.dialect;
  machine_ = setup.machine;
  folders_ = setup.folders;
  programs_ = programsOf(unit.index);
  files_.clear();
  for (const std::string &path : memory_.files())
    if (path != job.document.path)
      files_[path] = stampOf(path, *job.overlay);
}

llvm::Expected<std::string> LivePath::answer(const CheckJob &job, const PathWish &wish,
                                             const std::atomic<bool> &cancelled) {
  const Document &document = job.document;
  auto setup = job.session->setup(document.path, *document.text.bytes);
  if (!setup)
    return setup.takeError();
  SourceSet sources(job.overlay);
  const SourceFile &file = sources.add(document.path, document.text, document.path);
  Project project(sources, setup->dialect, *setup->machine, setup->config->searchFolders,
                  setup->folders);
  FileUnit &unit = project.unit(file, scan_.scanFor(*setup, file, document.text));
  LookupAnswers answers(setup->folders);
  std::optional<PathEdit> edit;
  if (isOfTheSame(*setup, *job.overlay, answers) && programs_ == programsOf(unit.index))
    edit = editBetween(text_, document.text);
  const bool goesOn = memory_.isPartial() && edit && text_.bytes == document.text.bytes;
  piece_ = !wish.pieces ? 0 : goesOn ? piece_ * growth : firstPiece;
  text_ = {};
  LookupRecord record(answers);
  const auto change =
      memory_.follow(project, unit, setup->limits, edit ? &*edit : nullptr, &cancelled, piece_);
  if (!change)
    return "null";
  if (change->whole)
    lookups_.clear();
  for (const auto &[lookup, answer] : record.answers())
    lookups_[lookup] = answer;
  note(*setup, unit, job);
  const bool isNext = !change->whole && wish.previous == std::to_string(lastId_);
  const std::vector<std::string> uris = urisOf(memory_.files());
  const std::string content = isNext
                                  ? toolPathChangeText(memory_.path(), uris, *change, wish.pieces)
                                  : toolPathText(memory_.path(), uris);
  return formatted(R"({{"id":"{0}","version":{1},{2}"{3}":{4}})", ++lastId_, document.version,
                   memory_.isPartial() ? R"("more":true,)" : "", isNext ? "change" : "path",
                   content);
}

} // namespace ncvet::lsp
