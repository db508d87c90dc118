// Code actions that rewrite selected blocks.
#pragma once

#include "lsp/server/context.h"

namespace ncvet::lsp {

/// The rewritings of the selection [begin, end) that are proved, as code actions; those that are
/// refused are left out. `wants` says whether the client asks for a kind, `add` takes the title,
/// the kind and the `WorkspaceEdit`. Texts over 128 KiB get none: each is proved by following the
/// program, at each move of the selection.
void rewritingsOf(View &view, uint32_t begin, uint32_t end,
                  llvm::function_ref<bool(llvm::StringRef kind)> wants,
                  llvm::function_ref<void(std::string title, llvm::StringRef kind, Json edit)> add);

/// Shifts, mirrors or scales a range of a document as the arguments of `ncvet.transform` say:
/// `{ "uri", "range", "axes": { "X": { "factor": -1, "shift": 0 } } }`, mm and degrees. The client
/// is asked to make the edit; an error says why there is none.
void transformRange(Context &context, const Json &arguments, Reply reply);

} // namespace ncvet::lsp
