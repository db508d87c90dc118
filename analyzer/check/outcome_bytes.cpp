// Outcomes as bytes: numbers in LEB128, texts with their lengths, files by their places in a list.
#include "analyzer/check/outcome_bytes.h"

#include "analyzer/rule/rule_table.h"

#include "llvm/Support/LEB128.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet {

void ByteWriter::number(uint64_t value) {
  uint8_t digits[10]; // 64 bits, seven a byte
  bytes_.append(reinterpret_cast<const char *>(digits), llvm::encodeULEB128(value, digits));
}

void ByteWriter::text(llvm::StringRef value) {
  number(value.size());
  bytes_.append(value.data(), value.size());
}

uint64_t ByteReader::number() {
  unsigned length = 0;
  const char *wrong = nullptr;
  const uint64_t value =
      rest_.empty() ? 0
                    : llvm::decodeULEB128(rest_.bytes_begin(), &length, rest_.bytes_end(), &wrong);
  if (rest_.empty() || wrong) {
    fail();
    return 0;
  }
  rest_ = rest_.drop_front(length);
  return value;
}

uint64_t ByteReader::number(uint64_t end) {
  const uint64_t value = number();
  if (value < end)
    return value;
  fail();
  return 0;
}

llvm::StringRef ByteReader::text() {
  const uint64_t size = number();
  if (size > rest_.size()) {
    fail();
    return {};
  }
  const llvm::StringRef value = rest_.take_front(size);
  rest_ = rest_.drop_front(size);
  return value;
}

namespace {

constexpr uint64_t severities = uint64_t(Severity::Error) + 1;

/// As in `check_settings.cpp`, all fields are named.
class OutcomeWriter {
public:
  explicit OutcomeWriter(const SourceFile &file, const SourceSet &sources) : sources_(sources) {
    place(file.id());
  }

  std::string run(const FileOutcome &outcome) {
    const auto &[error, dialect, title, reason, guessed, sure, blocks, complete, cuts, contours,
                 failOn, findings, usedSuppressions, postponed, asksOuter, restsOnOthers, work,
                 followed] = outcome;
    for (const std::string *one : {&dialect, &title, &reason})
      out_.text(*one);
    for (const bool one : {guessed, sure, complete, postponed, asksOuter, restsOnOthers})
      out_.number(one);
    out_.number(blocks);
    out_.number(work);
    for (const std::vector<std::string> *list : {&cuts, &contours}) {
      out_.number(list->size());
      for (const std::string &one : *list)
        out_.text(one);
    }
    write(failOn);
    out_.number(usedSuppressions.size());
    for (const auto &[name, offset] : usedSuppressions) {
      out_.text(name);
      out_.number(offset);
    }
    out_.number(followed.size());
    for (const auto &[path, calls] : followed) {
      out_.text(path);
      out_.number(calls.size());
      for (const auto &[begin, groups] : calls) {
        out_.number(begin);
        out_.number(groups);
      }
    }
    out_.number(findings.size());
    for (const CheckedFinding &finding : findings)
      write(finding);
    return withFiles();
  }

private:
  uint64_t place(FileId file) {
    const auto [at, fresh] = places_.try_emplace(file, files_.size());
    if (fresh)
      files_.push_back(file);
    return at->second;
  }

  /// The first file is the one that was checked, and needs no path.
  std::string withFiles() {
    ByteWriter all;
    all.number(files_.size() - 1);
    for (const FileId file : llvm::makeArrayRef(files_).drop_front())
      all.text(sources_.get(file).path());
    return all.take() + out_.take();
  }

  void write(const FailOn &level) { out_.number(level ? 1 + uint64_t(*level) : 0); }

  void write(const SourceRange &range) {
    const auto &[file, begin, end] = range;
    out_.number(place(file));
    out_.number(begin);
    out_.number(end);
  }

  template <typename T>
  void writePlaces(const T &places) {
    out_.number(places.size());
    for (const auto &[range, message] : places) {
      write(range);
      out_.text(message);
    }
  }

  void write(const CheckedFinding &checked) {
    const auto &[finding, program, blockText, failOn] = checked;
    out_.text(program);
    out_.text(blockText);
    write(failOn);
    const auto &[rule, severity, certainty, range, message, notes, path, fix, fingerprint,
                 suppressed, baselined] = finding;
    out_.number(rule);
    out_.number(uint64_t(severity));
    out_.number(uint64_t(certainty));
    out_.number(suppressed);
    write(range);
    out_.text(message);
    writePlaces(notes);
    writePlaces(path);
    out_.number(fix.has_value());
    if (!fix)
      return;
    const auto &[description, safety, edits] = *fix;
    out_.text(description);
    out_.number(uint64_t(safety));
    writePlaces(edits);
  }

