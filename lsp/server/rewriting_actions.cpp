// Code actions that rewrite selected blocks.
#include "lsp/server/rewriting_actions.h"

#include "formats/dialect/vocabulary.h"
#include "formats/text/failure.h"
#include "formats/text/file_uri.h"
#include "lsp/features/writing/rewritings.h"
#include "lsp/server/workspace_edit.h"

namespace ncvet::lsp {

namespace {

/// Longer texts are not followed at each move of the selection.
constexpr size_t mostText = 128 * 1024;
/// Step of new block numbers where the settings have none.
constexpr unsigned usualStep = 10;

Rewriting mirrored(Selection &selection, size_t axis) {
  AxisChanges changes;
  changes[axis].factor = -1;
  return transform(selection, changes, ("Mirror the selection in " + axisNames()[axis]).str());
}

llvm::Expected<AxisChanges> changesOf(const Json &axes) {
  AxisChanges changes;
  if (!axes.is_object())
    return failure("`axes` is an object");
  for (const auto &[name, change] : axes.items()) {
    const auto known = llvm::find(axisNames(), name);
    if (known == axisNames().end())
      return failure("there is no axis " + name);
    AxisChange &one = changes[size_t(known - axisNames().begin())];
    one.factor = change.value("factor", 1.0);
    one.shift = change.value("shift", 0.0);
    if (!std::isfinite(one.factor) || !std::isfinite(one.shift) || one.factor == 0)
      return failure("a factor is another number than 0, a shift a number");
  }
  return changes;
}

/// `WorkspaceEdit` of a rewriting.
Json editOf(View &view, const Rewriting &made) {
  Json edit = {{"changes", {{view.document.uri, editsJson(view.positions, made.edits)}}}};
  if (!made.file)
    return edit;
  makeSteps(edit, view.document);
  const std::string uri = uriOfPath(made.file->path);
  const Json begin = {{"line", 0}, {"character", 0}};
  const Json text = {{"range", {{"start", begin}, {"end", begin}}}, {"newText", made.file->text}};
  Json &steps = edit["documentChanges"];
  steps.push_back({{"kind", "create"}, {"uri", uri}});
  steps.push_back(
      {{"textDocument", {{"uri", uri}, {"version", nullptr}}}, {"edits", Json::array({text})}});
  return edit;
}

} // namespace

void rewritingsOf(View &view, uint32_t begin, uint32_t end,
                  llvm::function_ref<bool(llvm::StringRef)> wants,
                  llvm::function_ref<void(std::string, llvm::StringRef, Json)> add) {
  if (view.snapshot.text().size() > mostText)
    return;
  Selection selection(view.snapshot, begin, end, view.job.overlay, &view.cancelled);
  selection.checkBy(view.session);
  const unsigned step = view.settings.format.renumber ? view.settings.format.renumber : usualStep;
  const bool lathe = selection.dialect().isLathe();
  const auto offer = [&](llvm::StringRef kind, llvm::function_ref<Rewriting()> make) {
    if (view.cancelled || !wants(kind))
      return;
    Rewriting made = make();
    if (!made.refused.empty() || view.cancelled || (made.file && !view.client.createsFiles))
      return;
    Json edit = editOf(view, made);
    add(std::move(made.title), kind, std::move(edit));
  };
  constexpr llvm::StringLiteral rewrite = "refactor.rewrite.ncvet";
  offer(rewrite, [&] { return renumberSelection(selection, step); });
  offer(rewrite, [&] { return toIncremental(selection); });
  offer(rewrite, [&] { return toAbsolute(selection); });
  for (const size_t axis : {size_t(lathe ? Axis::Z : Axis::X), size_t(lathe ? Axis::X : Axis::Y)})
    offer(rewrite, [&] { return mirrored(selection, axis); });
  offer(rewrite, [&] { return toggleBlockSkip(selection); });
  offer(rewrite, [&] { return unroll(selection); });
  offer(rewrite, [&] { return cyclesToMoves(selection); });
  offer(rewrite, [&] { return movesToCycle(selection); });
  offer("refactor.inline.ncvet", [&] { return inlineCall(selection); });
  offer("refactor.extract.ncvet", [&] { return extractSubprogram(selection); });
}

void transformRange(Context &context, const Json &arguments, Reply reply) {
  const Json wanted = arguments.at(0);
  const std::string uri = wanted.at("uri");
  const Document *document = context.documents.find(uri);
  if (!document)
    return reply.fail(RpcError::InvalidParams, "the document is not open: " + uri);
  auto changes = changesOf(wanted.at("axes"));
  if (!changes)
    return reply.fail(RpcError::InvalidParams, llvm::toString(changes.takeError()));
  context.answerOrFail(
      *document, std::move(reply),
      [&context, wanted, changes = *changes](View &view) -> llvm::Expected<Json> {
        const auto [begin, end] = view.range(wanted);
        Selection selection(view.snapshot, begin, end, view.job.overlay, &view.cancelled);
        const Rewriting made = transform(selection, changes, "Change the coordinates");
        if (!made.refused.empty())
          return failure(made.refused);
        const Json edits = editsJson(view.positions, made.edits);
        context.rpc.request(
            "workspace/applyEdit",
            {{"label", made.title}, {"edit", {{"changes", {{view.document.uri, edits}}}}}},
            nullptr);
        return Json();
      });
}

} // namespace ncvet::lsp
