// Collects findings while programs run: one per rule and place, with the shortest path to it.
#include "analyzer/rule/collector.h"

#include "analyzer/rule/rule_table.h"
#include "formats/finding/finding_order.h"
#include "formats/finding/message_length.h"

#include "llvm/ADT/StringSet.h"

#include <algorithm>

namespace ncvet {

namespace {

void fillPath(Finding &finding, const PathNode *path) {
  const std::vector<PathStep> steps = stepsOf(path);
  finding.path.assign(steps.begin(), steps.end());
}

} // namespace

Collector::Collector(const RuleSelection &selection, const Dialect &dialect,
                     const AnalysisLimits &limits, Visits &visits)
    : selection_(selection), dialect_(dialect), limits_(limits), perRule_(allRules().size()),
      visits_(visits) {}

Collector::Frame &Collector::frameOf(size_t depth) {
  if (depth > frames_.size())
    frames_.resize(depth);
  return frames_[depth - 1];
}

/// Notes a report of the current visit of a stop; certain in one state is enough for that visit.
void Collector::count(size_t depth, const Key &key, bool certain) {
  visits_.noteReport(depth);
  const unsigned visit = visits_.at(depth).visits;
  Frame &frame = frameOf(depth);
  constexpr size_t few = 16;
  AtStop *known = nullptr;
  if (frame.reports.size() <= few) {
    known = llvm::find_if(frame.reports, [&](const AtStop &at) { return at.key == key; });
  } else {
    for (size_t i = frame.places.size(); i < frame.reports.size(); ++i)
      frame.places.emplace(frame.reports[i].key, i);
    const auto place = frame.places.find(key);
    known = place == frame.places.end() ? frame.reports.end() : &frame.reports[place->second];
  }
  if (known == frame.reports.end())
    return frame.reports.push_back({key, certain ? 1u : 0u, visit});
  if (known->lastVisit != visit) {
    known->lastVisit = visit;
    known->certain += certain;
  }
}

/// The finding that was given last has been filled in.
void Collector::finishLast() {
  if (Finding *const last = std::exchange(last_, nullptr))
    shortenQuotes(*last);
}

Finding *Collector::report(RuleId rule, SourceRange range, bool certain) {
  ++reports_;
  finishLast();
  if (definiteOnly_ && !certain)
    return nullptr;
  const Key key{rule, range.file, range.begin, range.end};
  count(visits_.depth(), key, certain);
  const PathNode *path = visits_.at(visits_.depth()).path;
  const unsigned length = path ? path->length : 0;
  const auto found = entries_.find(key);
  if (found != entries_.end()) {
    found->second.uncalled &= uncalled_;
    // Known: a shorter way to it is the better explanation.
    if (length < found->second.pathLength) {
      found->second.pathLength = length;
      fillPath(found->second.finding, path);
    }
    return nullptr;
  }
  if (perRule_[rule]++ >= limits_.findingsPerRule)
    return nullptr;
  Entry &entry = entries_[key];
  entry.pathLength = length;
  entry.uncalled = uncalled_;
  Finding &finding = entry.finding;
  finding.rule = rule;
  finding.range = range;
  finding.certainty = Certainty::Possible;
  finding.severity = allRules()[rule].info.severity;
  const auto table = dialect_.rules.find(allRules()[rule].info.id);
  if (table != dialect_.rules.end() && table->second.severity)
    finding.severity = *table->second.severity;
  fillPath(finding, path);
  return last_ = &finding;
}

void Collector::settle() {
  const size_t depth = visits_.depth();
  const unsigned visits = visits_.at(depth).visits;
  const Frame settled = std::move(frameOf(depth));
  frameOf(depth) = Frame();
  for (const AtStop &at : settled.reports) {
    const bool certain = at.certain >= visits;
    if (depth > 1) {
      count(depth - 1, at.key, certain);
    } else if (certain) {
      const auto found = entries_.find(at.key);
      if (found != entries_.end())
        found->second.finding.certainty = Certainty::Definite;
    }
  }
}

namespace {

/// Whether the words of a finding are ones that the control cannot read, or a value that it does
/// not take, as the page of its rule says by `*`: whatever else is said of them follows from that.
bool refusesItsWords(const Finding &finding, const RuleInfo &rule) {
  return finding.severity == Severity::Error && llvm::is_contained(rule.subsumes, "*");
}

/// Whether `finding` only says what follows from `cause`, of another rule and in the same block.
bool isConsequence(const Finding &finding, const Finding &cause) {
  const RuleInfo &rule = allRules()[finding.rule].info, &ofCause = allRules()[cause.rule].info;
  if (llvm::is_contained(ofCause.subsumes, rule.id))
    return true;
  if (llvm::is_contained(rule.subsumes, ofCause.id)) // it says the same, and more exactly
    return false;
  // What is said of a whole program is not about the words where it is reported.
  const bool within =
      finding.range.begin >= cause.range.begin && finding.range.end <= cause.range.end;
  const bool same =
      within && finding.range.begin == cause.range.begin && finding.range.end == cause.range.end;
  return within && rule.category != "program" && refusesItsWords(cause, ofCause) &&
         !(same && refusesItsWords(finding, rule));
}

} // namespace

/// Whether the control, looking for the end of a body that it does not run, stops at what the rule
/// reports.
bool Collector::stopsUncalled(RuleId rule) const {
  const auto table = dialect_.rules.find(allRules()[rule].info.id);
  return table != dialect_.rules.end() && table->second.uncalledStops;
}

std::vector<Finding> Collector::take(const SourceSet &sources) {
  finishLast();
  std::vector<Finding> all;
  all.reserve(entries_.size());
  for (auto &[key, entry] : entries_) {
    Finding &finding = entry.finding;
    if (entry.uncalled && !dialect_.loadsWhole && finding.severity == Severity::Error &&
        !stopsUncalled(finding.rule))
      finding.severity = Severity::Warning;
    if (selection_.severity.size() > finding.rule && selection_.severity[finding.rule])
      finding.severity = *selection_.severity[finding.rule];
    else
      finding.severity = std::min(finding.severity, selection_.highest);
    all.push_back(std::move(finding));
  }
  entries_.clear();
  const auto itself = [](auto number) { return number; };
  llvm::sort(all, [&](const Finding &a, const Finding &b) {
    return placeInOrder(a, itself, itself) < placeInOrder(b, itself, itself);
  });
  // Of two rules that would say the same thing of one block, the one that names the cause speaks.
  std::vector<Finding> kept;
  kept.reserve(all.size());
  const auto lineOf = [&](const Finding &f) {
    return sources.get(f.range.file).lines().lineBegin(f.range.begin);
  };
  for (size_t begin = 0; begin < all.size();) {
    size_t end = begin + 1;
    const uint32_t line = lineOf(all[begin]);
    while (end < all.size() && all[end].range.file == all[begin].range.file &&
           lineOf(all[end]) == line)
      ++end;
    for (size_t i = begin; i < end; ++i) {
      bool consequence = false;
      for (size_t j = begin; j < end && !consequence; ++j)
        consequence = all[j].rule != all[i].rule && isConsequence(all[i], all[j]);
      if (!consequence)
        kept.push_back(std::move(all[i]));
    }
    begin = end;
  }
  return kept;
}

} // namespace ncvet
