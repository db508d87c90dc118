// The parts of the server: each binds the methods of one topic.
#pragma once

#include "lsp/features/parts.h"
#include "lsp/server/context.h"

namespace ncvet::lsp {

void bindDocuments(Context &context);   ///< open, change, close, save; settings and watched files
void bindDiagnostics(Context &context); ///< pull diagnostics of documents and of the workspace
void bindActions(Context &context);     ///< quick fixes, suppressions, explanations
void bindHover(Context &context);
void bindNavigation(Context &context); ///< names, outline, folds, selections, calls, links
void bindWriting(Context &context);    ///< completion, signatures, colours, hints, lenses
void bindPaths(Context &context);      ///< the path of the tool, `ncvet/path`
void bindEditing(Context &context);    ///< renaming, formatting, numbers of new blocks

/// `SymbolKind` of the protocol.
int symbolKind(PartKind kind);
/// The types and modifiers of semantic tokens, as the capabilities name them.
Json tokensLegend();

} // namespace ncvet::lsp
