// Hover: what the word under the cursor is, and the machine's state in front of its block.
#include "lsp/features/machine_state.h"
#include "lsp/features/word_help.h"
#include "lsp/server/bindings.h"

namespace ncvet::lsp {

void bindHover(Context &context) {
  context.onDocument("textDocument/hover", [](View &view, const Json &params) -> Json {
    const uint32_t offset = view.offset(params);
    Block block;
    view.snapshot.readAt(offset, block);
    if (offset < block.begin || offset > block.end || block.isEmpty())
      return nullptr;
    const auto word = wordHelp(view.snapshot, offset, view.stateBefore(offset));
    const std::string state =
        view.states_ ? machineState(view.snapshot, *view.states_) : std::string();
    std::string text;
    if (word)
      text = word->markdown;
    if (!state.empty())
      text += (text.empty() ? "" : "\n\n---\n\n") + ("**In front of this block**\n\n" + state);
    if (text.empty())
      return nullptr;
    return {
        {"contents", {{"kind", view.client.markdown ? "markdown" : "plaintext"}, {"value", text}}},
        {"range", word ? view.places.range(word->range)
                       : rangeJson(view.positions, block.begin, block.end)}};
  });
}

} // namespace ncvet::lsp
