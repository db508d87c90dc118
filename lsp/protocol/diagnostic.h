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

/// Writes findings of one check. Keeps the positions of each file.
class DiagnosticWriter {
public:
  DiagnosticWriter(const SourceSet &sources, PositionEncoding encoding, DiagnosticSupport support)
      : sources_(sources), places_(sources, encoding), support_(support) {}

  Json diagnostic(const Finding &finding, const RuleInfo &rule);
  /// The edits of a fix by URI.
  Json changes(const Fix &fix) { return places_.changes(fix.edits); }

private:
  std::string lineOf(SourceRange range);

  const SourceSet &sources_;
  Places places_;
  DiagnosticSupport support_;
};

/// The page of a rule as a file that an editor can open, written when first asked for; its URI, or
/// empty when it cannot be written.
std::string rulePageUri(const RuleInfo &rule);

} // namespace ncvet::lsp
