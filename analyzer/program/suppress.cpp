// Suppression: finding the comments, what each covers, and marking findings.
#include "analyzer/program/suppress.h"

#include "analyzer/program/block_reading.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"

#include <cstring>

namespace ncvet {

namespace {

constexpr llvm::StringLiteral mark = "ncvet:";

class SuppressionReader {
public:
  SuppressionReader(const SourceFile &source, const Reader &reader, RulesOfName rulesOf)
      : source_(source), reader_(reader), rulesOf_(rulesOf), text_(source.text()) {}

  std::vector<Suppression> read(EachColon eachColon) {
    eachColon([this](uint32_t colon) {
      const size_t begin = colon + 1 - std::min<size_t>(colon + 1, mark.size());
      if (text_.slice(begin, colon + 1).equals_insensitive(mark))
        readComment(uint32_t(begin));
    });
    return std::move(found_);
  }

private:
  SourceRange range(llvm::StringRef part) const {
    const auto begin = uint32_t(part.data() - text_.data());
    return {source_.id(), begin, begin + uint32_t(part.size())};
  }

  /// `offset`: where `ncvet:` is, perhaps outside of any comment.
  void readComment(uint32_t offset) {
    readBlockAt(source_, reader_, offset, block_);
    const Comment *const comment = llvm::find_if(
        block_.comments, [&](const Comment &c) { return c.begin < offset && offset < c.end; });
    if (comment == block_.comments.end())
      return;
    llvm::StringRef text = text_.slice(offset + mark.size(), comment->end);
    text = text.take_until([](char c) { return c == ')' || c == '\r' || c == '\n'; });
    text = text.take_front(text.find("--")).trim();
    Suppression suppression;
    suppression.verbRange = {source_.id(), offset, offset + uint32_t(mark.size())};
    readVerb(text, suppression);
    readNames(text, suppression);
    const bool whole =
        suppression.verb == SuppressionVerb::Off || suppression.verb == SuppressionVerb::On;
    if (whole && suppression.names.empty()) {
      SuppressedName &all = suppression.names.emplace_back();
      all.range = suppression.verbRange;
      all.rules = rulesOf_("all");
    }
    cover(suppression);
    found_.push_back(std::move(suppression));
  }

  void readVerb(llvm::StringRef &text, Suppression &suppression) const {
    const llvm::StringRef verb =
        text.take_while([](char c) { return llvm::isAlnum(c) || c == '-'; });
    if (verb.empty())
      return;
    suppression.verbRange = range(verb);
    suppression.verb = llvm::StringSwitch<SuppressionVerb>(verb.lower())
                           .Case("allow", SuppressionVerb::Allow)
                           .Case("allow-file", SuppressionVerb::AllowFile)
                           .Case("off", SuppressionVerb::Off)
                           .Case("on", SuppressionVerb::On)
                           .Default(SuppressionVerb::Unknown);
    text = text.drop_front(verb.size());
  }

  void readNames(llvm::StringRef text, Suppression &suppression) const {
    constexpr llvm::StringLiteral separators = ", \t";
    while (!(text = text.ltrim(separators)).empty()) {
      const llvm::StringRef name = text.take_front(text.find_first_of(separators));
      text = text.drop_front(name.size());
      SuppressedName &entry = suppression.names.emplace_back();
      entry.range = range(name);
      entry.rules = rulesOf_(name.lower());
    }
  }

  void cover(Suppression &suppression) {
    const auto end = uint32_t(text_.size());
    for (SuppressedName &name : suppression.names) {
      name.begin = block_.begin;
      name.ends.assign(name.rules.size(), end);
    }
    switch (suppression.verb) {
    case SuppressionVerb::Allow: {
      // A comment that is alone speaks of the next block.
      const bool found = skipEmptyBlocks();
      for (SuppressedName &name : suppression.names) {
        name.ends.assign(name.rules.size(), std::max(block_.next, name.begin + 1));
        name.dead = !found;
      }
      break;
    }
    case SuppressionVerb::AllowFile:
      for (SuppressedName &name : suppression.names)
        name.begin = 0;
      break;
    case SuppressionVerb::Off:
      for (SuppressedName &name : suppression.names)
        name.dead = !name.rules.empty() && isOff(name.rules);
      break;
    case SuppressionVerb::On:
      for (SuppressedName &name : suppression.names) {
        name.ends.assign(name.rules.size(), name.begin); // itself covers nothing
        name.dead = !name.rules.empty() && !switchOn(name.rules);
      }
      break;
    case SuppressionVerb::Unknown:
      suppression.names.clear();
      break;
    }
  }

  /// Goes on to the first block from the present one on that holds anything; false at the end.
  bool skipEmptyBlocks() {
    while (block_.kind == BlockKind::Empty && block_.isEmpty() && block_.number < 0) {
      const uint32_t next = block_.next;
      if (next >= text_.size() || next <= block_.begin)
        return false;
      reader_.read(next, block_);
    }
    return true;
  }

  /// True when all of these rules are off already.
  bool isOff(llvm::ArrayRef<RuleId> rules) const {
    return llvm::all_of(rules, [&](RuleId rule) {
      return llvm::any_of(found_, [&](const Suppression &earlier) {
        return earlier.verb == SuppressionVerb::Off &&
               llvm::any_of(earlier.names, [&](const SuppressedName &name) {
                 const auto at = llvm::find(name.rules, rule);
                 return at != name.rules.end() &&
                        name.ends[size_t(at - name.rules.begin())] == text_.size();
               });
      });
    });
  }

  /// Ends every `off` of these rules at the present block; false when there is none.
  bool switchOn(llvm::ArrayRef<RuleId> rules) {
    bool any = false;
    for (Suppression &earlier : found_)
      if (earlier.verb == SuppressionVerb::Off)
        for (SuppressedName &name : earlier.names)
          for (size_t i = 0; i < name.rules.size(); ++i)
            if (name.ends[i] == text_.size() && llvm::is_contained(rules, name.rules[i])) {
              name.ends[i] = block_.begin;
              any = true;
            }
    return any;
  }

  const SourceFile &source_;
  const Reader &reader_;
  const RulesOfName rulesOf_;
  llvm::StringRef text_;
  Block block_;
  std::vector<Suppression> found_;
};

} // namespace

std::vector<Suppression> findSuppressions(const SourceFile &source, const Reader &reader,
                                          EachColon eachColon, RulesOfName rulesOf) {
  return SuppressionReader(source, reader, rulesOf).read(eachColon);
}

void applySuppressions(std::vector<Suppression> &suppressions, const SourceFile &source,
                       llvm::MutableArrayRef<Finding> findings) {
  if (suppressions.empty())
    return;
  for (Finding &finding : findings) {
    if (finding.range.file != source.id())
      continue;
    for (Suppression &suppression : suppressions)
      for (SuppressedName &name : suppression.names)
        for (size_t i = 0; i < name.rules.size(); ++i)
          if (name.rules[i] == finding.rule && name.begin <= finding.range.begin &&
              finding.range.begin < name.ends[i]) {
            finding.suppressed = true;
            name.used = true;
          }
  }
}

} // namespace ncvet
