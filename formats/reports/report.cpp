// Reports: the list of formats, the order of output, and what the writers share.
#include "formats/reports/report.h"

#include "formats/finding/finding_order.h"
#include "formats/reports/writers.h"

#include <algorithm>
#include <tuple>

namespace ncvet {

std::tuple<llvm::StringRef, uint32_t, llvm::StringRef, uint32_t>
placeInReport(const Report &report, const Finding &finding) {
  // Of one file, byte offsets are in the order of lines and columns.
  return placeInOrder(
      finding, [&](FileId file) { return llvm::StringRef(report.sources->get(file).display()); },
      [&](RuleId rule) { return report.rules[rule].id; });
}

void sortReport(Report &report) {
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [&](const Finding &a, const Finding &b) {
                     const auto left = placeInReport(report, a), right = placeInReport(report, b);
                     return left != right ? left < right : a.message < b.message;
                   });
  std::stable_sort(report.files.begin(), report.files.end(),
                   [](const FileReport &a, const FileReport &b) { return a.path < b.path; });
  std::stable_sort(report.notifications.begin(), report.notifications.end(),
                   [](const Notification &a, const Notification &b) {
                     return std::tie(a.path, a.message) < std::tie(b.path, b.message);
                   });
  std::stable_sort(report.absent.begin(), report.absent.end(),
                   [](const AbsentFinding &a, const AbsentFinding &b) {
                     return std::tie(a.path, a.line, a.rule, a.fingerprint) <
                            std::tie(b.path, b.line, b.rule, b.fingerprint);
                   });
}

llvm::ArrayRef<ReportFormat> reportFormats() {
  static constexpr ReportFormat formats[] = {
      {"text", "for people: message, program line and marked range"},
      {"json", "all of it, version 1"},
      {"sarif", "SARIF 2.1.0, for code scanning and viewers"},
      {"gcc", "one line a finding, for editors and build tools"},
      {"checkstyle", "XML, for continuous integration servers"},
  };
  return formats;
}

std::unique_ptr<ReportWriter> makeReportWriter(llvm::StringRef format,
                                               const ReportOptions &options) {
  if (format == "text")
    return makeTextWriter(options);
  if (format == "json")
    return makeJsonWriter();
  if (format == "sarif")
    return makeSarifWriter();
  if (format == "gcc")
    return makeGccWriter();
  if (format == "checkstyle")
    return makeCheckstyleWriter();
  return nullptr;
}

const SourceFile &fileOf(const Report &report, const SourceRange &range) {
  return report.sources->get(range.file);
}

LineColumn positionOf(const Report &report, const SourceRange &range) {
  return fileOf(report, range).position(range.begin);
}

Region regionOf(const Report &report, const SourceRange &range) {
  const SourceFile &file = fileOf(report, range);
  const LineColumn begin = file.position(range.begin);
  return {begin, file.position(std::max(range.begin, range.end))};
}

std::string validText(const Report &report, const SourceRange &range, llvm::StringRef text) {
  return isValidUtf8(text) ? text.str() : fileOf(report, range).displayText(text);
}

std::string oneLine(llvm::StringRef text) {
  std::string out;
  out.reserve(text.size());
  for (const char byte : text) {
    const auto code = static_cast<unsigned char>(byte);
    if (code < 0x20)
      appendUtf8(out, 0x2400u + code); // Unicode's pictures of control characters
    else if (code == 0x7F)
      appendUtf8(out, 0x2421);
    else
      out.push_back(byte);
  }
  return out;
}

} // namespace ncvet
