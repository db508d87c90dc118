// Hover: what the word under the cursor is, and the machine's state before its block.
#include "formats/readers/table_words.h"
#include "lsp/features/showing/code_lens.h"
#include "lsp/features/showing/document_states.h"
#include "lsp/features/showing/inline_values.h"
#include "lsp/features/showing/machine_state.h"
#include "lsp/features/showing/word_help.h"
#include "lsp/server/bindings.h"

namespace ncvet::lsp {

namespace {

/// "safe up to R6.00", of the contour that begins in the block; empty: none does.
std::string contourAt(Snapshot &snapshot, const Block &block) {
  const bool compensates = llvm::any_of(block.words, [&](const Word &word) {
    const CodeIndex code = codeOf(snapshot.dialect(), word);
    const Action action = code == noCode ? Action::None : snapshot.dialect().codes[code].action;
    return action == Action::CompensationLeft || action == Action::CompensationRight;
  });
  if (!compensates) // the whole program has to be followed for it
    return {};
  return titleOfContour(snapshot, block.begin);
}

} // namespace

void bindHover(Context &context) {
  context.onDocument("textDocument/inlineValue", [](View &view, const Json &params) {
    const auto [begin, end] = view.range(params);
    // What comes after the block at which the program waits has not been executed yet.
    const Json &stop = params.at("context").at("stoppedLocation").at("end");
    const uint32_t last = view.positions.offset(positionOf(stop));
    Json list = Json::array();
    for (const InlineValue &value : inlineValues(view.snapshot, begin, std::min(end, last)))
      list.push_back({{"range", view.places.range(value.range)}, {"expression", value.expression}});
    return list;
  });
  context.onDocument("textDocument/hover", [](View &view, const Json &params) -> Json {
    const uint32_t offset = view.offset(params);
    Block block;
    view.snapshot.readAt(offset, block);
    if (offset < block.begin || offset > block.end || block.isEmpty())
      return nullptr;
    const auto states = view.statesAt(offset);
    const auto word = wordHelp(view.snapshot, offset, states ? states->firstBefore() : nullptr);
    const std::string state =
        states ? machineState(view.snapshot.dialect(), states->at(), states->sources())
               : "not known yet: the program is still being followed";
    std::string text;
    if (word)
      text = word->markdown;
    if (!state.empty())
      text += (text.empty() ? "" : "\n\n---\n\n") + ("**Before this block**\n\n" + state);
    if (const std::string contour = states ? contourAt(view.snapshot, block) : ""; !contour.empty())
      text += (text.empty() ? "" : "\n\n") + contour;
    if (text.empty())
      return nullptr;
    return {
        {"contents", {{"kind", view.client.markdown ? "markdown" : "plaintext"}, {"value", text}}},
        {"range", word ? view.places.range(word->range)
                       : rangeJson(view.positions, block.begin, block.end)}};
  });
}

} // namespace ncvet::lsp
