// A `WorkspaceEdit` as steps, and what its edits are.
#include "lsp/server/workspace_edit.h"

namespace ncvet::lsp {

void makeSteps(Json &edit, const Document &document) {
  const auto changes = edit.find("changes");
  if (changes == edit.end())
    return;
  Json steps = Json::array();
  for (const auto &[uri, edits] : changes->items()) {
    Json version = nullptr;
    if (uri == document.uri)
      version = document.version;
    steps.push_back(
        {{"textDocument", {{"uri", uri}, {"version", std::move(version)}}}, {"edits", edits}});
  }
  edit.erase("changes");
  edit["documentChanges"] = std::move(steps);
}

void annotate(Json &edit, const Document &document,
              llvm::function_ref<EditNote(const std::string &uri)> noteOf) {
  for (auto &[uri, edits] : edit["changes"].items()) {
    const EditNote note = noteOf(uri);
    for (Json &one : edits)
      one["annotationId"] = note.id;
    Json &known = edit["changeAnnotations"][note.id];
    known = {{"label", note.label}, {"needsConfirmation", note.needsConfirmation}};
    if (!note.description.empty())
      known["description"] = note.description;
  }
  makeSteps(edit, document);
}

} // namespace ncvet::lsp
