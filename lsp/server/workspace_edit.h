// A `WorkspaceEdit` as steps, and what its edits are, for clients that show them before they are
// made.
#pragma once

#include "lsp/server/documents.h"

namespace ncvet::lsp {

/// A `ChangeAnnotation` with its id.
struct EditNote {
  std::string id, label;
  std::string description = {};
  bool needsConfirmation = false; ///< the user has to agree to each of these edits
};

/// Edits by URI, in the member `changes`, become steps in `documentChanges`. `document` is the one
/// that was asked about: of the others no version is known.
void makeSteps(Json &edit, const Document &document);

/// The same; `noteOf` says what the edits of a URI are.
void annotate(Json &edit, const Document &document,
              llvm::function_ref<EditNote(const std::string &uri)> noteOf);

} // namespace ncvet::lsp