  const SourceSet &sources_;
  std::vector<FileId> files_;
  std::map<FileId, uint64_t> places_;
  ByteWriter out_;
};

class OutcomeReader {
public:
  OutcomeReader(llvm::StringRef bytes, const SourceFile &file,
                llvm::function_ref<const SourceFile *(llvm::StringRef)> open)
      : in_(bytes), open_(open) {
    files_.push_back(&file);
  }

  std::optional<FileOutcome> run() {
    readFiles();
    FileOutcome outcome;
    for (std::string *one : {&outcome.dialect, &outcome.dialectTitle, &outcome.reason})
      *one = in_.text().str();
    for (bool *one : {&outcome.guessed, &outcome.sure, &outcome.complete, &outcome.postponed,
                      &outcome.asksOuter, &outcome.restsOnOthers})
      *one = in_.number(2);
    outcome.blocks = in_.number();
    outcome.work = in_.number();
    for (std::vector<std::string> *list : {&outcome.cuts, &outcome.contours})
      for (uint64_t left = in_.number(); left && !in_.failed(); --left)
        list->push_back(in_.text().str());
    outcome.failOn = readFailOn();
    for (uint64_t left = in_.number(); left && !in_.failed(); --left) {
      std::string name = in_.text().str();
      outcome.usedSuppressions.emplace_back(std::move(name), uint32_t(in_.number()));
    }
    for (uint64_t left = in_.number(); left && !in_.failed(); --left) {
      auto &[path, calls] = outcome.followed.emplace_back();
      path = in_.text().str();
      for (uint64_t more = in_.number(); more && !in_.failed(); --more)
        calls.push_back(readCall());
    }
    for (uint64_t left = in_.number(); left && !in_.failed(); --left)
      outcome.findings.push_back(readFinding());
    if (in_.failed() || !in_.rest().empty())
      return std::nullopt;
    return outcome;
  }

private:
  void readFiles() {
    for (uint64_t left = in_.number(); left && !in_.failed(); --left) {
      const SourceFile *const file = open_(in_.text());
      if (!file)
        return in_.fail();
      files_.push_back(file);
    }
  }

  FollowedCall readCall() {
    const auto block = uint32_t(in_.number());
    return {block, in_.number()};
  }

  FailOn readFailOn() {
    const uint64_t level = in_.number(severities + 1);
    return level ? FailOn(Severity(level - 1)) : FailOn();
  }

  SourceRange readRange() {
    const SourceFile &file = *files_[in_.number(files_.size())];
    const uint64_t most = file.text().size() + 1;
    const auto begin = uint32_t(in_.number(most)), end = uint32_t(in_.number(most));
    return {file.id(), begin, end};
  }

  template <typename T>
  void readPlaces(T &places) {
    for (uint64_t left = in_.number(); left && !in_.failed(); --left) {
      const SourceRange range = readRange();
      places.push_back({range, in_.text().str()});
    }
  }

  CheckedFinding readFinding() {
    CheckedFinding checked;
    checked.program = in_.text().str();
    checked.blockText = in_.text().str();
    checked.failOn = readFailOn();
    Finding &finding = checked.finding;
    finding.rule = RuleId(in_.number(allRules().size()));
    finding.severity = Severity(in_.number(severities));
    finding.certainty = Certainty(in_.number(uint64_t(Certainty::Definite) + 1));
    finding.suppressed = in_.number(2);
    finding.range = readRange();
    finding.message = in_.text().str();
    readPlaces(finding.notes);
    readPlaces(finding.path);
    if (in_.number(2)) {
      Fix &fix = finding.fix.emplace();
      fix.description = in_.text().str();
      fix.safety = FixSafety(in_.number(uint64_t(FixSafety::Unsafe) + 1));
      readPlaces(fix.edits);
    }
    return checked;
  }

  ByteReader in_;
  llvm::function_ref<const SourceFile *(llvm::StringRef)> open_;
  std::vector<const SourceFile *> files_;
};

} // namespace

std::string outcomeBytes(const FileOutcome &outcome, const SourceFile &file,
                         const SourceSet &sources) {
  return OutcomeWriter(file, sources).run(outcome);
}

std::optional<FileOutcome> outcomeOf(llvm::StringRef bytes, const SourceFile &file,
                                     llvm::function_ref<const SourceFile *(llvm::StringRef)> open) {
  return OutcomeReader(bytes, file, open).run();
}

} // namespace ncvet
