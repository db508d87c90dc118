// Navigation: where names are defined and used, the outline, folds, selections, calls and links.
#include "formats/text/file_uri.h"
#include "lsp/features/navigation/call_hierarchy.h"
#include "lsp/features/navigation/definition.h"
#include "lsp/features/navigation/folding.h"
#include "lsp/features/navigation/highlight.h"
#include "lsp/features/navigation/links.h"
#include "lsp/features/navigation/references.h"
#include "lsp/features/navigation/selection.h"
#include "lsp/features/navigation/symbols.h"
#include "lsp/server/bindings.h"
#include "lsp/server/progress.h"
#include "lsp/server/workspace_symbols.h"

namespace ncvet::lsp {

namespace {

Json nested(const Symbol &symbol, Places &places) {
  Json json = {{"name", symbol.name},
               {"kind", symbolKind(symbol.kind)},
               {"range", places.range(symbol.full)},
               {"selectionRange", places.range(symbol.selection)}};
  if (!symbol.detail.empty())
    json["detail"] = symbol.detail;
  for (const Symbol &child : symbol.children)
    json["children"].push_back(nested(child, places));
  return json;
}

void flat(const Symbol &symbol, const std::string &container, Places &places, Json &list) {
  Json json = {{"name", symbol.name},
               {"kind", symbolKind(symbol.kind)},
               {"location", places.location(symbol.full)}};
  if (!container.empty())
    json["containerName"] = container;
  list.push_back(std::move(json));
  for (const Symbol &child : symbol.children)
    flat(child, symbol.name, places, list);
}

Json outline(View &view) {
  Json list = Json::array();
  for (const Symbol &symbol : documentSymbols(view.snapshot))
    if (view.client.nestedSymbols)
      list.push_back(nested(symbol, view.places));
    else
      flat(symbol, "", view.places, list);
  return list;
}

Json defined(View &view, const Json &params) {
  const auto place = definition(view.snapshot, view.offset(params));
  if (!place)
    return nullptr;
  return view.places.location(place->name);
}

Json declared(View &view, const Json &params) {
  const auto place = declaration(view.snapshot, view.offset(params));
  if (!place)
    return nullptr;
  return view.places.location(*place);
}

Json used(Context &context, View &view, const Json &params) {
  const bool declaration = params.at("context").at("includeDeclaration");
  const auto locations = [&](const std::vector<SourceRange> &places) {
    Json list = Json::array();
    for (const SourceRange &place : places)
      list.push_back(view.places.location(place));
    return list;
  };
  const std::vector<std::string> programs = view.programs();
  WorkDone work(context.rpc, params, "references");
  PartialAnswer parts(context.rpc, params);
  GatherSteps steps;
  steps.looked = [&](size_t files) { work.report(files, programs.size()); };
  if (parts.isWanted())
    steps.found = [&](const std::vector<SourceRange> &places) { parts.send(locations(places)); };
  return locations(references(view.snapshot, view.offset(params), declaration, programs, steps));
}

Json highlighted(View &view, const Json &params) {
  constexpr int read = 2, write = 3;
  Json list = Json::array();
  for (const Highlight &place : highlights(view.snapshot, view.offset(params)))
    list.push_back(
        {{"range", view.places.range(place.range)}, {"kind", place.writes ? write : read}});
  return list;
}

Json folded(View &view) {
  Json list = Json::array();
  for (const Fold &fold : folds(view.snapshot)) {
    const Position begin = view.positions.at(fold.range.begin);
    const Position end = view.positions.at(fold.range.end);
    Json json = {{"startLine", begin.line}, {"endLine", end.line}};
    if (!view.client.lineFoldingOnly) {
      json["startCharacter"] = begin.character;
      json["endCharacter"] = end.character;
    }
    if (fold.kind == PartKind::Comments)
      json["kind"] = "comment";
    else if (fold.kind == PartKind::Generated)
      json["kind"] = "region";
    list.push_back(std::move(json));
  }
  return list;
}

Json selected(View &view, const Json &params) {
  std::vector<uint32_t> offsets;
  for (const Json &position : params.at("positions"))
    offsets.push_back(view.positions.offset(positionOf(position)));
  Json list = Json::array();
  for (const std::vector<SourceRange> &ranges : selections(view.snapshot, offsets)) {
    Json inner; // made from the outermost range on
    for (const SourceRange &range : llvm::reverse(ranges)) {
      Json json = {{"range", view.places.range(range)}};
      if (!inner.is_null())
        json["parent"] = std::move(inner);
      inner = std::move(json);
    }
    list.push_back(std::move(inner));
  }
  return list;
}

Json linked(View &view) {
  Json list = Json::array();
  for (const Link &link : links(view.snapshot))
    list.push_back({{"range", view.places.range(link.range)}, {"target", uriOfPath(link.path)}});
  return list;
}

/// The item with what later questions need: the document that was asked, and the place of its name.
Json itemJson(const CallItem &item, View &view, const std::string &document) {
  Json json = {{"name", item.name},
               {"kind", symbolKind(item.kind)},
               {"uri", view.places.uri(item.full.file)},
               {"range", view.places.range(item.full)},
               {"selectionRange", view.places.range(item.selection)},
               {"data", {{"document", document}}}};
  if (!item.detail.empty())
    json["detail"] = item.detail;
  return json;
}

/// Binds a question about an item of the call hierarchy.
void onItem(Context &context, llvm::StringRef method,
            std::function<Json(View &, const Json &item)> answer) {
  context.rpc.onRequest(method, [&context, answer](const Json &params, Reply reply) {
    const Json item = params.at("item");
    const std::string uri = item.at("data").at("document");
    const Document *document = context.documents.find(uri);
    if (!document)
      return reply.fail(RpcError::InvalidParams, "the document is not open: " + uri);
    context.answerFor(*document, std::move(reply),
                      [answer, item](View &view) { return answer(view, item); });
  });
}

/// Path and offset of an item's name; none when its file cannot be read.
std::optional<std::pair<std::string, uint32_t>> placeOf(View &view, const Json &item) {
  const std::string path = pathOfUri(item.at("uri").get<std::string>());
  const FileUnit *unit = view.snapshot.unitOf(path);
  if (!unit)
    return std::nullopt;
  const Json &start = item.at("selectionRange").at("start");
  return std::pair(path, view.places.of(unit->source.id()).offset(positionOf(start)));
}

Json edges(View &view, llvm::ArrayRef<CallEdge> calls, const char *who,
           const std::string &document) {
  Json list = Json::array();
  for (const CallEdge &edge : calls) {
    Json ranges = Json::array();
    for (const SourceRange &place : edge.places)
      ranges.push_back(view.places.range(place));
    list.push_back({{who, itemJson(edge.item, view, document)}, {"fromRanges", std::move(ranges)}});
  }
  return list;
}

void bindCallHierarchy(Context &context) {
  context.onDocument("textDocument/prepareCallHierarchy",
                     [](View &view, const Json &params) -> Json {
                       const auto item = callItem(view.snapshot, view.offset(params));
                       if (!item)
                         return nullptr;
                       Json list = Json::array();
                       list.push_back(itemJson(*item, view, view.document.uri));
                       return list;
                     });
  onItem(context, "callHierarchy/incomingCalls", [](View &view, const Json &item) -> Json {
    const auto place = placeOf(view, item);
    if (!place)
      return nullptr;
    return edges(view, incomingCalls(view.snapshot, place->first, place->second, view.programs()),
                 "from", view.document.uri);
  });
  onItem(context, "callHierarchy/outgoingCalls", [](View &view, const Json &item) -> Json {
    const auto place = placeOf(view, item);
    if (!place)
      return nullptr;
    return edges(view, outgoingCalls(view.snapshot, place->first, place->second), "to",
                 view.document.uri);
  });
}

/// Answers `workspace/symbol`.
void bindWorkspaceSymbols(Context &context) {
  auto symbols = std::make_shared<WorkspaceSymbols>();
  context.rpc.onRequest("workspace/symbol", [&context, symbols](const Json &params, Reply reply) {
    auto held = std::make_shared<Reply>(std::move(reply));
    context.workspace->post([&context, symbols, held, query = params.at("query").get<std::string>(),
                             params, job = context.job(Document()), folders = context.folders] {
      Json found = Json::array();
      {
        WorkDone work(context.rpc, params, "symbols");
        PartialAnswer parts(context.rpc, params);
        found = symbols->search(job, folders, query, work, parts, held->cancelled());
      }
      (*held)(std::move(found));
    });
  });
}

} // namespace

int symbolKind(PartKind kind) {
  constexpr int module = 2, classKind = 5, event = 24, function = 12, key = 20, object = 19;
  switch (kind) {
  case PartKind::Program:
    return module;
  case PartKind::Subprogram:
    return function;
  case PartKind::Tool:
    return classKind;
  case PartKind::Operation:
    return event;
  case PartKind::Label:
    return key;
  default:
    return object;
  }
}

void bindNavigation(Context &context) {
  context.onDocument("textDocument/definition", defined);
  // The text of a program is its definition and its implementation.
  context.onDocument("textDocument/implementation", defined);
  context.onDocument("textDocument/declaration", declared);
  context.onDocument("textDocument/references", [&context](View &view, const Json &params) {
    return used(context, view, params);
  });
  context.onDocument("textDocument/documentHighlight", highlighted);
  context.onDocument("textDocument/documentSymbol",
                     [](View &view, const Json &) { return outline(view); });
  context.onDocument("textDocument/foldingRange",
                     [](View &view, const Json &) { return folded(view); });
  context.onDocument("textDocument/selectionRange", selected);
  context.onDocument("textDocument/documentLink",
                     [](View &view, const Json &) { return linked(view); });
  bindCallHierarchy(context);
  bindWorkspaceSymbols(context);
}

} // namespace ncvet::lsp
