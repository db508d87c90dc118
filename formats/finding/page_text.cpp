// A rule's page taken apart into headings, paragraphs and programs.
#include "formats/finding/page_text.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/Twine.h"

namespace ncvet {

namespace {

constexpr llvm::StringLiteral programFence = "```nc ";

/// A heading, a paragraph or a fenced program of a page, with the empty lines after it.
struct PagePiece {
  enum Kind : uint8_t { Heading, Paragraph, Program };
  Kind kind = Paragraph;
  bool kept = true;
  llvm::StringRef text;
};

std::vector<PagePiece> piecesOf(llvm::StringRef body) {
  std::vector<PagePiece> pieces;
  bool fenced = false, ended = true; // inside a fence; an empty line has ended the piece
  while (!body.empty()) {
    const size_t end = body.find('\n');
    const llvm::StringRef line = body.take_front(end == llvm::StringRef::npos ? end : end + 1);
    body = body.drop_front(line.size());
    const bool empty = line.trim().empty(), program = !fenced && line.startswith(programFence);
    if (program || (ended && !empty)) {
      PagePiece &piece = pieces.emplace_back();
      piece.kind = program                ? PagePiece::Program
                   : line.startswith("#") ? PagePiece::Heading
                                          : PagePiece::Paragraph;
      piece.text = line.take_front(0);
    }
    if (pieces.empty())
      pieces.emplace_back().text = line.take_front(0); // empty lines at the head
    if (line.startswith("```"))
      fenced = !fenced;
    ended = !fenced && (empty || line.startswith("```"));
    llvm::StringRef &text = pieces.back().text;
    text = llvm::StringRef(text.data(), text.size() + line.size());
  }
  return pieces;
}

/// Control of a program: the word after the fence.
llvm::StringRef controlOf(llvm::StringRef program) {
  program.consume_front(programFence);
  return program.take_until([](char c) { return c == ' ' || c == '\n'; });
}

/// A paragraph without its last sentence, which ends in a colon and introduces what is left out.
llvm::StringRef withoutIntroduction(llvm::StringRef paragraph) {
  const size_t end = paragraph.rtrim().rfind(". ");
  const size_t lineEnd = paragraph.rtrim().rfind(".\n");
  const size_t sentence = end == llvm::StringRef::npos       ? lineEnd
                          : lineEnd == llvm::StringRef::npos ? end
                                                             : std::max(end, lineEnd);
  return sentence == llvm::StringRef::npos ? paragraph.take_front(0)
                                           : paragraph.take_front(sentence + 1);
}

/// Paragraphs go when all programs after them do; one that ends in a colon speaks of the next
/// program alone.
void dropIntroductions(std::vector<PagePiece> &pieces) {
  bool introduces = false, allDropped = true, nextDropped = false;
  for (PagePiece &piece : llvm::reverse(pieces)) {
    if (piece.kind == PagePiece::Program) {
      allDropped = (!introduces || allDropped) && !piece.kept;
      introduces = true;
      nextDropped = !piece.kept;
      continue;
    }
    if (piece.kind == PagePiece::Paragraph && introduces) {
      piece.kept = !allDropped;
      if (piece.kept && nextDropped && piece.text.rtrim().endswith(":"))
        piece.text = withoutIntroduction(piece.text);
    }
    introduces = false;
  }
}

size_t levelOf(const PagePiece &heading) {
  return heading.text.size() - heading.text.ltrim('#').size();
}

/// Headings of sections from which all was left out; what was empty before stays.
void dropEmptySections(std::vector<PagePiece> &pieces) {
  bool keptBelow = false, droppedBelow = false;
  size_t level = 0; // of the heading that was looked at last, from the end
  for (PagePiece &piece : llvm::reverse(pieces)) {
    if (piece.kind != PagePiece::Heading) {
      keptBelow |= piece.kept;
      droppedBelow |= !piece.kept;
      continue;
    }
    const bool encloses = level > levelOf(piece);
    piece.kept = keptBelow || !droppedBelow || encloses;
    level = levelOf(piece);
    keptBelow = droppedBelow = false;
  }
}

/// `( ^^^ expect: definite)`: tells a test what is reported in the line above, or with `^-1` in one
/// further up.
bool isTestMark(llvm::StringRef line) {
  line = line.ltrim();
  if (line.empty() || !llvm::StringRef("(;'\"").contains(line.front()))
    return false;
  line = line.drop_front().ltrim();
  return line.startswith("^") && line.ltrim("^-0123456789").startswith(" expect:");
}

/// The head of a program, "```nc CONTROL wrong machine={...}", as people need it: its section says
/// whether it is wrong, and a sentence which machine it runs on.
std::string headForReaders(llvm::StringRef head) {
  const llvm::StringRef machine = head.split(" machine=").second.trim();
  std::string text;
  if (!machine.empty())
    text = ("With the machine profile `" + machine + "`:\n\n").str();
  return text + programFence.str() + controlOf(head).str() + "\n";
}

} // namespace

std::pair<llvm::StringRef, llvm::StringRef> splitPage(llvm::StringRef page) {
  llvm::StringRef head;
  if (page.consume_front("```json\n")) {
    std::tie(head, page) = page.split("\n```\n");
    page = page.ltrim("\n");
  }
  return {head, page};
}

std::vector<std::string> controlsOfPrograms(llvm::StringRef body) {
  std::vector<std::string> controls;
  for (const PagePiece &piece : piecesOf(body))
    if (piece.kind == PagePiece::Program && !llvm::is_contained(controls, controlOf(piece.text)))
      controls.push_back(controlOf(piece.text).str());
  return controls;
}

std::string withProgramsOf(llvm::ArrayRef<std::string> controls, llvm::StringRef body) {
  std::vector<PagePiece> pieces = piecesOf(body);
  bool any = false;
  for (PagePiece &piece : pieces)
    if (piece.kind == PagePiece::Program) {
      piece.kept = llvm::is_contained(controls, controlOf(piece.text));
      any |= piece.kept;
    }
  if (!any)
    return body.str();
  dropIntroductions(pieces);
  dropEmptySections(pieces);
  std::string kept;
  for (const PagePiece &piece : pieces)
    if (piece.kept) {
      kept += piece.text;
      if (!piece.text.empty() && !piece.text.endswith("\n"))
        kept += "\n\n";
    }
  return kept;
}

std::string forReaders(llvm::StringRef body) {
  std::string text;
  for (const PagePiece &piece : piecesOf(body)) {
    if (piece.kind == PagePiece::Paragraph && piece.text.startswith("Source:"))
      continue;
    llvm::StringRef rest = piece.text;
    if (piece.kind == PagePiece::Program) {
      const size_t head = rest.find('\n');
      text += headForReaders(rest.take_front(head));
      rest = rest.drop_front(head == llvm::StringRef::npos ? rest.size() : head + 1);
    }
    while (!rest.empty()) {
      const size_t end = rest.find('\n');
      const llvm::StringRef line = rest.take_front(end == llvm::StringRef::npos ? end : end + 1);
      rest = rest.drop_front(line.size());
      if (piece.kind != PagePiece::Program || !isTestMark(line))
        text += line;
    }
  }
  return text;
}

} // namespace ncvet
