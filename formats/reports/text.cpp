// Report as text in clang's layout: message, program line with marked range, notes, path, fix.
#include "formats/reports/writers.h"

#include "llvm/Support/Format.h"
#include "llvm/Support/Unicode.h"

#include <algorithm>

namespace ncvet {

namespace {

using Color = llvm::raw_ostream::Colors;

/// Bytes shown before and after the begin of a range when a line is longer: a file without
/// line ends must not be printed once a finding.
constexpr uint32_t shownBefore = 120;
constexpr uint32_t shownAfter = 360;
constexpr uint32_t tabWidth = 8;
/// Digits that line numbers are aligned to, so that the usual program has one gutter.
constexpr unsigned gutterDigits = 4;

/// The part of a line that is shown.
struct Excerpt {
  uint32_t begin = 0;
  uint32_t end = 0;
  bool cutBefore = false;
  bool cutAfter = false;
};

/// The line around `offset`, or the part of it that is near.
Excerpt excerptAt(const SourceFile &file, uint32_t offset) {
  const llvm::StringRef text = file.text();
  const auto isLineEnd = [&](uint32_t at) { return text[at] == '\n' || text[at] == '\r'; };
  const auto isContinuation = [&](uint32_t at) {
    return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80;
  };
  const auto size = static_cast<uint32_t>(text.size());
  const uint32_t textBegin = std::min(file.textBegin(), size);
  offset = std::clamp(offset, textBegin, size); // a byte order mark is not shown
  if (offset > 0 && offset < size && text[offset] == '\n' && text[offset - 1] == '\r')
    --offset; // within a line end: the line is the one that ends here
  Excerpt result{offset, offset, false, false};
  const uint32_t floor = std::max(textBegin, offset - std::min(offset, shownBefore));
  const uint32_t ceiling = offset + std::min(size - offset, shownAfter);
  while (result.begin > floor && !isLineEnd(result.begin - 1))
    --result.begin;
  while (result.end < ceiling && !isLineEnd(result.end))
    ++result.end;
  result.cutBefore = result.begin > textBegin && !isLineEnd(result.begin - 1);
  result.cutAfter = result.end < size && !isLineEnd(result.end);
  if (result.cutBefore || result.cutAfter) {
    if (file.encoding() == Encoding::Utf8) {
      while (result.cutBefore && result.begin < offset && isContinuation(result.begin))
        ++result.begin;
      while (result.cutAfter && result.end > offset && isContinuation(result.end))
        --result.end;
    }
  }
  return result;
}

/// One code point as it is printed, and the cells that it takes on a terminal.
struct Glyph {
  std::string text;
  uint32_t cells = 1;
};

Glyph glyphOf(const SourceFile &file, llvm::StringRef codePoint, uint32_t cell) {
  const auto first = static_cast<unsigned char>(codePoint.front());
  if (first == '\t') {
    const uint32_t cells = tabWidth - cell % tabWidth;
    return {std::string(cells, ' '), cells};
  }
  if (first < 0x80)
    return {oneLine(codePoint), 1};
  std::string text = file.displayText(codePoint);
  const int width = llvm::sys::unicode::columnWidthUTF8(text);
  if (width >= 0)
    return {std::move(text), static_cast<uint32_t>(width)};
  // Direction marks and the like would show a line that the control does not see.
  text.clear();
  appendUtf8(text, 0xFFFD);
  return {std::move(text), 1};
}

class TextWriter final : public ReportWriter {
public:
  explicit TextWriter(const ReportOptions &options) : options_(options) {}

  void write(const Report &report, llvm::raw_ostream &out) override {
    const bool colors = out.colors_enabled();
    out.enable_colors(options_.color);
    for (const Finding &finding : report.findings)
      if (!isHidden(finding))
        writeFinding(report, finding, out);
    out.enable_colors(colors);
  }

private:
  static Color colorOf(Severity severity) {
    switch (severity) {
    case Severity::Style:
      return Color::BLUE;
    case Severity::Warning:
      return Color::MAGENTA;
    case Severity::Error:
      return Color::RED;
    }
    llvm_unreachable("no such severity");
  }

