// Code actions: fixes of findings, of a rule and of a file; suppressions; the page of a rule.
#include "analyzer/check/fix.h"
#include "analyzer/rule/rule_table.h"
#include "formats/text/file_uri.h"
#include "lsp/features/writing/suppression_edit.h"
#include "lsp/server/bindings.h"
#include "lsp/server/fix_verdicts.h"
#include "lsp/server/rewriting_actions.h"
#include "lsp/server/workspace_edit.h"
#include "lsp/transport/json_message.h"

namespace ncvet::lsp {

namespace {

bool wants(const Json &context, llvm::StringRef kind) {
  const auto only = context.find("only");
  if (only == context.end() || !only->is_array())
    return true;
  // A kind asks for all kinds below it as well.
  return llvm::any_of(*only, [&](const Json &wanted) {
    if (!wanted.is_string())
      return false;
    const llvm::StringRef name = wanted.get_ref<const std::string &>();
    return name.empty() || kind == name || (kind.startswith(name) && kind[name.size()] == '.');
  });
}

Json action(std::string title, llvm::StringRef kind, Json changes) {
  return {{"title", std::move(title)},
          {"kind", kind.str()},
          {"edit", {{"changes", std::move(changes)}}}};
}

/// Adds the edits of one fix to those of others; false when they touch the same text.
class Gathered {
public:
  bool add(const Json &changes) {
    for (const auto &[uri, edits] : changes.items())
      for (const Json &edit : edits)
        if (touches(uri, edit))
          return false;
    for (const auto &[uri, edits] : changes.items())
      for (const Json &edit : edits) {
        taken_[uri].emplace(place(edit, "start"), place(edit, "end"));
        changes_[uri].push_back(edit);
      }
    ++count_;
    return true;
  }
  unsigned count() const { return count_; }
  Json take() { return std::move(changes_); }

private:
  using Place = std::pair<uint32_t, uint32_t>;
  static Place place(const Json &edit, const char *end) {
    const Json &position = edit["range"][end];
    return {position["line"], position["character"]};
  }
  /// Those that are there lie apart: of all that begin before the new one ends, the last ends last.
  bool touches(const std::string &uri, const Json &edit) {
    const auto &taken = taken_[uri];
    const auto next = taken.upper_bound(place(edit, "end"));
    return next != taken.begin() && std::prev(next)->second >= place(edit, "start");
  }

