// Collects findings while programs run: one per rule and place, with the shortest path to it.
#pragma once

#include "analyzer/rule/analysis_limits.h"
#include "analyzer/rule/selection.h"
#include "analyzer/rule/visits.h"
#include "formats/finding/finding.h"
#include "formats/text/source_set.h"

#include <unordered_map>

namespace ncvet {

/// Findings of one analysis. What every visit of a stop (see `Visits`) breaks for certain is
/// definite, the rest possible. What a called program is found to break for certain counts as a
/// report of the visit that called it.
class Collector {
public:
  Collector(const RuleSelection &selection, const Dialect &dialect, const AnalysisLimits &limits,
            Visits &visits);

  /// Whether the user selected the rule, beyond what is on by default.
  bool isAsked(RuleId rule) const {
    return rule < selection_.asked.size() && selection_.asked[rule];
  }

  /// All visits of the current stop have been made.
  void settle();
  /// While set, only what is certain counts: the entry state is not known.
  void setDefiniteOnly(bool on) { definiteOnly_ = on; }
  /// While set, nothing calls what is looked at: of a control that reads its text as it runs, an
  /// error there stops nothing, and is a warning.
  void setUncalled(bool on) { uncalled_ = on; }

  /// How often a rule had something to say, wanted or not.
  uint64_t reports() const { return reports_; }
  /// A finding to fill in; null when it is not wanted (known already, or over the rule's number).
  Finding *report(RuleId rule, SourceRange range, bool certain);

  /// All findings: severities set, causes' consequences dropped, sorted.
  std::vector<Finding> take(const SourceSet &sources);

private:
  struct Key {
    uint32_t rule, file, begin, end;
    friend bool operator==(const Key &a, const Key &b) {
      return a.rule == b.rule && a.file == b.file && a.begin == b.begin && a.end == b.end;
    }
  };
  struct KeyHash {
    size_t operator()(const Key &k) const {
      return size_t((uint64_t(k.begin) << 20 ^ uint64_t(k.end) << 40) * 0x9E3779B97F4A7C15u ^
                    (uint64_t(k.rule) << 8 ^ k.file));
    }
  };
  struct Entry {
    Finding finding;
    unsigned pathLength = 0;
    bool uncalled = false; ///< found only where nothing calls it
  };
  struct AtStop {
    Key key;
    unsigned certain = 0;   ///< visits in which it was certain
    unsigned lastVisit = 0; ///< the last visit that reported it
  };

  /// What was reported at one stop.
  struct Frame {
    llvm::SmallVector<AtStop, 4> reports;
    std::unordered_map<Key, size_t, KeyHash> places; ///< of reports, when there are many of them
  };
  bool stopsUncalled(RuleId rule) const;
  Frame &frameOf(size_t depth);
  void finishLast();
  void count(size_t depth, const Key &key, bool certain);

  const RuleSelection &selection_;
  const Dialect &dialect_;
  const AnalysisLimits &limits_;
  std::unordered_map<Key, Entry, KeyHash> entries_;
  std::vector<unsigned> perRule_;
  Visits &visits_;
  std::vector<Frame> frames_; ///< by the depth of their stop
  uint64_t reports_ = 0;
  Finding *last_ = nullptr; ///< that a rule is filling in
  bool definiteOnly_ = false;
  bool uncalled_ = false;
};

} // namespace ncvet
