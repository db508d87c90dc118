// Findings as diagnostics of the protocol.
#pragma once

#include "formats/finding/finding.h"
#include "lsp/protocol/places.h"

#include "llvm/ADT/StringMap.h"

namespace ncvet::lsp {

/// What the client can show of a diagnostic.
struct DiagnosticSupport {
  bool related = false;  ///< `relatedInformation`; without it further places are in the message
  bool tags = false;     ///< `tags`
  bool codeLink = false; ///< `codeDescription`
};

/// Writes findings of one check as JSON text, which is what is kept and sent of them: a check of a
/// text with a thousand findings writes them all again after each edit. Keeps the positions of each
/// file.
class DiagnosticWriter {
public:
  /// `dialect`: id of the control, of which the pages of rules show programs.
  DiagnosticWriter(const SourceSet &sources, PositionEncoding encoding, DiagnosticSupport support,
                   std::string dialect)
      : sources_(sources), places_(sources, encoding), support_(support),
        dialect_(std::move(dialect)) {}

  /// See `Places::spell`.
  void spell(FileId file, std::string uri) { places_.spell(file, std::move(uri)); }
  /// A `Diagnostic`.
  std::string diagnostic(const Finding &finding, const RuleInfo &rule);
  /// The edits of a fix by URI, as `WorkspaceEdit.changes` has them.
  std::string changes(const Fix &fix);

private:
  std::string lineOf(SourceRange range);
  std::string rangeText(SourceRange range);
  std::string relatedText(SourceRange range, llvm::StringRef message);

  const SourceSet &sources_;
  Places places_;
  DiagnosticSupport support_;
  std::string dialect_;
};

/// The page of a rule as a file that an editor can open, with the programs of this control where it
/// has some, written when first asked for; its URI, or empty when it cannot be written.
std::string rulePageUri(const RuleInfo &rule, llvm::StringRef dialect);

} // namespace ncvet::lsp