  std::map<std::string, std::map<Place, Place>> taken_; ///< by file: begins and ends of edits
  Json changes_ = Json::object();
  unsigned count_ = 0;
};

/// Whether fixes are tried when one is chosen: the text is long, and the client asks then for what
/// an action changes.
bool triesLater(const View &view) {
  return view.client.resolvesEdits && FixVerdicts::isLong(view.snapshot.text());
}

Json editOf(const Problem &problem, const View &view) {
  Json edit = {{"changes", Json::parse(problem.changes)}};
  if (!problem.safe && view.client.annotatesChanges)
    annotate(edit, view.document, [&](const std::string &) -> EditNote {
      return {"unsafe", "Not safe: the program may move otherwise afterwards", problem.fixTitle,
              true};
    });
  return edit;
}

/// An action whose edit is left open.
Json openAction(std::string title, const Problem &problem, const View &view, bool all) {
  return {{"title", std::move(title)},
          {"kind", "quickfix"},
          {"data",
           {{"uri", view.document.uri},
            {"version", view.document.version},
            {"rule", allRules()[problem.rule].info.id.str()},
            {"begin", problem.begin},
            {"end", problem.end},
            {"all", all}}}};
}

std::string titleOfAll(const Problem &problem, size_t count) {
  return ("Fix all " + llvm::Twine(count) + " findings of " + allRules()[problem.rule].info.id)
      .str();
}

/// The safe fixes of the rule of a finding, as far as they may be offered.
Gathered fixesOfItsRule(const Problem &problem, const CheckResult &result,
                        const FixVerdicts &verdicts) {
  Gathered all;
  for (const Problem &other : result.problems)
    if (other.rule == problem.rule && other.safe && verdicts.holds(other))
      all.add(Json::parse(other.changes));
  return all;
}

void fixesOfFinding(const Problem &problem, const CheckResult &result, const View &view,
                    const FixVerdicts &verdicts, Json &actions) {
  if (problem.fixTitle.empty() || !verdicts.holds(problem))
    return;
  const bool isOpen = triesLater(view) && !verdicts.knows(problem);
  Json fix = isOpen ? openAction(problem.fixTitle, problem, view, false)
                    : Json{{"title", problem.fixTitle},
                           {"kind", "quickfix"},
                           {"edit", editOf(problem, view)}};
  fix["diagnostics"] =
      Json::array({parseMessage(problem.diagnostic)}); // `{one}` is no list to Clang
  fix["isPreferred"] = problem.safe;
  actions.push_back(std::move(fix));
  if (!problem.safe)
    return;
  if (isOpen) {
    const auto count = size_t(llvm::count_if(result.problems, [&](const Problem &other) {
      return other.rule == problem.rule && other.safe;
    }));
    if (count > 1)
      actions.push_back(openAction(titleOfAll(problem, count), problem, view, true));
  } else if (Gathered all = fixesOfItsRule(problem, result, verdicts); all.count() > 1) {
    actions.push_back(action(titleOfAll(problem, all.count()), "quickfix", all.take()));
  }
}

void suppressions(const Problem &problem, View &view, Json &actions) {
  const llvm::StringRef rule = allRules()[problem.rule].info.id;
  const auto offer = [&](const llvm::Twine &title, const std::optional<TextEdit> &edit) {
    if (!edit)
      return;
    Json silence =
        action(title.str(), "quickfix", {{view.document.uri, editsJson(view.positions, *edit)}});
    silence["diagnostics"] = Json::array({parseMessage(problem.diagnostic)});
    actions.push_back(std::move(silence));
  };
  offer("Allow " + rule + " here", allowHere(view.snapshot, problem.begin, rule));
  offer("Allow " + rule + " in this file", allowInFile(view.snapshot, rule));
}

std::string titleOf(size_t safeFixes) {
  return safeFixes == 1 ? "Apply the one safe fix"
                        : ("Apply all " + llvm::Twine(safeFixes) + " safe fixes").str();
}

/// All safe fixes of the file, as far as none makes room for a new finding.
void fixAll(View &view, Session &session, Json &actions) {
  const FixedText fixed =
      fixText(session, view.snapshot.source(), /*unsafe=*/false, view.job.overlay);
  if (fixed.applied == 0)
    return;
  // One edit from the first byte that differs to the last.
  const llvm::StringRef before = view.snapshot.text(), after = fixed.text;
  size_t front = 0;
  while (front < before.size() && front < after.size() && before[front] == after[front])
    ++front;
  front = view.snapshot.source().lines().lineBegin(uint32_t(front));
  size_t back = 0;
  while (back < before.size() - front && back < after.size() - front &&
         before[before.size() - 1 - back] == after[after.size() - 1 - back])
    ++back;
  // Never between the bytes of one character.
  while (back > 0 && (uint8_t(before[before.size() - back]) & 0xC0) == 0x80)
    --back;
  const TextEdit edit{
      {view.snapshot.source().id(), uint32_t(front), uint32_t(before.size() - back)},
      after.slice(front, after.size() - back).str()};
  actions.push_back(action(titleOf(fixed.applied), "source.fixAll.ncvet",
                           {{view.document.uri, editsJson(view.positions, edit)}}));
}

/// The action that applies all safe fixes, its edit left open: this is asked for at each move of
/// the cursor, and costs as much as a check.
Json fixAllLater(const View &view, const CheckResult &result) {
  unsigned safe = 0, unsafe = 0;
  for (const Problem &problem : result.problems)
    if (problem.path == view.document.path && !problem.fixTitle.empty())
      ++(problem.safe ? safe : unsafe);
  if (safe == 0)
    return nullptr;
  std::string title = titleOf(safe);
  if (unsafe != 0)
    title +=
        (" (" + llvm::Twine(unsafe) + (unsafe == 1 ? " more needs" : " more need") + " a look)")
            .str();
  return {{"title", std::move(title)},
          {"kind", "source.fixAll.ncvet"},
          {"data", {{"uri", view.document.uri}, {"version", view.document.version}}}};
}

Json explanation(const RuleInfo &rule, const View &view) {
  return {{"title", ("Explain " + rule.id).str()},
          {"kind", "source.explain.ncvet"},
          {"command",
           {{"title", "Explain"},
            {"command", "ncvet.explain"},
            {"arguments", {rule.id.str(), view.document.uri}}}}};
}

/// The problems in `range`, and those whose fixes are offered with theirs.
std::vector<const Problem *> withAllOfTheirRules(llvm::ArrayRef<const Problem *> problems,
                                                 const CheckResult &result) {
  std::set<RuleId> rules;
  for (const Problem *problem : problems)
    if (problem->safe)
      rules.insert(problem->rule);
  std::vector<const Problem *> all = problems.vec();
  for (const Problem &problem : result.problems)
    if (problem.safe && rules.count(problem.rule) && !llvm::is_contained(problems, &problem))
      all.push_back(&problem);
  return all;
}

/// The problems of a check in a range of the document.
std::vector<const Problem *> problemsIn(const CheckResult &result, const std::string &path,
                                        std::pair<uint32_t, uint32_t> range) {
  std::vector<const Problem *> problems;
  for (const Problem &problem : result.problems)
    if (problem.path == path && problem.begin <= range.second && problem.end >= range.first)
      problems.push_back(&problem);
  return problems;
}

/// What mends a finding comes before what silences one. Of what the check of a caller has found
/// here no fix is offered: the fixes of a file are those of its own check.
void actionsOfFindings(View &view, llvm::ArrayRef<std::shared_ptr<const CheckResult>> results,
                       const FixVerdicts &verdicts, const Json &asked,
                       std::pair<uint32_t, uint32_t> range, Json &actions) {
  const std::shared_ptr<const CheckResult> &own = results.front();
  std::vector<const Problem *> problems = problemsIn(*own, view.document.path, range);
  const bool mends = wants(asked, "quickfix");
  if (mends)
    for (const Problem *problem : problems)
      fixesOfFinding(*problem, *own, view, verdicts, actions);
  for (const auto &result : results.drop_front())
    for (const Problem *problem : problemsIn(*result, view.document.path, range))
      if (llvm::none_of(problems, [&](const Problem *known) {
            return known->rule == problem->rule && known->begin == problem->begin;
          }))
        problems.push_back(problem);
  if (mends)
    for (const Problem *problem : problems)
      suppressions(*problem, view, actions);
  if (wants(asked, "source.explain.ncvet"))
    for (const Problem *problem : problems)
      actions.push_back(explanation(allRules()[problem->rule].info, view));
}

/// Finds out which fixes in the range may be offered, or gives what is to be done for that.
Worker::Task tryFixes(Context &context, View &view, FixVerdicts &verdicts, const Json &params) {
  const auto result = context.checks->wait(view.document, view.cancelled);
  if (!result || triesLater(view) || !wants(params.at("context"), "quickfix"))
    return nullptr;
  const auto problems = problemsIn(*result, view.document.path, view.range(params));
  return verdicts.decide(view, result, withAllOfTheirRules(problems, *result));
}

Json actionsAt(Context &context, View &view, Session &session, const FixVerdicts &verdicts,
               const Json &params) {
  Json actions = Json::array();
  const auto result = context.checks->wait(view.document, view.cancelled);
  if (!result)
    return actions;
  const auto [begin, end] = view.range(params);
  const Json &asked = params.at("context");
  std::vector<std::shared_ptr<const CheckResult>> results{result};
  llvm::append_range(results, context.problems.othersThatTellOf(view.document.path));
  actionsOfFindings(view, results, verdicts, asked, {begin, end}, actions);
  if (begin < end)
    rewritingsOf(
        view, begin, end, [&](llvm::StringRef kind) { return wants(asked, kind); },
        [&](std::string title, llvm::StringRef kind, Json edit) {
          actions.push_back(
              {{"title", std::move(title)}, {"kind", kind.str()}, {"edit", std::move(edit)}});
        });
  if (wants(asked, "source.fixAll.ncvet")) {
    if (!view.client.resolvesEdits)
      fixAll(view, session, actions);
    else if (Json later = fixAllLater(view, *result); !later.is_null())
      actions.push_back(std::move(later));
  }
  return actions;
}

/// The finding whose fix an action makes; null: it is not there.
const Problem *problemOf(const CheckResult *result, const Json &data) {
  if (!result)
    return nullptr;
  const auto found = llvm::find_if(result->problems, [&](const Problem &problem) {
    return problem.path == result->document.path && problem.begin == data.at("begin") &&
           problem.end == data.at("end") &&
           allRules()[problem.rule].info.id == data.at("rule").get<std::string>();
  });
  return found == result->problems.end() ? nullptr : &*found;
}

/// Tries the fix that was chosen, and gives what it changes.
void resolveFix(Context &context, const std::shared_ptr<FixVerdicts> &verdicts,
                const Document &document, const Json &action, Reply reply) {
  const bool all = action.at("data").at("all");
  const auto attempt = [&context, verdicts, action, all](View &view) -> Worker::Task {
    const auto result = context.checks->wait(view.document, view.cancelled);
    const Problem *const problem = problemOf(result.get(), action.at("data"));
    if (!problem)
      return nullptr;
    return verdicts->decide(view, result,
                            all ? withAllOfTheirRules(problem, *result)
                                : std::vector<const Problem *>{problem});
  };
  const auto answer = [&context, verdicts, action, all](View &view) -> llvm::Expected<Json> {
    const auto result = context.checks->wait(view.document, view.cancelled);
    const Problem *const problem = problemOf(result.get(), action.at("data"));
    if (!problem || (!all && !verdicts->holds(*problem)))
      return failure("the fix was tried, and does not mend the finding here");
    Json whole = action;
    whole["edit"] = all ? Json{{"changes", fixesOfItsRule(*problem, *result, *verdicts).take()}}
                        : editOf(*problem, view);
    return whole;
  };
  context.answerAfterCheck(document, std::move(reply), answer, attempt);
}

/// Gives an action the edit that was left open.
void resolve(Context &context, const std::shared_ptr<FixVerdicts> &verdicts, const Json &action,
             Reply reply) {
  const Json &data = action.at("data");
  const std::string uri = data.at("uri");
  const Document *document = context.documents.find(uri);
  if (!document || document->version != data.at("version"))
    return reply.fail(RpcError::ContentModified, "the document has changed");
  if (data.contains("rule"))
    return resolveFix(context, verdicts, *document, action, std::move(reply));
  context.answerFor(*document, std::move(reply),
                    [action, session = context.session(*document)](View &view) {
                      Json made = Json::array(), whole = action;
                      fixAll(view, *session, made);
                      whole["edit"] = made.empty() ? Json::object() : made.front()["edit"];
                      return whole;
                    });
}

/// The control of the program that the second argument names, as it was last checked.
std::string controlOf(const Context &context, const Json &arguments) {
  const Document *document =
      arguments.size() > 1 ? context.documents.find(arguments.at(1).get<std::string>()) : nullptr;
  const auto result = document ? context.checks->last(document->path) : nullptr;
  return result ? result->dialect : "";
}

/// Shows the page of a rule; where files cannot be opened, its summary.
void explain(Context &context, const Json &arguments, Reply reply) {
  const std::string id = arguments.at(0);
  for (const RuleEntry &entry : allRules()) {
    if (entry.info.id != id)
      continue;
    const std::string page = rulePageUri(entry.info, controlOf(context, arguments));
    context.rpc.request(
        "window/showDocument", {{"uri", page}, {"takeFocus", true}},
        [&context, &entry](const Json &, bool failed) {
          if (failed)
            context.rpc.notify(
                "window/showMessage",
                {{"type", 3}, {"message", entry.info.id.str() + ": " + entry.info.summary.str()}});
        });
    return reply(nullptr);
  }
  reply.fail(RpcError::InvalidParams, "there is no rule " + id);
}

} // namespace

void bindActions(Context &context) {
  const auto verdicts = std::make_shared<FixVerdicts>();
  context.rpc.onRequest(
      "textDocument/codeAction", [&context, verdicts](const Json &params, Reply reply) {
        const std::string uri = params.at("textDocument").at("uri");
        const Document *document = context.documents.find(uri);
        if (!document)
          return reply.fail(RpcError::InvalidParams, "the document is not open: " + uri);
        context.answerAfterCheck(
            *document, std::move(reply),
            [&context, params, verdicts, session = context.session(*document)](View &view) {
              return actionsAt(context, view, *session, *verdicts, params);
            },
            [&context, params, verdicts](View &view) {
              return tryFixes(context, view, *verdicts, params);
            });
      });
  context.rpc.onRequest("codeAction/resolve",
                        [&context, verdicts](const Json &params, Reply reply) {
                          resolve(context, verdicts, params, std::move(reply));
                        });
  context.rpc.onRequest("workspace/executeCommand", [&context](const Json &params, Reply reply) {
    const std::string command = params.at("command");
    if (command == "ncvet.explain")
      return explain(context, params.at("arguments"), std::move(reply));
    if (command == "ncvet.transform")
      return transformRange(context, params.at("arguments"), std::move(reply));
    reply.fail(RpcError::InvalidParams, "there is no command " + command);
  });
}

} // namespace ncvet::lsp
