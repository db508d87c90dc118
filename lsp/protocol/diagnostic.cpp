// Findings as diagnostics of the protocol: severity, further places, tags, the rule's page.
#include "lsp/protocol/diagnostic.h"

#include "formats/finding/page_text.h"
#include "formats/finding/plain_message.h"
#include "formats/packed/family.h"
#include "formats/text/file_uri.h"
#include "formats/text/json_text.h"

#include "llvm/Support/FileSystem.h"
#include "llvm/Support/FileUtilities.h"
#include "llvm/Support/Path.h"

namespace ncvet::lsp {

namespace {

/// `DiagnosticSeverity`. Advice is information: an editor hides hints.
int severityNumber(Severity severity) {
  switch (severity) {
  case Severity::Error:
    return 1;
  case Severity::Warning:
    return 2;
  case Severity::Style:
    return 3;
  }
  return 3;
}

/// `DiagnosticTag.Unnecessary`: code that nothing reaches is shown faded.
constexpr int tagUnnecessary = 1;

std::string textOf(Position at) {
  return "{\"line\":" + std::to_string(at.line) + ",\"character\":" + std::to_string(at.character) +
         "}";
}

/// A string of JSON.
std::string textOf(std::string text) { return jsonText(Json(std::move(text))); }

} // namespace

std::string DiagnosticWriter::lineOf(SourceRange range) {
  const SourceFile &file = sources_.get(range.file);
  return (llvm::sys::path::filename(file.display()) + ":" +
          llvm::Twine(file.lines().lineOf(range.begin)))
      .str();
}

std::string DiagnosticWriter::rangeText(SourceRange range) {
  Positions &positions = places_.of(range.file);
  const Position begin = positions.at(range.begin); // ascending order is the quick one
  return "{\"start\":" + textOf(begin) + ",\"end\":" + textOf(positions.at(range.end)) + "}";
}

std::string DiagnosticWriter::relatedText(SourceRange range, llvm::StringRef message) {
  return "{\"location\":{\"uri\":" + textOf(places_.uri(range.file)) +
         ",\"range\":" + rangeText(range) + "},\"message\":" + textOf(plainMessage(message)) + "}";
}

std::string DiagnosticWriter::diagnostic(const Finding &finding, const RuleInfo &rule) {
  std::string message = plainMessage(finding.message);
  if (finding.certainty == Certainty::Possible)
    message += " (on some of the paths that lead here)";
  std::string related = "[]";
  const auto further = [&](SourceRange range, const std::string &text) {
    if (support_.related)
      appendJson(related, relatedText(range, text));
    else
      message += "\n" + lineOf(range) + ": " + plainMessage(text);
  };
  for (const Note &note : finding.notes)
    further(note.range, note.message);
  for (const PathStep &step : finding.path)
    further(step.range, step.message);
  std::string json = "{\"range\":" + rangeText(finding.range) +
                     ",\"severity\":" + std::to_string(severityNumber(finding.severity)) +
                     ",\"code\":" + textOf(rule.id.str()) +
                     ",\"source\":\"ncvet\",\"message\":" + textOf(std::move(message));
  if (related.size() > 2) // both brackets
    json += ",\"relatedInformation\":" + related;
  if (support_.tags && rule.unreachable)
    json += ",\"tags\":[" + std::to_string(tagUnnecessary) + "]";
  if (support_.codeLink)
    if (std::string page = rulePageUri(rule, dialect_); !page.empty())
      json += ",\"codeDescription\":{\"href\":" + textOf(std::move(page)) + "}";
  return json + "}";
}

std::string DiagnosticWriter::changes(const Fix &fix) {
  std::map<FileId, std::string> byFile; // lists of edits
  for (const TextEdit &edit : fix.edits)
    appendJson(byFile.try_emplace(edit.range.file, "[]").first->second,
               "{\"range\":" + rangeText(edit.range) + ",\"newText\":" +
                   textOf(sources_.get(edit.range.file).displayText(edit.text)) + "}");
  std::string json;
  for (const auto &[file, edits] : byFile)
    json += (json.empty() ? "{" : ",") + textOf(places_.uri(file)) + ":" + edits;
  return json.empty() ? "{}" : json + "}";
}

std::string rulePageUri(const RuleInfo &rule, llvm::StringRef dialect) {
  static std::mutex mutex;
  static llvm::StringMap<std::string> written;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto [entry, isNew] = written.try_emplace((rule.id + "\n" + dialect).str());
  if (!isNew)
    return entry->second;
  const llvm::StringRef body = splitPage(rule.help).second;
  const std::string shown = firstOf(familyOf(dialect), controlsOfPrograms(body));
  llvm::SmallString<256> file;
  if (!llvm::sys::path::cache_directory(file))
    llvm::sys::path::system_temp_directory(/*ErasedOnReboot=*/true, file);
  llvm::sys::path::append(file, "ncvet", "rules", shown.empty() ? "all" : shown, rule.id + ".md");
  if (llvm::sys::fs::create_directories(llvm::sys::path::parent_path(file)))
    return {};
  // Several servers may write the same page: a name of its own, then renamed.
  if (llvm::Error error = llvm::writeFileAtomically((file + ".%%%%%%").str(), file,
                                                    forReaders(withProgramsOf(shown, body)))) {
    llvm::consumeError(std::move(error));
    return {};
  }
  return entry->second = uriOfPath(file);
}

} // namespace ncvet::lsp
