// The parts of the server: each binds the methods of one topic.
#pragma once

#include "lsp/server/context.h"

namespace ncvet::lsp {

void bindDocuments(Context &context);   ///< open, change, close, save; settings and watched files
void bindDiagnostics(Context &context); ///< pull diagnostics of documents and of the workspace
void bindActions(Context &context);     ///< quick fixes, suppressions, explanations
void bindHover(Context &context);

} // namespace ncvet::lsp
