// Writing: completion, signatures, colours, hints in the text, lenses over it.
#include "formats/text/formatted.h"
#include "lsp/features/showing/code_lens.h"
#include "lsp/features/showing/document_states.h"
#include "lsp/features/showing/inlay_hints.h"
#include "lsp/features/showing/semantic_tokens.h"
#include "lsp/features/showing/word_help.h"
#include "lsp/features/writing/completion.h"
#include "lsp/features/writing/linked_editing.h"
#include "lsp/features/writing/signature_help.h"
#include "lsp/server/bindings.h"

namespace ncvet::lsp {

namespace {

/// `CompletionItemKind` of the protocol.
int completionKind(CompletionKind kind) {
  switch (kind) {
  case CompletionKind::Code:
    return 3; // function
  case CompletionKind::Word:
    return 10; // property
  case CompletionKind::Parameter:
    return 5; // field
  case CompletionKind::Keyword:
    return 14;
  case CompletionKind::Label:
    return 18; // reference
  case CompletionKind::Variable:
    return 6;
  case CompletionKind::Program:
    return 9; // module
  }
  return 1;
}

/// A snippet without its place holders, for editors that know none.
std::string plainText(llvm::StringRef snippet) {
  std::string text;
  while (!snippet.empty()) {
    if (snippet.consume_front("${")) {
      const auto [head, rest] = snippet.split('}');
      text += head.split(':').second;
      snippet = rest;
    } else if (snippet.front() == '$' && snippet.size() > 1 && llvm::isDigit(snippet[1])) {
      snippet = snippet.drop_front(2);
    } else {
      if (snippet.front() == '\\' && snippet.size() > 1)
        snippet = snippet.drop_front();
      text += snippet.front();
      snippet = snippet.drop_front();
    }
  }
  return text;
}

/// A label whose order as a text is that of its numbers: G1 before G05.1 before G10.
std::string sortKey(int rank, llvm::StringRef label) {
  std::string key = ncvet::formatted("{0:d3}", rank);
  while (!label.empty()) {
    const llvm::StringRef digits = label.take_while(llvm::isDigit);
    const llvm::StringRef number = digits.ltrim('0');
    constexpr size_t width = 6;
    if (!digits.empty())
      key += std::string(width - std::min(width, number.size()), '0') + number.str();
    else
      key += label.front();
    label = label.drop_front(std::max(digits.size(), size_t(1)));
  }
  return key;
}

Json completed(View &view, const Json &params) {
  constexpr int snippetFormat = 2;
  const uint32_t offset = view.offset(params);
  const auto states = view.statesAt(offset);
  const std::vector<CompletionItem> found =
      completions(view.snapshot, offset, states ? states->firstBefore() : nullptr);
  const bool shared = view.client.sharesEditRange && !found.empty() &&
                      llvm::all_of(found, [&](const CompletionItem &item) {
                        return item.replace == found.front().replace;
                      });
  Json items = Json::array();
  for (const CompletionItem &item : found) {
    const bool snippet = item.snippet && view.client.snippets;
    Json json = {{"label", item.label},
                 {"kind", completionKind(item.kind)},
                 {"sortText", sortKey(int(item.rank), item.label)}};
    std::string text = item.snippet && !snippet ? plainText(item.insert) : item.insert;
    if (!shared)
      json["textEdit"] = {{"range", view.places.range(item.replace)}, {"newText", std::move(text)}};
    else if (text != item.label)
      json["textEditText"] = std::move(text);
    if (snippet)
      json["insertTextFormat"] = snippetFormat;
    if (!item.detail.empty())
      json["detail"] = item.detail;
    if (!item.detail.empty() && view.client.labelDetails)
      json["labelDetails"] = {{"description", item.detail}}; // seen before an item is chosen
    if (!item.documentation.empty())
      json["data"] = {{"uri", view.document.uri}, {"id", item.documentation}};
    items.push_back(std::move(json));
  }
  Json list = {{"isIncomplete", false}, {"items", std::move(items)}};
  if (shared)
    list["itemDefaults"] = {{"editRange", view.places.range(found.front().replace)}};
  return list;
}

void resolveCompletion(Context &context) {
  context.rpc.onRequest("completionItem/resolve", [&context](const Json &params, Reply reply) {
    const Json data = params.value("data", Json());
    const Document *document =
        data.is_object() ? context.documents.find(data.value("uri", "")) : nullptr;
    if (!document)
      return reply(params);
    context.answerFor(*document, std::move(reply), [params, data](View &view) {
      Json item = params;
      std::string help = completionHelp(view.snapshot.dialect(), data.at("id").get<std::string>());
      if (!help.empty())
        item["documentation"] = {{"kind", "markdown"}, {"value", std::move(help)}};
      return item;
    });
  });
}

Json signature(View &view, const Json &params) {
  const auto found = signatureHelp(view.snapshot, view.offset(params));
  if (!found)
    return nullptr;
  Json parameters = Json::array();
  for (const SignatureParameter &parameter : found->parameters)
    parameters.push_back(
        {{"label", found->label.substr(parameter.begin, parameter.end - parameter.begin)},
         {"documentation", parameter.documentation}});
  Json one = {{"label", found->label},
              {"documentation", found->documentation},
              {"parameters", std::move(parameters)}};
  Json answer = {{"signatures", {std::move(one)}}, {"activeSignature", 0}};
  if (found->active >= 0)
    answer["activeParameter"] = found->active;
  return answer;
}

Json hinted(View &view, const Json &params) {
  const auto [begin, end] = view.range(params);
  HintOptions options;
  options.on[size_t(HintKind::Value)] = view.settings.hints.units;
  options.on[size_t(HintKind::Variable)] = view.settings.hints.values;
  options.on[size_t(HintKind::Target)] = view.settings.hints.values;
  options.on[size_t(HintKind::Motion)] = view.settings.hints.motion;
  Json list = Json::array();
  for (const InlayHint &hint : inlayHints(view.snapshot, begin, end, options, &view.cancelled)) {
    Json json = {{"position", toJson(view.positions.at(hint.offset))}, {"label", hint.text}};
    if (view.client.resolvesHints)
      json["data"] = {{"uri", view.document.uri},
                      {"version", view.document.version},
                      {"offset", hint.offset},
                      {"motion", hint.kind == HintKind::Motion}};
    list.push_back(std::move(json));
  }
  return list;
}

/// Gives a hint its explanation: that of the word which it is about, and of a mode the place where
/// it was switched on.
Json explainHint(View &view, Json hint) {
  const Json &data = hint.at("data");
  const uint32_t offset =
      std::min(data.at("offset").get<uint32_t>(), uint32_t(view.snapshot.text().size()));
  const auto states = view.statesAt(offset);
  const MachineState *const before = states ? states->firstBefore() : nullptr;
  std::optional<WordHelp> help;
  if (!data.at("motion").get<bool>()) {
    help = wordHelp(view.snapshot, offset == 0 ? 0 : offset - 1, before);
  } else if (const auto place = before ? placeOfMotion(view.snapshot.dialect(), *before)
                                       : std::optional<SourceRange>();
             place && place->file == view.snapshot.source().id()) {
    help = wordHelp(view.snapshot, place->begin, nullptr);
    const Json label = {{"value", hint.at("label")}, {"location", view.places.location(*place)}};
    hint["label"] = Json::array({label});
  }
  if (help)
    hint["tooltip"] = {{"kind", view.client.markdown ? "markdown" : "plaintext"},
                       {"value", help->markdown}};
  return hint;
}

/// Binds the request for what was left out of an item, whose `data` names the version of the
/// document.
void onResolve(Context &context, const char *method, Json (*resolve)(View &, Json)) {
  context.rpc.onRequest(method, [&context, resolve](const Json &params, Reply reply) {
    const Json data = params.value("data", Json());
    const Document *document =
        data.is_object() ? context.documents.find(data.value("uri", "")) : nullptr;
    if (!document)
      return reply(params);
    if (document->version != data.at("version"))
      return reply.fail(RpcError::ContentModified, "the document has changed");
    context.answerFor(*document, std::move(reply),
                      [params, resolve](View &view) { return resolve(view, params); });
  });
}

Json linkedTo(View &view, const Json &params) {
  const std::vector<SourceRange> places = linkedPlaces(view.snapshot, view.offset(params));
  if (places.empty())
    return nullptr;
  Json ranges = Json::array();
  for (const SourceRange &place : places)
    ranges.push_back(view.places.range(place));
  return {{"ranges", std::move(ranges)}, {"wordPattern", "[A-Za-z0-9_]+"}};
}

Json lenses(View &view) {
  Json list = Json::array();
  for (const CodeLens &lens : lensesToResolve(view.snapshot)) {
    Json json = {{"range", view.places.range(lens.range)}};
    if (lens.title.empty()) {
      json["data"] = {{"uri", view.document.uri},
                      {"version", view.document.version},
                      {"offset", lens.range.begin}};
      list.push_back(std::move(json));
      continue;
    }
    Json command = {{"title", lens.title}, {"command", ""}};
    if (!lens.places.empty()) {
      Json places = Json::array();
      for (const SourceRange &place : lens.places)
        places.push_back(view.places.location(place));
      command["command"] = "ncvet.showReferences";
      command["arguments"] = {view.document.uri, toJson(view.positions.at(lens.range.begin)),
                              std::move(places)};
    }
    json["command"] = std::move(command);
    list.push_back(std::move(json));
  }
  return list;
}

/// Gives a lens over a contour its title: the whole program has to be followed for it.
Json withTitle(View &view, Json lens) {
  const std::string title =
      titleOfContour(view.snapshot, lens.at("data").at("offset").get<uint32_t>());
  lens["command"] = {{"title", title.empty() ? "largest tool radius: not known" : title},
                     {"command", ""}};
  return lens;
}

/// Semantic tokens, and those that were sent last, for replies that hold only what has changed.
class Tokens {
public:
  Json full(View &view) {
    if (view.snapshot.text().size() > longestWhole)
      return nullptr;
    Sent &sent = sent_[view.document.uri];
    sent.data = encode(view, semanticTokens(view.snapshot));
    sent.id = std::to_string(++lastId_);
    return {{"resultId", sent.id}, {"data", sent.data}};
  }
  Json range(View &view, const Json &params) {
    const auto [begin, end] = view.range(params);
    return {{"data", encode(view, semanticTokens(view.snapshot, begin, end))}};
  }
  Json delta(View &view, const Json &params) {
    Sent &sent = sent_[view.document.uri];
    if (sent.id.empty() || params.at("previousResultId") != sent.id)
      return full(view);
    const std::vector<uint32_t> before = std::move(sent.data);
    if (full(view).is_null())
      return nullptr;
    const std::vector<uint32_t> &after = sent.data;
    const size_t most = std::min(before.size(), after.size());
    size_t front = 0, back = 0;
    while (front < most && before[front] == after[front])
      ++front;
    while (back < most - front &&
           before[before.size() - 1 - back] == after[after.size() - 1 - back])
      ++back;
    Json edits = Json::array();
    if (front + back < std::max(before.size(), after.size()))
      edits.push_back({{"start", front},
                       {"deleteCount", before.size() - front - back},
                       {"data", std::vector<uint32_t>(after.begin() + ptrdiff_t(front),
                                                      after.end() - ptrdiff_t(back))}});
    return {{"resultId", sent.id}, {"edits", std::move(edits)}};
  }

private:
  /// The colours of a longer text are given for what is in sight alone: those of 24 MB are 60 MB of
  /// JSON, after every edit.
  static constexpr size_t longestWhole = 4 << 20;

