// Edits that the user asks for: renaming, formatting, and the number of a new block.
#include "formats/text/failure.h"
#include "formats/text/file_uri.h"
#include "lsp/features/navigation/definition.h"
#include "lsp/features/writing/format.h"
#include "lsp/features/writing/on_type.h"
#include "lsp/features/writing/rename.h"
#include "lsp/features/writing/rename_program.h"
#include "lsp/features/writing/rename_shared.h"
#include "lsp/features/writing/renumber.h"
#include "lsp/server/bindings.h"
#include "lsp/server/workspace_edit.h"

#include "llvm/Support/MemoryBuffer.h"

#include <mutex>

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

/// Whether a program is named there that its file, or one round it, defines.
bool isProgramAt(View &view, uint32_t offset) {
  const Occurrence *const one = view.snapshot.names().at(offset);
  return one && isShared(*one) && targetOf(view.snapshot, view.snapshot.unit(), *one).has_value();
}

/// `WorkspaceEdit` of edits in several files; `elsewhere` says what those of other files are.
Json changesOf(View &view, llvm::ArrayRef<TextEdit> edits, const char *elsewhere) {
  Json edit = {{"changes", view.places.changes(edits)}};
  if (view.client.annotatesChanges)
    annotate(edit, view.document, [&](const std::string &uri) -> EditNote {
      return uri == view.document.uri ? EditNote{"here", "In this text"}
                                      : EditNote{"elsewhere", elsewhere};
    });
  return edit;
}

/// `WorkspaceEdit` of a rename; that of a file comes last.
Json editOf(View &view, const ProgramRename &renamed) {
  Json edit = changesOf(view, renamed.edits, "Calls in other programs");
  if (renamed.from.empty())
    return edit;
  makeSteps(edit, view.document);
  Json step = {
      {"kind", "rename"}, {"oldUri", uriOfPath(renamed.from)}, {"newUri", uriOfPath(renamed.to)}};
  if (view.client.annotatesChanges) {
    step["annotationId"] = "file";
    edit["changeAnnotations"]["file"] = {{"label", "The file that is named after the program"}};
  }
  edit["documentChanges"].push_back(std::move(step));
  return edit;
}

/// The file that a rename of a program moves. The editor asks of that move too, whose changes are
/// made already.
class OwnMove {
public:
  void set(std::string from, std::string to) {
    const std::lock_guard<std::mutex> lock(mutex_);
    move_ = {std::move(from), std::move(to)};
  }
  /// True once for the move that was set last.
  bool take(const std::string &from, const std::string &to) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (move_ != std::pair(from, to))
      return false;
    move_ = {};
    return true;
  }

private:
  std::mutex mutex_; ///< a rename is found on the thread of features
  std::pair<std::string, std::string> move_;
};

/// Binds a request for a rename: what refuses it is an error that the user reads.
void bindRename(Context &context, std::shared_ptr<OwnMove> own) {
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
         const uint32_t offset = view.offset(params);
         RenameSpot spot = prepareRename(view.snapshot, offset);
         if (spot.range.empty() && spot.refused.empty())
           return nullptr;
         if (isProgramAt(view, offset))
           spot.refused.clear();
         else if (!spot.refused.empty() && isSharedVariable(view.snapshot, offset))
           spot.refused = whyNotShared(view.snapshot, offset, view.programs());
         refused = spot.refused;
         return {{"range", view.places.range(spot.range)}, {"placeholder", spot.name}};
       });
  bind("textDocument/rename", [own](View &view, const Json &params, std::string &refused) -> Json {
    const std::string name = params.at("newName");
    const uint32_t offset = view.offset(params);
    if (isProgramAt(view, offset)) {
      const ProgramRename renamed = renameProgram(view.snapshot, offset, name, view.programs());
      refused = renamed.refused;
      if (!renamed.from.empty() && !view.client.renamesFiles)
        refused = "the file is named after the program, and this editor does not rename it as well";
      if (refused.empty() && !renamed.from.empty())
        own->set(renamed.from, renamed.to);
      return editOf(view, renamed);
    }
    RenameEdits renamed = rename(view.snapshot, offset, name);
    refused = renamed.refused;
    if (refused.empty() || !isSharedVariable(view.snapshot, offset))
      return {{"changes", view.places.changes(renamed.edits)}};
    const SharedRename shared = renameShared(view.snapshot, offset, name, view.programs());
    refused = shared.refused;
    return changesOf(view, shared.edits, "The variable in other programs");
  });
}

/// A file is to have another name: its program gets it too, and so do the calls of it.
void bindFileRename(Context &context, std::shared_ptr<OwnMove> own) {
  context.rpc.onRequest(
      "workspace/willRenameFiles", [&context, own](const Json &params, Reply reply) {
        const Json &files = params.at("files");
        if (!files.is_array() || files.size() != 1) // of several each could be the other's caller
          return reply(nullptr);
        const std::string uri = files[0].at("oldUri");
        const std::string to = pathOfUri(files[0].at("newUri").get<std::string>());
        if (own->take(pathOfUri(uri), to))
          return reply(nullptr);
        const Document *document = context.documents.find(uri);
        Document closed{uri, pathOfUri(uri), "", 0, {}};
        if (!document) {
          auto text = llvm::MemoryBuffer::getFile(closed.path, /*IsText=*/false,
                                                  /*RequiresNullTerminator=*/false);
          if (!text)
            return reply(nullptr);
          closed.text = textOf((*text)->getBuffer().str());
        }
        context.answerFor(
            document ? *document : closed, std::move(reply), [&context, to](View &view) -> Json {
              const ProgramRename renamed = renameWithFile(view.snapshot, to, view.programs());
              if (!renamed.refused.empty())
                context.warn("the calls of the program keep its name: " + renamed.refused);
              if (renamed.edits.empty())
                return nullptr;
              return editOf(view, renamed);
            });
      });
}

} // namespace

void bindEditing(Context &context) {
  const auto own = std::make_shared<OwnMove>();
  bindRename(context, own);
  bindFileRename(context, own);
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
