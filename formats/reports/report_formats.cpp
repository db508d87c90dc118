// The formats of reports: their list, and the writer of each.
#include "formats/reports/report_formats.h"

#include "formats/reports/writers.h"

namespace ncvet {

llvm::ArrayRef<ReportFormat> reportFormats() {
  static constexpr ReportFormat formats[] = {
      {"text", "for people: message, program line and marked range"},
      {"json", "all of it, version 1"},
      {"sarif", "SARIF 2.1.0, for code scanning and viewers"},
      {"gcc", "one line a finding, for editors and build tools"},
      {"checkstyle", "XML, for continuous integration servers"},
      {"html", "one page: programs, findings, and the path of the tool", true},
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
  if (format == "html")
    return makeHtmlWriter();
  return nullptr;
}

} // namespace ncvet