  struct Sent {
    std::string id;
    std::vector<uint32_t> data;
  };
  static std::vector<uint32_t> encode(View &view, llvm::ArrayRef<SemanticToken> tokens) {
    std::vector<uint32_t> data;
    data.reserve(tokens.size() * 5);
    Position last;
    for (const SemanticToken &token : tokens) {
      const Position begin = view.positions.at(token.begin), end = view.positions.at(token.end);
      const bool sameLine = begin.line == last.line;
      data.push_back(begin.line - last.line);
      data.push_back(sameLine ? begin.character - last.character : begin.character);
      data.push_back(end.character - begin.character);
      data.push_back(uint32_t(token.type));
      data.push_back(token.modifiers);
      last = begin;
    }
    return data;
  }

  std::map<std::string, Sent> sent_; ///< by URI
  unsigned lastId_ = 0;
};

} // namespace

Json tokensLegend() {
  Json types = Json::array(), modifiers = Json::array();
  for (const llvm::StringRef name : tokenTypeNames())
    types.push_back(name.str());
  for (const llvm::StringRef name : tokenModifierNames())
    modifiers.push_back(name.str());
  return {{"tokenTypes", std::move(types)}, {"tokenModifiers", std::move(modifiers)}};
}

void bindWriting(Context &context) {
  context.onDocument("textDocument/completion", completed);
  resolveCompletion(context);
  context.onDocument("textDocument/signatureHelp", signature);
  context.onDocument("textDocument/inlayHint", hinted);
  onResolve(context, "inlayHint/resolve", explainHint);
  context.onDocument("textDocument/linkedEditingRange", linkedTo);
  context.onDocument("textDocument/codeLens",
                     [](View &view, const Json &) { return lenses(view); });
  onResolve(context, "codeLens/resolve", withTitle);
  auto tokens = std::make_shared<Tokens>(); // of the thread of features
  context.onDocument("textDocument/semanticTokens/full",
                     [tokens](View &view, const Json &) { return tokens->full(view); });
  context.onDocument(
      "textDocument/semanticTokens/full/delta",
      [tokens](View &view, const Json &params) { return tokens->delta(view, params); });
  context.onDocument("textDocument/semanticTokens/range", [tokens](View &view, const Json &params) {
    return tokens->range(view, params);
  });
}

} // namespace ncvet::lsp
