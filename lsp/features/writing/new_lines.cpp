// Blocks that rewritings put in the place of others, one to a line.
#include "lsp/features/writing/new_lines.h"

#include "formats/dialect/control_facts.h"
#include "lsp/features/names.h"

namespace ncvet::lsp {

std::string bareText(llvm::StringRef text, const Block &block) {
  std::string bare;
  uint32_t from = block.begin;
  const auto leaveOut = [&](uint32_t begin, uint32_t end) {
    if (end <= begin || begin < from)
      return;
    bare += text.slice(from, begin);
    from = end;
  };
  leaveOut(block.numberBegin, block.numberEnd);
  if (block.hasLabel()) // with its colon
    leaveOut(block.labelBegin, block.labelEnd + text.substr(block.labelEnd).startswith(":"));
  bare += text.slice(from, block.end);
  return llvm::StringRef(bare).trim(" \t\r\n").str();
}

llvm::StringRef lineEndOf(llvm::StringRef text) {
  const size_t at = text.find('\n');
  if (at == llvm::StringRef::npos)
    return "\n";
  return at > 0 && text[at - 1] == '\r' ? "\r\n" : "\n";
}

void NewLines::add(std::string bare) {
  if (bare.empty())
    return;
  lines_.push_back({std::move(bare), "", true});
  ++blocks_;
}

void NewLines::keep(const Block &block) {
  const llvm::StringRef text = selection_.snapshot().text();
  lines_.push_back({bareText(text, block), text.slice(block.begin, block.end).str(), true});
  ++blocks_;
}

void NewLines::keepText(uint32_t begin, uint32_t end) {
  llvm::SmallVector<llvm::StringRef, 8> lines;
  llvm::StringRef text = selection_.snapshot().text().slice(begin, end);
  if (text.empty())
    return;
  text.consume_back("\n");
  text.split(lines, '\n');
  for (const llvm::StringRef line : lines)
    lines_.push_back({"", line.rtrim('\r').str(), false});
}

bool NewLines::findNumbers(int64_t &first, int64_t &step) const {
  const Names &names = selection_.snapshot().names();
  int64_t after = 0;
  first = -1;
  for (const Occurrence &one : names.all()) {
    if (one.kind != NameKind::Block || one.use != NameUse::Definition)
      continue;
    if (one.begin >= selection_.end()) {
      if (names.programAt(one.begin) == names.programAt(selection_.begin()))
        after = int64_t(one.key);
      break;
    }
    if (one.begin >= selection_.begin() && first < 0)
      first = int64_t(one.key);
  }
  if (first < 0)
    return false;
  for (const int64_t tried : {10, 5, 2, 1}) {
    step = tried;
    if (after == 0 || first + int64_t(blocks_ - 1) * tried < after)
      return true;
  }
  return false;
}

std::string NewLines::text(std::string &refused) const {
  const bool numbers = selection_.dialect().facts->program.everyBlockNumbered;
  int64_t next = 0, step = 0;
  if (numbers && !findNumbers(next, step)) {
    refused = "there are not enough numbers before those of the next block";
    return {};
  }
  const llvm::StringRef lineEnd = lineEndOf(selection_.snapshot().text());
  std::string all;
  for (const Line &line : lines_) {
    if (!all.empty() || &line != &lines_.front())
      all += lineEnd;
    if (line.isBlock && numbers) {
      all += "N" + std::to_string(next) + " " + line.bare;
      next += step;
    } else {
      all += line.whole.empty() && line.isBlock ? line.bare : line.whole;
    }
  }
  return all;
}

} // namespace ncvet::lsp
