// A report with one of everything, for the tests of the writers.
#pragma once

#include "formats/reports/report_formats.h"

#include "llvm/Support/raw_ostream.h"

namespace ncvet::test {

/// Range of the first `part` in a file's text.
inline SourceRange rangeOf(const SourceFile &file, llvm::StringRef part) {
  const size_t begin = file.text().find(part);
  assert(begin != llvm::StringRef::npos && "no such text");
  return {file.id(), static_cast<uint32_t>(begin), static_cast<uint32_t>(begin + part.size())};
}

/// What a writer makes of a report.
inline std::string written(llvm::StringRef format, const Report &report,
                           const ReportOptions &options = {}) {
  std::string out;
  llvm::raw_string_ostream stream(out);
  makeReportWriter(format, options)->write(report, stream);
  return stream.str();
}

/// Three rules, two programs, and findings with note, path, fix, suppression and baseline.
struct SampleReport {
  static llvm::ArrayRef<RuleInfo> rules() {
    static const RuleInfo table[] = {
        {"cycle-unintended-execution",
         "cycle",
         "A canned cycle that is still active drills at a block that is to position.",
         "# cycle-unintended-execution\n\nA cycle stays active until `G80`.\n",
         Severity::Warning,
         true,
         "safe",
         {}},
        {"missing-feed",
         "feed",
         "A cutting motion has no feed.",
         "# missing-feed\n\nThe control stops with an alarm.\n",
         Severity::Error,
         true,
         "none",
         {}},
        {"decimal-point",
         "style",
         "A coordinate has no decimal point",
         "# decimal-point\n\n`X100` may be 0.1 mm.\n",
         Severity::Style,
         false,
         "unsafe",
         {}},
    };
    return table;
  }

  SourceSet sources;
  Report report;
  const SourceFile &bore;
  const SourceFile &sub;

  SampleReport()
      : bore(sources.add("programs/bore \xC3\xB6.nc",
                         "%\nO0001\nG83 Z-20. Q3. F100\nX10. Y0.\n"
                         "X30. Y0. (TO CLAMP)\nM98 P2\nG80\nM30\n%\n")),
        sub(sources.add("programs/sub.nc", "O0002 (B\xF6hrer)\nG1 X100\nM99\n")) {
    report.toolVersion = "0.1.0";
    report.rules = rules();
    report.sources = &sources;
    report.files = {{"programs/bore \xC3\xB6.nc", "haas-mill", 7, true, "by its content"},
                    {"programs/sub.nc", "haas-mill", 3, false, "as its caller"}};
    report.notifications = {
        {Severity::Error, "cannot read gone.nc: No such file or directory", "gone.nc"}};

    Finding cycle;
    cycle.rule = 0;
    cycle.range = rangeOf(bore, "X30. Y0.");
    cycle.message = "X30. Y0. drills again: G83 of line 3 is still active";
    cycle.notes.push_back({rangeOf(bore, "G83"), "G83 becomes active here"});
    cycle.fix = Fix{"insert G80 before this block", FixSafety::Safe, {}};
    cycle.fix->edits.push_back({{bore.id(), cycle.range.begin, cycle.range.begin}, "G80\n"});
    cycle.fingerprint = 0x0123456789abcdef;

    Finding feed;
    feed.rule = 1;
    feed.severity = Severity::Error;
    feed.certainty = Certainty::Possible;
    feed.range = rangeOf(sub, "G1 X100");
    feed.message = "G1 without a feed";
    feed.path.push_back({rangeOf(bore, "M98 P2"), "O0002 is called here"});
    feed.fingerprint = 2;

    Finding point;
    point.rule = 2;
    point.severity = Severity::Style;
    point.range = rangeOf(sub, "X100");
    point.message = "X100 has no decimal point";
    point.fix = Fix{"write X100.", FixSafety::Unsafe, {}};
    point.fix->edits.push_back({{sub.id(), point.range.end, point.range.end}, "."});
    point.fingerprint = 3;

    report.findings = {point, feed, cycle};
    sortReport(report);
  }
};

} // namespace ncvet::test