  /// `path:line:column: kind: message`, without the line end.
  static void writeHead(const Report &report, const SourceRange &range, llvm::StringRef kind,
                        Color color, llvm::StringRef message, bool bold, llvm::raw_ostream &out) {
    const LineColumn position = positionOf(report, range);
    out.changeColor(Color::SAVEDCOLOR, /*Bold=*/true);
    out << oneLine(fileOf(report, range).display()) << ':' << position.line << ':'
        << position.column << ": ";
    out.changeColor(color, /*Bold=*/true) << kind << ": ";
    out.resetColor();
    if (bold)
      out.changeColor(Color::SAVEDCOLOR, /*Bold=*/true);
    out << oneLine(validText(report, range, message));
    if (bold)
      out.resetColor();
  }

  void writeFinding(const Report &report, const Finding &finding, llvm::raw_ostream &out) const {
    writeHead(report, finding.range, toString(finding.severity), colorOf(finding.severity),
              finding.message, /*bold=*/true, out);
    out << " [" << report.rules[finding.rule].id
        << (finding.certainty == Certainty::Possible ? ", possible]\n" : "]\n");
    if (options_.source)
      writeExcerpt(report, finding.range, out);
    const auto writeNote = [&](const SourceRange &range, llvm::StringRef message) {
      writeHead(report, range, "note", Color::CYAN, message, /*bold=*/false, out);
      out << '\n';
    };
    for (const Note &note : finding.notes)
      writeNote(note.range, note.message);
    for (const PathStep &step : finding.path)
      writeNote(step.range, step.message);
    if (!finding.fix)
      return;
    const Fix &fix = *finding.fix;
    writeHead(report, fix.edits.empty() ? finding.range : fix.edits.front().range, "fix",
              Color::GREEN, fix.description, /*bold=*/false, out);
    out << '\n';
  }

  /// The line on which `range` begins, and a caret with tildes under the range as far as it goes
  /// on that line.
  static void writeExcerpt(const Report &report, const SourceRange &range, llvm::raw_ostream &out) {
    const SourceFile &file = fileOf(report, range);
    const Excerpt excerpt = excerptAt(file, range.begin);
    const uint32_t begin = std::max(range.begin, excerpt.begin);
    const llvm::StringRef bytes = file.text(excerpt.begin, excerpt.end);
    const Encoding encoding = isAscii(bytes) ? Encoding::Utf8 : file.encoding();
    std::string shown = excerpt.cutBefore ? "..." : "";
    auto cell = static_cast<uint32_t>(shown.size());
    std::string marks;
    for (uint32_t at = excerpt.begin; at < excerpt.end;) {
      const uint32_t length = codePointLength(file.text(at, excerpt.end), encoding);
      const Glyph glyph = glyphOf(file, file.text(at, at + length), cell);
      shown += glyph.text;
      const bool marked = at + length > begin && at < range.end;
      if (marked && glyph.cells > 0) {
        marks.resize(cell, ' ');
        marks.append(glyph.cells, '~');
      }
      if (begin >= at && begin < at + length) {
        marks.resize(std::max<size_t>(marks.size(), cell + 1), ' ');
        marks[cell] = '^';
      }
      cell += glyph.cells;
      at += length;
    }
    if (begin >= excerpt.end) { // an empty range at the line's end
      marks.resize(cell, ' ');
      marks.push_back('^');
    }
    if (excerpt.cutAfter)
      shown += "...";
    const std::string number = std::to_string(positionOf(report, range).line);
    const auto width = std::max<size_t>(gutterDigits, number.size());
    out << std::string(width - number.size(), ' ') << number << " |";
    const llvm::StringRef line = llvm::StringRef(shown).rtrim(' ');
    if (!line.empty())
      out << ' ' << line;
    out << '\n' << std::string(width, ' ') << " | ";
    out.changeColor(Color::GREEN, /*Bold=*/true) << marks;
    out.resetColor() << '\n';
  }

  ReportOptions options_;
};

} // namespace

std::unique_ptr<ReportWriter> makeTextWriter(const ReportOptions &options) {
  return std::make_unique<TextWriter>(options);
}

} // namespace ncvet
