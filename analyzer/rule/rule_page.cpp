// A rule's page: the fenced JSON block at its head, and what follows.
#include "analyzer/rule/rule_page.h"

#include "analyzer/rule/rule_table.h"

#include "llvm/ADT/STLExtras.h"
#include <nlohmann/json.hpp>

#include <map>
#include <mutex>

namespace ncvet {

namespace {

using PageJson = nlohmann::ordered_json;

std::optional<double> numberOf(const PageJson &object, const char *key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number())
    return std::nullopt;
  return found->get<double>();
}

/// A heading, a paragraph or a fenced program of a page, with the empty lines after it.
struct PagePiece {
  enum Kind : uint8_t { Heading, Paragraph, Program };
  Kind kind = Paragraph;
  bool kept = true;
  llvm::StringRef text;
};

std::vector<PagePiece> piecesOf(llvm::StringRef body) {
  std::vector<PagePiece> pieces;
  bool fenced = false, ended = true; // inside a fence; an empty line has ended the piece
  while (!body.empty()) {
    const size_t end = body.find('\n');
    const llvm::StringRef line = body.take_front(end == llvm::StringRef::npos ? end : end + 1);
    body = body.drop_front(line.size());
    const bool empty = line.trim().empty(), program = !fenced && line.startswith("```nc ");
    if (program || (ended && !empty)) {
      PagePiece &piece = pieces.emplace_back();
      piece.kind = program                ? PagePiece::Program
                   : line.startswith("#") ? PagePiece::Heading
                                          : PagePiece::Paragraph;
      piece.text = line.take_front(0);
    }
    if (pieces.empty())
      pieces.emplace_back().text = line.take_front(0); // empty lines at the head
    if (line.startswith("```"))
      fenced = !fenced;
    ended = !fenced && (empty || line.startswith("```"));
    llvm::StringRef &text = pieces.back().text;
    text = llvm::StringRef(text.data(), text.size() + line.size());
  }
  return pieces;
}

RuleOption readOption(const std::string &name, const PageJson &value) {
  RuleOption option;
  option.name = name;
  option.type = value.value("type", "number") == "bool"     ? RuleOption::Type::Flag
                : value.value("type", "number") == "choice" ? RuleOption::Type::Choice
                                                            : RuleOption::Type::Number;
  option.help = value.value("help", "");
  option.min = numberOf(value, "min");
  option.max = numberOf(value, "max");
  option.names = value.value("names", option.names);
  if (option.type == RuleOption::Type::Flag)
    option.fallback = value.value("default", false);
  else if (option.type == RuleOption::Type::Number)
    option.fallback = numberOf(value, "default").value_or(0);
  else
    option.fallback =
        double(llvm::find(option.names, value.value("default", "")) - option.names.begin());
  return option;
}

} // namespace

RulePage readRulePage(const RuleInfo &info) {
  RulePage page;
  page.body = info.help;
  llvm::StringRef head;
  if (page.body.consume_front("```json\n")) {
    std::tie(head, page.body) = page.body.split("\n```\n");
    page.body = page.body.ltrim("\n");
  }
  const PageJson json = PageJson::parse(head.begin(), head.end(), nullptr, false);
  if (!json.is_object())
    return page;
  if (const auto dialects = json.find("dialects"); dialects != json.end() && dialects->is_array())
    for (const PageJson &id : *dialects)
      if (id.is_string())
        page.dialects.push_back(id.get<std::string>());
  if (const auto repeated = json.find("repeated"); repeated != json.end())
    page.repeated = *repeated == "alike"  ? RepeatedFindings::Alike
                    : *repeated == "many" ? RepeatedFindings::Many
                                          : RepeatedFindings::Same;
  if (const auto due = json.find("dueWhere"); due != json.end() && due->is_array())
    for (const PageJson &trait : *due)
      page.dueWhere |= trait == "spindle" ? programsSpindle : programsThreeAxes;
  if (const auto options = json.find("options"); options != json.end() && options->is_object())
    for (const auto &[name, value] : options->items())
      if (value.is_object())
        page.options.push_back(readOption(name, value));
  return page;
}

const RulePage &rulePage(RuleId rule) {
  static std::mutex mutex;
  static std::map<RuleId, RulePage> pages;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto [known, isNew] = pages.try_emplace(rule);
  if (isNew)
    known->second = readRulePage(allRules()[rule].info);
  return known->second;
}

std::string withProgramsOf(llvm::StringRef dialect, llvm::StringRef body) {
  const std::string fence = ("```nc " + dialect + " ").str();
  if (!body.contains(fence))
    return body.str();
  std::vector<PagePiece> pieces = piecesOf(body);
  // From the end: a paragraph introduces the programs after it, and goes when all of them do.
  bool introduces = false, allDropped = true;
  for (PagePiece &piece : llvm::reverse(pieces)) {
    if (piece.kind == PagePiece::Program) {
      piece.kept = piece.text.startswith(fence);
      allDropped = (!introduces || allDropped) && !piece.kept;
      introduces = true;
      continue;
    }
    if (piece.kind == PagePiece::Paragraph && introduces)
      piece.kept = !allDropped;
    introduces = false;
  }
  std::string kept;
  for (const PagePiece &piece : pieces)
    if (piece.kept)
      kept += piece.text;
  return kept;
}

} // namespace ncvet
