// The text of a program in a page, with its colours.
#include "formats/reports/page_json.h"
#include "formats/reports/page_parts.h"
#include "formats/text/json_text.h"

#include <nlohmann/json.hpp>

namespace ncvet {

namespace {

/// A longer line is cut there: nobody reads on, and browsers lay it out for minutes.
constexpr uint32_t longestPageLine = 4000;

/// Units of UTF-16 that valid UTF-8 takes: what a page counts columns in.
uint32_t unitsOf(llvm::StringRef text) {
  uint32_t units = 0;
  for (const char byte : text) {
    const auto code = static_cast<unsigned char>(byte);
    if ((code & 0xC0) != 0x80)
      units += code >= 0xF0 ? 2 : 1;
  }
  return units;
}

/// Writes lines as one string of JSON, and notes where each colour is in that string.
class TextWriter {
public:
  TextWriter(const SourceFile &file, llvm::ArrayRef<TextColour> colours, llvm::raw_ostream &out)
      : file_(file), colours_(colours), out_(out) {}

  /// The line [begin, end), and whether it goes on in the file.
  void line(uint32_t begin, uint32_t end) {
    const uint32_t shown = std::min(end, begin + longestPageLine);
    std::string text = file_.displayText(file_.text(begin, shown));
    colourLine(begin, shown, text);
    const uint32_t units = unitsOf(text);
    if (shown < end)
      text += " \xE2\x80\xA6";
    put(text + "\n");
    at_ += units + (shown < end ? 2 : 0) + 1;
  }
  std::string colours() const { return bytes_.base64(); }

private:
  void put(const std::string &text) {
    const std::string json = jsonText(nlohmann::json(text));
    writeJsonInPage(llvm::StringRef(json).drop_front().drop_back(), out_);
  }

  void colourLine(uint32_t begin, uint32_t end, const std::string &text) {
    const bool isPlain = text.size() == end - begin && isAscii(text);
    while (!colours_.empty() && colours_.front().begin < end) {
      const TextColour &colour = colours_.front();
      if (colour.begin >= begin && colour.end <= end && colour.begin < colour.end) {
        const uint32_t from = isPlain ? colour.begin - begin : units(begin, colour.begin);
        const uint32_t length =
            isPlain ? colour.end - colour.begin : units(colour.begin, colour.end);
        bytes_.addShort(at_ + from - last_);
        bytes_.addShort(length);
        bytes_.add(uint8_t(colour.name | (colour.definition ? 0x80 : 0)));
        last_ = at_ + from + length;
      }
      colours_ = colours_.drop_front();
    }
  }
  uint32_t units(uint32_t begin, uint32_t end) const {
    return unitsOf(file_.displayText(file_.text(begin, end)));
  }

  const SourceFile &file_;
  llvm::ArrayRef<TextColour> colours_;
  llvm::raw_ostream &out_;
  NumberBytes bytes_;
  uint32_t at_ = 0;   ///< units written
  uint32_t last_ = 0; ///< after the last colour
};

} // namespace

void writeTextJson(const SourceFile &file, llvm::ArrayRef<TextColour> colours, size_t &budget,
                   llvm::raw_ostream &out) {
  out << "{\"text\":\"";
  TextWriter writer(file, colours, out);
  const uint32_t size = uint32_t(file.text().size());
  bool isCut = false;
  for (uint32_t begin = file.textBegin(); begin < size && !isCut;) {
    const uint32_t end = file.lines().lineEnd(begin);
    const size_t cost = std::min(end - begin, longestPageLine) + 1;
    isCut = cost > budget;
    if (isCut)
      break;
    budget -= cost;
    writer.line(begin, end);
    begin = end + (file.text().substr(end).startswith("\r\n") ? 2 : 1);
  }
  out << "\",\"cut\":" << (isCut ? "true" : "false") << ",\"colours\":\"" << writer.colours()
      << "\"}";
}

} // namespace ncvet
