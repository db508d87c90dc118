// Hover: the machine's state at the block under the cursor.
#include "lsp/features/machine_state.h"
#include "lsp/server/bindings.h"

namespace ncvet::lsp {

void bindHover(Context &context) {
  context.onDocument("textDocument/hover", [](View &view, const Json &params) -> Json {
    const uint32_t offset = view.offset(params);
    Block block;
    view.snapshot.readAt(offset, block);
    if (offset < block.begin || offset > block.end || block.isEmpty())
      return nullptr;
    const std::string state = machineState(view.snapshot, offset, &view.cancelled, view.runs);
    if (state.empty())
      return nullptr;
    return {{"contents",
             {{"kind", view.client.markdown ? "markdown" : "plaintext"},
              {"value", "**In front of this block**\n\n" + state}}},
            {"range", rangeJson(view.positions, block.begin, block.end)}};
  });
}

} // namespace ncvet::lsp
