// Report as Markdown: a summary for a pull request or a job's page.
#include "formats/finding/finding_counts.h"
#include "formats/reports/writers.h"

namespace ncvet {

namespace {

/// Findings that are told one by one: a comment of a code host has a limit of 64 KiB, and nobody
/// reads more.
constexpr size_t mostFindings = 100;

/// `text` (valid UTF-8) in a cell of a table, as it is: Markdown and HTML in it mean nothing. What
/// is between accents is code already.
std::string tableCell(llvm::StringRef text) {
  std::string out;
  bool code = false;
  for (const char byte : oneLine(text)) {
    code ^= byte == '`';
    if (byte == '|' || (!code && llvm::StringRef("\\*_[]#~").contains(byte)))
      out.push_back('\\');
    if (!code && (byte == '<' || byte == '>' || byte == '&'))
      out += byte == '<' ? "&lt;" : byte == '>' ? "&gt;" : "&amp;";
    else
      out.push_back(byte);
  }
  return out;
}

class MarkdownWriter final : public ReportWriter {
public:
  void write(const Report &report, llvm::raw_ostream &out) override {
    const FindingCounts counts = countFindings(report.findings);
    out << "### " << report.toolName << ": ";
    writeTotals(report, counts, out);
    for (const Notification &notification : report.notifications)
      out << "\n- **" << toString(notification.severity)
          << "**: " << tableCell(notification.message);
    if (!report.notifications.empty())
      out << '\n';
    if (counts.shown) {
      writeRules(report, out);
      writeFindings(report, counts, out);
    }
  }

private:
  static void writeTotals(const Report &report, const FindingCounts &counts,
                          llvm::raw_ostream &out) {
    const auto counted = [&](size_t number, llvm::StringRef what) -> llvm::raw_ostream & {
      return out << number << ' ' << what << (number == 1 ? "" : "s");
    };
    if (counts.shown == 0) {
      out << "no findings in ";
      counted(report.files.size(), "file") << '\n';
    } else {
      counted(counts.shown, "finding") << ": ";
      counted(counts.of(Severity::Error), "error") << ", ";
      counted(counts.of(Severity::Warning), "warning") << ", ";
      out << counts.of(Severity::Style) << " style\n";
    }
    if (counts.known)
      out << '\n' << counts.known << " more are known from the baseline.\n";
  }

  static void writeRules(const Report &report, llvm::raw_ostream &out) {
    std::map<RuleId, size_t> byRule;
    for (const Finding &finding : report.findings)
      if (!isHidden(finding))
        ++byRule[finding.rule];
    out << "\n| rule | findings | what it reports |\n|---|--:|---|\n";
    for (const auto &[rule, count] : byRule)
      out << "| `" << report.rules[rule].id << "` | " << count << " | "
          << tableCell(report.rules[rule].summary) << " |\n";
  }

  static void writeFindings(const Report &report, const FindingCounts &counts,
                            llvm::raw_ostream &out) {
    out << "\n| place | severity | finding | rule |\n|---|---|---|---|\n";
    size_t told = 0;
    for (const Finding &finding : report.findings) {
      if (isHidden(finding))
        continue;
      if (told++ == mostFindings)
        break;
      std::string path;
      appendDecoded(path, pathFromRoot(report, fileOf(report, finding.range).display()),
                    Encoding::Utf8);
      out << "| " << tableCell(path) << ':' << positionOf(report, finding.range).line << " | "
          << toString(finding.severity) << " | "
          << tableCell(validText(report, finding.range, finding.message)) << " | `"
          << report.rules[finding.rule].id << "` |\n";
    }
    if (counts.shown > mostFindings)
      out << "\nThe first " << mostFindings << " of " << counts.shown << " findings are shown.\n";
  }
};

} // namespace

std::unique_ptr<ReportWriter> makeMarkdownWriter() { return std::make_unique<MarkdownWriter>(); }

} // namespace ncvet
