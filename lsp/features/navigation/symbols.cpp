// The outline of a document: its programs, and in them tools, operations, subprograms and labels.
#include "lsp/features/navigation/symbols.h"

#include "llvm/Support/Path.h"

namespace ncvet::lsp {

namespace {

bool isSymbol(PartKind kind) {
  return kind == PartKind::Program || kind == PartKind::Subprogram || kind == PartKind::Tool ||
         kind == PartKind::Operation || kind == PartKind::Label;
}

/// Name and detail of a part.
void nameSymbol(Symbol &symbol, const Part &part, const Snapshot &snapshot) {
  const SourceFile &source = snapshot.source();
  const std::string note = noteText(source, part.noteBegin, part.noteEnd);
  symbol.name = noteText(source, part.nameBegin, part.nameEnd);
  symbol.detail = note;
  switch (part.kind) {
  case PartKind::Program:
    if (symbol.name.empty())
      symbol.name = llvm::sys::path::stem(source.display()).str();
    break;
  case PartKind::Tool:
    if (!note.empty()) {
      symbol.name += " " + note;
      symbol.detail.clear();
    }
    break;
  case PartKind::Operation:
    if (note.empty())
      symbol.detail = snapshot.dialect().codes[part.code].title;
    break;
  default:
    break;
  }
  if (symbol.name.empty())
    symbol.name = "?";
}

/// Puts parts that are sorted by their begin into a tree; what reaches over the end of the part
/// around it is cut there.
class Tree {
public:
  explicit Tree(const Snapshot &snapshot) : snapshot_(snapshot) {}

  void add(const Part &part) {
    while (!open_.empty() && open_.back()->full.end <= part.begin)
      open_.pop_back();
    std::vector<Symbol> &place = open_.empty() ? roots_ : open_.back()->children;
    Symbol &symbol = place.emplace_back();
    const FileId file = snapshot_.source().id();
    const uint32_t end = open_.empty() ? part.end : std::min(part.end, open_.back()->full.end);
    symbol.kind = part.kind;
    symbol.full = {file, part.begin, end};
    symbol.selection = {file, std::clamp(part.nameBegin, part.begin, end),
                        std::clamp(part.nameEnd, part.begin, end)};
    nameSymbol(symbol, part, snapshot_);
    // Labels are siblings, whatever they lead to.
    if (part.kind != PartKind::Label)
      open_.push_back(&symbol);
  }
  std::vector<Symbol> take() { return std::move(roots_); }

private:
  const Snapshot &snapshot_;
  std::vector<Symbol> roots_;
  std::vector<Symbol *> open_; ///< each the last child of the one before: none of them moves
};

void flatten(std::vector<Symbol> &symbols, llvm::StringRef container, llvm::StringRef query,
             std::vector<NamedSymbol> &flat) {
  for (Symbol &symbol : symbols) {
    const bool program = symbol.kind == PartKind::Program;
    flatten(symbol.children, program ? llvm::StringRef(symbol.name) : container, query, flat);
    if (symbol.kind != PartKind::Tool && symbol.kind != PartKind::Operation &&
        llvm::StringRef(symbol.name).contains_insensitive(query))
      flat.push_back(
          {symbol.kind, symbol.name, program ? std::string() : container.str(), symbol.selection});
  }
}

} // namespace

std::vector<Symbol> documentSymbols(Snapshot &snapshot) {
  Tree tree(snapshot);
  for (const Part &part : partsOf(snapshot))
    if (isSymbol(part.kind))
      tree.add(part);
  return tree.take();
}

std::vector<NamedSymbol> workspaceSymbols(Snapshot &snapshot, llvm::StringRef query) {
  std::vector<Symbol> symbols = documentSymbols(snapshot);
  std::vector<NamedSymbol> flat;
  flatten(symbols, {}, query, flat);
  llvm::sort(flat, [](const NamedSymbol &a, const NamedSymbol &b) {
    return a.selection.begin < b.selection.begin;
  });
  return flat;
}

} // namespace ncvet::lsp
