// Report as JSON lines: a finding a line, in the form that it has in the JSON report.
#include "formats/reports/writers.h"

#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

class JsonlWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    for (const Finding &finding : report.findings) {
      if (isHidden(finding))
        continue;
      dumpJson(findingJson(report, finding), out);
      out << '\n';
    }
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeJsonlWriter() { return std::make_unique<JsonlWriter>(); }

} // namespace ncvet
