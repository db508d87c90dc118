// Fuzzes the whole check: any bytes, in any dialect, with all rules, give findings that can be
// reported, the same ones each time, and fixes that fit.
#include "analyzer/check/checker.h"
#include "analyzer/check/fix.h"
#include "formats/reports/report_formats.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/sessions.h"

#include <cstdint>

namespace {

using namespace ncvet;
using fuzz::require;
using fuzz::sessionOf;

/// Findings of `text` as text, or in every format: one of them holds the pages of all rules, which
/// takes longer than the check.
std::string reportOf(Session &session, llvm::StringRef text, bool everyFormat) {
  SourceSet sources;
  // Without a path there is no folder in which called programs could lie.
  const SourceFile &file = sources.add("fuzz.nc", text);
  FileOutcome outcome = checkFile(session, sources, file);
  require(outcome.error.empty());
  Report report;
  std::vector<RuleInfo> rules;
  for (const RuleEntry &rule : allRules())
    rules.push_back(rule.info);
  report.rules = rules;
  report.sources = &sources;
  report.files.push_back({"fuzz.nc", outcome.dialect, outcome.blocks, outcome.complete, {}});
  for (CheckedFinding &checked : outcome.findings) {
    const SourceRange &range = checked.finding.range;
    require(range.begin <= range.end && range.end <= sources.get(range.file).text().size());
    require(!checked.finding.message.empty());
    report.findings.push_back(std::move(checked.finding));
  }
  sortReport(report);
  std::string all;
  llvm::raw_string_ostream out(all);
  for (const ReportFormat &format : reportFormats()) {
    makeReportWriter(format.name)->write(report, out);
    if (!everyFormat)
      break;
  }
  return all;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size == 0)
    return 0;
  const llvm::StringRef text(reinterpret_cast<const char *>(data) + 1, size - 1);
  // The first byte chooses the dialect, and with its upper bits whether fixes are tried: they
  // check again and again.
  Session &session = sessionOf(data[0] & 0x0F);
  constexpr uint8_t formats = 0x70, repeated = 0xC0, fixed = 0xB0;
  const auto chosen = [&](uint8_t what) { return (data[0] & 0xF0) == what; };
  const std::string report = reportOf(session, text, chosen(formats));
  if (chosen(repeated))
    require(reportOf(session, text, false) == report);
  if (chosen(fixed)) {
    SourceSet sources;
    const SourceFile &file = sources.add("fuzz.nc", text);
    const FixedText once = fixText(session, file, /*unsafe=*/false);
    SourceSet others;
    const FixedText twice = fixText(session, others.add("fuzz.nc", once.text), /*unsafe=*/false);
    require(once.rounds >= 10 || twice.text == once.text);
  }
  return 0;
}
