// Findings as diagnostics of the protocol: severity, further places, tags, the rule's page.
#include "lsp/protocol/diagnostic.h"

#include "formats/finding/page_text.h"
#include "formats/finding/plain_message.h"
#include "formats/text/file_uri.h"

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

} // namespace

std::string DiagnosticWriter::lineOf(SourceRange range) {
  const SourceFile &file = sources_.get(range.file);
  return (llvm::sys::path::filename(file.display()) + ":" +
          llvm::Twine(file.lines().lineOf(range.begin)))
      .str();
}

Json DiagnosticWriter::diagnostic(const Finding &finding, const RuleInfo &rule) {
  std::string message = plainMessage(finding.message);
  if (finding.certainty == Certainty::Possible)
    message += " (on some of the paths that lead here)";
  Json related = Json::array();
  const auto further = [&](SourceRange range, const std::string &marked) {
    const std::string text = plainMessage(marked);
    if (support_.related)
      related.push_back({{"location", places_.location(range)}, {"message", text}});
    else
      message += "\n" + lineOf(range) + ": " + text;
  };
  for (const Note &note : finding.notes)
    further(note.range, note.message);
  for (const PathStep &step : finding.path)
    further(step.range, step.message);
  Json json = {{"range", places_.range(finding.range)},
               {"severity", severityNumber(finding.severity)},
               {"code", rule.id.str()},
               {"source", "ncvet"},
               {"message", std::move(message)}};
  if (!related.empty())
    json["relatedInformation"] = std::move(related);
  if (support_.tags && rule.unreachable)
    json["tags"] = {tagUnnecessary};
  if (support_.codeLink)
    if (std::string page = rulePageUri(rule); !page.empty())
      json["codeDescription"] = {{"href", std::move(page)}};
  return json;
}

std::string rulePageUri(const RuleInfo &rule) {
  static std::mutex mutex;
  static llvm::StringMap<std::string> written;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto [entry, isNew] = written.try_emplace(rule.id);
  if (!isNew)
    return entry->second;
  llvm::SmallString<256> file;
  if (!llvm::sys::path::cache_directory(file))
    llvm::sys::path::system_temp_directory(/*ErasedOnReboot=*/true, file);
  llvm::sys::path::append(file, "ncvet", "rules", rule.id + ".md");
  if (llvm::sys::fs::create_directories(llvm::sys::path::parent_path(file)))
    return {};
  // Several servers may write the same page: a name of its own, then renamed.
  if (llvm::Error error = llvm::writeFileAtomically((file + ".%%%%%%").str(), file,
                                                    forReaders(splitPage(rule.help).second))) {
    llvm::consumeError(std::move(error));
    return {};
  }
  return entry->second = uriOfPath(file);
}

} // namespace ncvet::lsp
