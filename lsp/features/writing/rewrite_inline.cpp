// A called program, written in the place of its call.
#include "analyzer/program/references.h"
#include "formats/readers/table_words.h"
#include "lsp/features/writing/new_lines.h"
#include "lsp/features/writing/rewriter.h"
#include "lsp/features/writing/rewritings.h"

namespace ncvet::lsp {

namespace {

class Inliner : Rewriter {
public:
  explicit Inliner(Selection &selection) : Rewriter(selection, "Write the called program here") {}

  Rewriting run() {
    if (dialect_.lexical.blocksSpanLines)
      result_.refused = "blocks of this control span lines";
    else if (findCall() && findProgram() && readBody())
      write();
    return finish();
  }

private:
  /// The one selected block with its one call, which is all that the block does.
  bool findCall() {
    if (selection_.blocks().size() != 1)
      return refuse("one block with a call is to be selected");
    call_ = &selection_.blocks().front();
    unsigned references = 0;
    FileUnit &unit = selection_.snapshot().unit();
    unit.references().all(*call_, selection_.snapshot().text(), [&](const Reference &one) {
      ++references;
      reference_ = one;
    });
    const bool isCall = references == 1 && reference_.kind == ReferenceKind::Call &&
                        reference_.to != ReferredKind::UntoldProgram &&
                        reference_.to != ReferredKind::UntoldBlock;
    if (!isCall)
      return refuse("the selected block does not call one program");
    const bool hasArguments = llvm::any_of(call_->items, [](const Item &item) {
      return item.kind != ItemKind::Call || item.arguments > 0 || item.modal;
    });
    if (hasArguments || call_->hasAny(selection_.dialect().axisWords) || call_->skip >= 0)
      return refuse("the block of the call does more than to call");
    if (reference_.runs < 1)
      return refuse("how often the program runs is not known");
    return true;
  }

  bool findProgram() {
    FileUnit &unit = selection_.snapshot().unit();
    if (reference_.to == ReferredKind::Block || reference_.to == ReferredKind::Label) {
      const ProgramInfo &own = unit.index.programAt(call_->begin);
      const auto at = resolveBlock(unit.index, own, reference_, call_->begin);
      if (!at)
        return refuse("the called block is not there");
      place_ = {&unit, &own, *at, 0};
      isLocal_ = true;
      return true;
    }
    const auto found = resolveProgram(selection_.snapshot().project(), unit, reference_);
    if (!found)
      return refuse("the called program is not found");
    place_ = *found;
    isLocal_ = reference_.to == ReferredKind::Subprogram;
    return true;
  }

  bool returns(const Block &block, const Word *&by) const {
    const Dialect &dialect = *place_.unit->dialect;
    for (const Word &word : block.words)
      if (const CodeIndex code = codeOf(dialect, word);
          code != noCode && dialect.codes[code].action == Action::Return) {
        by = &word;
        return true;
      }
    return llvm::any_of(block.items, [](const Item &item) {
      return item.kind == ItemKind::Structure &&
             (item.structure == Structure::EndSub || item.structure == Structure::Return);
    });
  }

  /// What of a block cannot be in another program, or not twice.
  bool fits(const Block &block) {
    bool named = false;
    place_.unit->references().all(block, place_.unit->source.text(), [&](const Reference &one) {
      named |= one.kind != ReferenceKind::Call || one.to == ReferredKind::Block ||
               one.to == ReferredKind::Label;
    });
    if (named)
      return refuse("a block of the called program names another one of it");
    for (const Item &item : block.items)
      if (item.kind == ItemKind::Parameters || item.kind == ItemKind::Definition ||
          item.kind == ItemKind::Declaration || item.kind == ItemKind::Macro)
        if (item.kind != ItemKind::Parameters || item.arguments > 0 || item.restores)
          return refuse("the called program has variables, parameters or modes of its own");
    return true;
  }

  /// The blocks of the called program up to the only one that returns.
  bool readBody() {
    if (place_.unit->dialect.get() != selection_.snapshot().unit().dialect.get())
      return refuse("the called program is one of another control");
    const llvm::StringRef text = place_.unit->source.text();
    Block block;
    for (uint32_t at = place_.begin; at < place_.program->end; at = block.next) {
      place_.unit->reader->read(at, block);
      if (block.kind == BlockKind::Tape)
        break;
      const Word *by = nullptr;
      if (!isClosed_ && returns(block, by)) {
        isClosed_ = true;
        if (!addRest(block, by))
          return false;
        if (isLocal_)
          break;
        continue;
      }
      if (block.isEmpty())
        continue;
      if (isClosed_)
        return refuse("the called program returns before its end");
      if (!fits(block))
        return false;
      const bool isHead = llvm::any_of(
          block.items, [](const Item &item) { return item.kind == ItemKind::Parameters; });
      if (!isHead)
        body_.push_back(bareText(text, block));
      if (body_.size() > mostNewBlocks)
        return refuse("there would be too many blocks");
    }
    return isClosed_ || refuse("the called program does not return");
  }

  /// Of the block that returns what else is in it.
  bool addRest(const Block &block, const Word *by) {
    if (!block.items.empty())
      return block.words.empty() && block.items.size() == 1
                 ? true
                 : refuse("the called program returns under a condition");
    if (block.words.size() == 1)
      return true;
    if (block.words.size() > 1 && by != &block.words.back())
      return refuse("the block that returns does more after that");
    Block without = block;
    without.end = by->offset;
    const std::string rest = bareText(place_.unit->source.text(), without);
    if (!fits(block))
      return false;
    body_.push_back(rest);
    return true;
  }

  void write() {
    const int64_t runs = place_.runs > 0 ? place_.runs : reference_.runs;
    if (runs * int64_t(body_.size()) > int64_t(mostNewBlocks)) {
      result_.refused = "there would be too many blocks";
      return;
    }
    if (body_.empty()) {
      result_.refused = "the called program is empty";
      return;
    }
    NewLines lines(selection_);
    for (int64_t run = 0; run < runs; ++run)
      for (const std::string &line : body_)
        lines.add(line);
    replaceBlocks(lines.text(result_.refused));
  }

  const Block *call_ = nullptr;
  Reference reference_;
  ReferredPlace place_;
  bool isLocal_ = false;  ///< a part of a program, which other parts may follow
  bool isClosed_ = false; ///< the block that returns was read
  std::vector<std::string> body_;
};

} // namespace

Rewriting inlineCall(Selection &selection) { return Inliner(selection).run(); }

} // namespace ncvet::lsp
