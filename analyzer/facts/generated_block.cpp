// Blocks that a dialog of the control wrote: their comments carry what the dialog reads back.
#include "analyzer/facts/generated_block.h"

#include "llvm/ADT/StringExtras.h"

#include <algorithm>

namespace ncvet {

namespace {

/// The comment's text without its mark and outer blanks.
llvm::StringRef innerText(const Comment &comment, llvm::StringRef text) {
  llvm::StringRef inner = text.slice(comment.begin, comment.end);
  if (!inner.consume_front("\"")) {
    // Typographic: three bytes of UTF-8, or one of Windows-1250.
    const size_t mark = inner.startswith("\xE2") ? 3 : 1;
    inner = inner.drop_front(std::min(mark, inner.size()));
  }
  return inner.trim();
}

/// What is between the first and the last apostrophe.
llvm::StringRef quoted(llvm::StringRef text) {
  const size_t first = text.find('\''), last = text.rfind('\'');
  return first == llvm::StringRef::npos || last <= first ? llvm::StringRef()
                                                         : text.slice(first + 1, last);
}

void appendWords(std::string &target, llvm::StringRef text) {
  llvm::SmallVector<llvm::StringRef, 8> words;
  llvm::SplitString(text, words, " \t\r\n");
  for (const llvm::StringRef word : words) {
    if (!target.empty())
      target += ' ';
    target += word;
  }
}

uint32_t endOfCode(const Block &block) {
  uint32_t end = block.begin;
  for (const Word &word : block.words)
    end = std::max(end, block.endOf(word));
  for (const Item &item : block.items)
    end = std::max(end, item.end);
  return end;
}

/// On the line of the block's last code. What follows on lines of its own may be meant for the
/// next block.
bool isAfter(uint32_t end, const Comment &comment, const Block &block, llvm::StringRef text) {
  return end > block.begin && text.slice(end, comment.begin).trim(" \t").empty();
}

std::string optionOf(const Dialect &dialect, const MachineProfile &machine, llvm::StringRef name) {
  if (const auto value = machine.option(name))
    return value->str();
  const auto found = dialect.options.find(name);
  return found == dialect.options.end() ? std::string() : found->second;
}

} // namespace

const Dialog *Dialogs::find(llvm::StringRef path) const {
  const size_t slash = path.find_last_of("\\/");
  const llvm::StringRef page = slash == llvm::StringRef::npos ? path : path.substr(slash + 1);
  for (const Dialog &dialog : list)
    if (page.equals_insensitive(dialog.file))
      return &dialog;
  return nullptr;
}

bool hasDialogs(const Dialect &dialect) { return dialect.options.count("dialogs") != 0; }

Dialogs dialogsOf(const Dialect &dialect, const MachineProfile &machine) {
  Dialogs dialogs;
  dialogs.folder = optionOf(dialect, machine, "dialogFolder");
  const std::string list = optionOf(dialect, machine, "dialogs");
  llvm::SmallVector<llvm::StringRef, 8> entries;
  llvm::SplitString(list, entries, " ,");
  for (const llvm::StringRef entry : entries) {
    const auto [file, part] = entry.split('=');
    dialogs.list.push_back({file.str(), part.upper()});
  }
  llvm::SmallVector<llvm::StringRef, 16> lines;
  const std::string ofDialog = optionOf(dialect, machine, "dialogLines");
  llvm::SplitString(ofDialog, lines, " ,");
  for (const llvm::StringRef line : lines)
    dialogs.lines.push_back(line.upper());
  return dialogs;
}

GeneratedBlock readGenerated(const Block &block, llvm::StringRef text) {
  GeneratedBlock result;
  const uint32_t end = endOfCode(block);
  for (const Comment &comment : block.comments) {
    const llvm::StringRef inner = innerText(comment, text);
    if (inner.startswith("Automatically generated code")) {
      result.notice = &comment;
    } else if (inner.startswith("HtmlFile")) {
      result.page = &comment;
      result.path = quoted(inner);
    } else if (inner.startswith("LineCode")) {
      result.codeLines.push_back(&comment);
      appendWords(result.code, quoted(inner));
    } else if (comment.begin < end || isAfter(end, comment, block, text)) {
      result.own.push_back(&comment);
    }
  }
  return result;
}

std::string codeAfter(const GeneratedBlock &generated, const Block &block, llvm::StringRef text) {
  uint32_t from = generated.codeLines.empty() ? block.begin : generated.codeLines.back()->end;
  const uint32_t end = endOfCode(block);
  std::string code;
  for (const Comment &comment : block.comments) {
    if (comment.begin < from)
      continue;
    appendWords(code, text.slice(from, std::min(comment.begin, std::max(from, end))));
    from = comment.end;
  }
  appendWords(code, text.slice(from, std::max(from, end)));
  return code;
}

std::string assignedName(const Item &item, llvm::StringRef text) {
  return item.kind == ItemKind::Assignment ? text.slice(item.nameBegin, item.nameEnd).upper()
                                           : std::string();
}

const Item *findAssignment(const Block &block, llvm::StringRef name, llvm::StringRef text) {
  for (const Item &item : block.items)
    if (name == assignedName(item, text))
      return &item;
  return nullptr;
}

} // namespace ncvet
