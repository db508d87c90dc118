// Edits that the user asks for: renaming, formatting, and the number of a new block.
#include "formats/text/failure.h"
#include "lsp/features/writing/format.h"
#include "lsp/features/writing/on_type.h"
#include "lsp/features/writing/rename.h"
#include "lsp/features/writing/renumber.h"
#include "lsp/server/bindings.h"

namespace ncvet::lsp {

namespace {

Json formatted(View &view, uint32_t begin, uint32_t end) {
  FormatOptions options;
  options.words = view.settings.format.spaces ? WordSpacing::One : WordSpacing::None;
  return editsJson(view.positions, formatEdits(view.snapshot, begin, end, options));
}

/// Blanks, and new block numbers where the settings want them.
Json formattedWhole(Context &context, View &view) {
  const auto end = uint32_t(view.snapshot.text().size());
  if (view.settings.format.renumber == 0)
    return formatted(view, 0, end);
  NumberOptions options;
  options.step = view.settings.format.renumber;
  options.first = view.settings.format.firstNumber ? view.settings.format.firstNumber
                                                   : view.settings.format.renumber;
  const Renumbering numbers = renumber(view.snapshot, options);
  if (!numbers.refusal.empty())
    context.warn("the blocks keep their numbers: " + numbers.refusal);
  // Numbers and blanks lie beside each other: those of blanks that touch a number wait.
  FormatOptions blanks;
  blanks.words = view.settings.format.spaces ? WordSpacing::One : WordSpacing::None;
  std::vector<TextEdit> edits = numbers.edits;
  for (TextEdit &edit : formatEdits(view.snapshot, 0, end, blanks)) {
    const auto touching = std::lower_bound(
        numbers.edits.begin(), numbers.edits.end(), edit.range.begin,
        [](const TextEdit &number, uint32_t begin) { return number.range.end < begin; });
    if (touching == numbers.edits.end() || touching->range.begin > edit.range.end)
      edits.push_back(std::move(edit));
  }
  llvm::stable_sort(
      edits, [](const TextEdit &a, const TextEdit &b) { return a.range.begin < b.range.begin; });
  return editsJson(view.positions, edits);
}

/// Binds a request for a rename: what refuses it is an error that the user reads.
void bindRename(Context &context) {
  const auto bind =
      [&context](llvm::StringRef method,
                 std::function<Json(View &, const Json &, std::string &refused)> ask) {
        context.rpc.onRequest(method, [&context, ask](const Json &params, Reply reply) {
          const std::string uri = params.at("textDocument").at("uri");
          const Document *document = context.documents.find(uri);
          if (!document)
            return reply.fail(RpcError::InvalidParams, "the document is not open: " + uri);
          context.answerOrFail(*document, std::move(reply), [ask, params](View &view) {
            std::string refused;
            Json answer = ask(view, params, refused);
            if (refused.empty())
              return llvm::Expected<Json>(std::move(answer));
            return llvm::Expected<Json>(failure(refused));
          });
        });
      };
  bind("textDocument/prepareRename",
       [](View &view, const Json &params, std::string &refused) -> Json {
         const RenameSpot spot = prepareRename(view.snapshot, view.offset(params));
         if (spot.range.empty() && spot.refused.empty())
           return nullptr;
         refused = spot.refused;
         return {{"range", view.places.range(spot.range)}, {"placeholder", spot.name}};
       });
  bind("textDocument/rename", [](View &view, const Json &params, std::string &refused) -> Json {
    const std::string name = params.at("newName");
    RenameEdits renamed = rename(view.snapshot, view.offset(params), name);
    refused = renamed.refused;
    return {{"changes", view.places.changes(renamed.edits)}};
  });
}

} // namespace

void bindEditing(Context &context) {
  bindRename(context);
  context.onDocument("textDocument/formatting", [&context](View &view, const Json &) {
    return formattedWhole(context, view);
  });
  context.onDocument("textDocument/rangeFormatting", [](View &view, const Json &params) {
    const auto [begin, end] = view.range(params);
    return formatted(view, begin, end);
  });
  context.onDocument("textDocument/onTypeFormatting", [](View &view, const Json &params) {
    const auto edit = numberOfNewBlock(view.snapshot, view.offset(params));
    return edit ? editsJson(view.positions, *edit) : Json::array();
  });
}

} // namespace ncvet::lsp
