// Findings as diagnostics of the protocol.
#pragma once

#include "formats/finding/finding.h"
#include "formats/text/source_set.h"
#include "lsp/protocol/json.h"

#include "llvm/ADT/StringMap.h"

namespace ncvet::lsp {

/// What the client can show of a diagnostic.
struct DiagnosticSupport {
  bool related = false;  ///< `relatedInformation`; without it further places stand in the message
  bool tags = false;     ///< `tags`
  bool codeLink = false; ///< `codeDescription`
};

/// Writes findings of one check. Keeps the positions of each file.
class DiagnosticWriter {
public:
  DiagnosticWriter(const SourceSet &sources, PositionEncoding encoding, DiagnosticSupport support)
      : sources_(sources), encoding_(encoding), support_(support) {}

  Json diagnostic(const Finding &finding, const RuleInfo &rule);
  /// The edits of a fix by URI.
  Json changes(const Fix &fix);
  Positions &positions(FileId file);

private:
  Json location(SourceRange range);
  std::string lineOf(SourceRange range);

  const SourceSet &sources_;
  PositionEncoding encoding_;
  DiagnosticSupport support_;
  std::map<FileId, Positions> positions_;
};

/// The page of a rule as a file that an editor can open, written when first asked for; its URI, or
/// empty when it cannot be written.
std::string rulePageUri(const RuleInfo &rule);

} // namespace ncvet::lsp
