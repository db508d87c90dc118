// The formats of reports: their list, and the writer of each.
#pragma once

#include "formats/reports/report.h"

#include <memory>

namespace ncvet {

struct ReportFormat {
  llvm::StringRef name;
  llvm::StringRef summary;    ///< a few words for a list of formats
  bool showsPrograms = false; ///< it wants `Report::views`
};

/// All formats, the default one first.
llvm::ArrayRef<ReportFormat> reportFormats();

/// The writer of a format; null when there is no format of that name.
std::unique_ptr<ReportWriter> makeReportWriter(llvm::StringRef format,
                                               const ReportOptions &options = {});

/// Findings counted by rule, in place of `text`.
std::unique_ptr<ReportWriter> makeStatisticsWriter();

} // namespace ncvet
