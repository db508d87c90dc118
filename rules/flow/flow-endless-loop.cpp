// A loop has no way out.
#include "analyzer/facts/called_blocks.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/expression.h"

#include <set>

namespace ncvet {
namespace {

struct FlowEndlessLoopMemory {
  std::set<std::pair<FileId, uint32_t>> seen;
};

class FlowEndlessLoop final : public StatefulRule<FlowEndlessLoopMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::FlowIssue, EventKind::Statement});
    restarts_ = to.dialect().facts->program.returnRestarts;
    ownFrom_ = uint64_t(to.number("controlsOwnFrom", 0));
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement) {
      const size_t index = event.item();
      const Item &item = ctx.block().items[index];
      if (item.kind == ItemKind::Structure ? !beginsLoop(item.structure)
                                           : item.kind != ItemKind::Jump)
        sleepAtBlock(); // unless it reads a variable
      if (item.kind == ItemKind::Structure && item.structure == Structure::While)
        return bracketed(item, ctx);
      if (item.kind == ItemKind::While && item.loop)
        return &item == &ctx.block().items.back() ? numbered(item, ctx) : void();
      if (item.kind == ItemKind::Structure &&
          (item.structure == Structure::Loop || item.structure == Structure::Repeat))
        return endedBelow(item, ctx);
      if (item.kind == ItemKind::Jump && index && ctx.block().items[index - 1].kind == ItemKind::If)
        return whileTrue(ctx.block().items[index - 1], item, ctx);
      return backwards(item, ctx);
    }
    if (event.flowIssue() != FlowIssue::EndlessLoop ||
        (restarts_ && ctx.outcome().flow.kind == FlowKind::Return) || goesOnInHead(ctx) ||
        waitsForOthers(ctx) || pauses(ctx) || asksControl(ctx))
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.message("this loop never ends: nothing in it changes what decides about leaving it");
  }

private:
  static bool beginsLoop(Structure structure) {
    return structure == Structure::While || structure == Structure::Loop ||
           structure == Structure::Repeat;
  }
  /// `N10` and `IF [#503 NE 0] GOTO 10`: over blocks that move nothing the program waits for who
  /// else writes a common variable, at the machine or beside it.
  static bool waitsForOthers(const RuleContext &ctx) {
    const Block &here = ctx.block();
    const Flow &flow = ctx.outcome().flow;
    if (flow.item < 1 || !flow.target.isConstant() ||
        here.items[size_t(flow.item) - 1].kind != ItemKind::If)
      return false;
    const std::set<uint64_t> read = variablesOf(here.items[size_t(flow.item) - 1], here);
    const auto to =
        resolveBlock(ctx.index(), ctx.index().programAt(here.begin),
                     Reference::toBlock(int64_t(flow.target.number.value())), here.begin);
    if (read.empty() || !to || *to > here.begin || here.begin - *to > readable ||
        llvm::any_of(read, [](uint64_t key) { return key < firstCommon; }))
      return false;
    for (const Block &block : blocks(ctx.index(), *to, here.begin))
      if (block.hasAny(ctx.dialect().axisWords) || !block.items.empty())
        return false;
    return true;
  }
  /// `GOTOB` over a dwell, a stop or a question to the machine, and nothing that moves: the program
  /// waits.
  static bool pauses(const RuleContext &ctx) {
    const Block &here = ctx.block();
    const Flow &flow = ctx.outcome().flow;
    if (flow.item < 0 || here.items[size_t(flow.item)].kind != ItemKind::Jump)
      return false;
    const Item &jump = here.items[size_t(flow.item)];
    const auto targets = here.argumentsOf(jump);
    const auto to = targets.size() == 1 ? blockNamed(ctx.index(), here, jump, targets[0])
                                        : std::optional<uint32_t>();
    if (!to || *to > here.begin || here.begin - *to > readable)
      return false;
    bool stays = false;
    for (const Block &block : blocks(ctx.index(), *to, here.begin)) {
      if (block.hasAny(ctx.dialect().axisWords) && !findCode(ctx.dialect(), block, {Action::Dwell}))
        return false;
      stays |= findCode(ctx.dialect(), block,
                        {Action::Dwell, Action::ProgramStop, Action::OptionalStop}) ||
               asksMachine(block, ctx);
    }
    return stays;
  }
  /// `IF $A_IN[4]==0`: what a variable of the control holds changes from outside.
  static bool asksMachine(const Block &block, const RuleContext &ctx) {
    return llvm::any_of(block.items, [&](const Item &item) {
      return item.condition != noExpression &&
             ctx.source().text(block.begin, block.end).split(';').first.contains('$');
    });
  }
  static constexpr uint64_t firstCommon = 100; ///< those before are the program's own

  /// The head looks at a variable of the control, which was given a value before the loop.
  bool asksControl(const RuleContext &ctx) const {
    Block head;
    readBlockAt(ctx.source(), ctx.index().reader(), ctx.flowRange().begin, head);
    return llvm::any_of(head.items, [&](const Item &item) {
      return item.condition != noExpression && isOfControl(variablesOf(item, head));
    });
  }

  /// Whether statements follow in the block that begins the loop: not all controls run them, and
  /// those that do may change there what decides.
  static bool goesOnInHead(const RuleContext &ctx) {
    Block head;
    readBlockAt(ctx.source(), ctx.index().reader(), ctx.flowRange().begin, head);
    return !head.items.empty() && head.items.back().kind != ItemKind::While &&
           llvm::any_of(head.items, [](const Item &one) { return one.kind == ItemKind::While; });
  }

  uint64_t ownFrom_ = 0;  ///< the first number of a variable of the control; 0: not known
  bool restarts_ = false; ///< a return code of a main program begins the next part

  /// A choice that leads back, over blocks that write nothing of what it looks at and lead nowhere
  /// else.
  void backwards(const Item &item, RuleContext &ctx) const {
    const Block &here = ctx.block();
    if (item.kind != ItemKind::Jump || item.jump != JumpKind::BySign || here.skip >= 0 ||
        item.nameEnd > item.nameBegin || item.condition == noExpression ||
        !memory().seen.insert({ctx.source().id(), item.begin}).second)
      return;
    const std::set<uint64_t> read = variablesOf(item, here);
    std::optional<uint32_t> back;
    const auto targets = here.argumentsOf(item);
    // Where the value is known the loop is run for real.
    if (evaluate(here, item.condition, ctx.before(), nullptr).isConstant())
      return;
    for (const Argument &target : targets) {
      if (const auto to = blockNamed(ctx.index(), here, item, target); to && *to < here.begin)
        back = std::max(back.value_or(0), *to); // the shortest way back
    }
    if (!back)
      return heads(item, ctx);
    if (read.empty() || here.begin - *back > readable)
      return;
    for (const Block &block : blocks(ctx.index(), *back, here.begin))
      if (!leavesAlone(block, read, ctx))
        return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.message(
          "`{0}`: once it leads back it always does, nothing on the path changes what it "
          "looks at",
          ctx.text(range));
  }

  /// Whether the block goes on with the next one and changes none of the variables, nor does a
  /// program that it calls.
  static bool leavesAlone(const Block &block, const std::set<uint64_t> &read, RuleContext &ctx) {
    bool calls = false;
    for (const Item &inner : block.items) {
      if (inner.kind != ItemKind::Assignment && inner.kind != ItemKind::Call)
        return false;
      calls |= inner.kind == ItemKind::Call;
    }
    return !mayChange(block, read, ctx) &&
           (!calls || eachCalledBlock(ctx.unit(), block, [&](const Block &called) {
             return !mayWrite(called, read) &&
                    !findCode(ctx.dialect(), called,
                              {Action::ProgramEnd, Action::ProgramEndRewind, Action::ProgramStop,
                               Action::OptionalStop});
           }));
  }

  /// A choice at the head of a loop that a plain jump closes, one of whose targets is the body.
  void heads(const Item &item, RuleContext &ctx) const {
    const Block &here = ctx.block();
    const std::set<uint64_t> read = variablesOf(item, here);
    if (read.empty() || evaluate(here, item.condition, ctx.before(), nullptr).isConstant())
      return;
    std::optional<uint32_t> body;
    for (const Argument &target : here.argumentsOf(item))
      if (const auto to = blockNamed(ctx.index(), here, item, target); to && *to > here.begin)
        body = std::min(body.value_or(~0u), *to); // the nearest one
    if (!body || *body - here.begin > readable)
      return;
    const uint32_t end = std::min(ctx.index().programAt(here.begin).end, *body + readable);
    bool closed = false;
    for (const Block &block : blocks(ctx.index(), *body, end)) {
      const Item *jump = block.items.size() == 1 ? &block.items.front() : nullptr;
      if (jump && jump->kind == ItemKind::Jump && jump->jump == JumpKind::Anywhere &&
          jump->condition == noExpression && jump->arguments == 1 && block.skip < 0) {
        const auto to = blockNamed(ctx.index(), block, *jump, block.argumentsOf(*jump)[0]);
        closed = to == here.begin;
        break;
      }
      if (!leavesAlone(block, read, ctx))
        return;
    }
    if (!closed)
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.message("`{0}`: once the loop runs it never ends, nothing in it changes what this "
                      "looks at",
                      ctx.text(range));
  }

  /// The variables that the condition at the head of a loop looks at, asked once for each; empty
  /// where they are none, where what they say is known, or where the program has given them no
  /// value: then they may change from outside.
  std::set<uint64_t> lookedAtByHead(const Item &item, RuleContext &ctx) const {
    const Block &here = ctx.block();
    if (item.condition == noExpression ||
        !memory().seen.insert({ctx.source().id(), item.begin}).second ||
        evaluate(here, item.condition, ctx.before(), nullptr).isConstant())
      return {};
    std::set<uint64_t> read = variablesOf(item, here);
    const ProgramInfo &program = ctx.index().programAt(here.begin);
    if (!read.empty() && (isOfControl(read) || !givenBefore(read, program, here, ctx)))
      read.clear();
    return read;
  }

  /// One of them is the control's own: a clock, an input, a position, which change by themselves.
  bool isOfControl(const std::set<uint64_t> &read) const {
    constexpr uint64_t programs = 10000; // from here on they are the program's again
    return ownFrom_ &&
           llvm::any_of(read, [&](uint64_t key) { return key >= ownFrom_ && key < programs; });
  }

  /// A WHILE over blocks that write nothing of what its condition looks at and do not leave.
  void bracketed(const Item &item, RuleContext &ctx) const {
    const Block &here = ctx.block();
    const std::set<uint64_t> read = lookedAtByHead(item, ctx);
    if (read.empty())
      return;
    const ProgramInfo &program = ctx.index().programAt(here.begin);
    unsigned depth = 0;
    const uint32_t end = std::min(program.end, here.begin + readable);
    for (const Block &block : blocks(ctx.index(), here.next, end)) {
      if (mayChange(block, read, ctx))
        return;
      for (const Item &inner : block.items) {
        if (inner.kind == ItemKind::Structure && inner.structure == Structure::While) {
          ++depth;
        } else if (inner.kind == ItemKind::Structure && inner.structure == Structure::EndWhile) {
          if (depth-- == 0) {
            const SourceRange range = ctx.range(item);
            if (auto finding = ctx.report(range))
              finding.message("`{0}`: once the loop runs it never ends, nothing in it changes what "
                              "it looks at",
                              ctx.text(range));
            return;
          }
        } else if (inner.kind != ItemKind::Assignment && inner.kind != ItemKind::Structure) {
          return;
        } else if (inner.kind == ItemKind::Structure && inner.structure == Structure::For &&
                   read.count(block.keyOf(inner.target))) {
          return;
        }
      }
    }
  }

  /// The same of a loop with a number, reported at its end.
  void numbered(const Item &item, RuleContext &ctx) const {
    const Block &here = ctx.block();
    const std::set<uint64_t> read = lookedAtByHead(item, ctx);
    if (read.empty())
      return;
    const ProgramInfo &program = ctx.index().programAt(here.begin);
    const uint32_t end = std::min(program.end, here.begin + readable);
    for (const Block &block : blocks(ctx.index(), here.next, end)) {
      for (const Item &inner : block.items)
        if (inner.kind == ItemKind::End && inner.loop == item.loop) {
          const SourceRange range = ctx.range(inner);
          if (auto finding = ctx.report(range))
            finding.message("`{0}`: once the loop runs it never ends, nothing in it changes what "
                            "its head looks at",
                            ctx.text(range));
          return;
        }
      if (!leavesAlone(block, read, ctx))
        return;
    }
  }

  /// LOOP, and REPEAT with its condition in UNTIL, over blocks that do not leave and write nothing
  /// of what the condition looks at. Where that is known the value says whether it runs again.
  void endedBelow(const Item &item, RuleContext &ctx) const {
    const Block &here = ctx.block();
    if (item.label || here.items.size() != 1 ||
        !memory().seen.insert({ctx.source().id(), item.begin}).second)
      return;
    const ProgramInfo &program = ctx.index().programAt(here.begin);
    // The end first: it holds the condition.
    Block block;
    unsigned depth = 0;
    uint32_t end = here.next;
    for (bool found = false; !found; end = block.next) {
      if (end >= program.end || end - here.begin > readable)
        return;
      ctx.index().read(end, block);
      if (block.next <= end)
        return;
      for (const Item &inner : block.items) {
        if (inner.kind != ItemKind::Structure)
          continue;
        depth += opensBracket(inner.structure);
        if (depth > deepest)
          return;
        if (closesBracket(inner.structure) && depth-- == 0) {
          if (inner.structure !=
              (item.structure == Structure::Loop ? Structure::EndLoop : Structure::Until))
            return;
          found = true;
          break;
        }
      }
      if (found)
        break;
    }
    std::set<uint64_t> read;
    if (item.structure == Structure::Repeat) {
      const Item &until = block.items.front();
      if (until.condition == noExpression || block.expressions[until.condition].bad)
        return;
      read = variablesOf(until, block);
      const Value holds = evaluate(block, until.condition, ctx.after(), nullptr);
      if (read.empty() || (holds.isConstant() ? truthOf(holds) != Truth::No
                                              : !givenBefore(read, program, here, ctx)))
        return;
    }
    if (!staysInside(here.next, end, read, ctx))
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range)) {
      finding.message(
          read.empty() ? "`{0}`: nothing in the loop leads out of it, it never ends"
                       : "`{0}`: nothing in the loop changes what its end looks at, it never ends",
          ctx.text(range));
      // Bar work and running in move; a loop that only computes hangs the control.
      if (!moves(here.next, end, ctx))
        finding.severity(Severity::Warning);
    }
  }

  static bool moves(uint32_t from, uint32_t end, const RuleContext &ctx) {
    for (const Block &block : blocks(ctx.index(), from, end))
      if (axesOf(ctx.dialect(), block) || block.hasAny(ctx.dialect().axisWords) ||
          !codesOf(ctx.dialect(), block).empty())
        return true;
    return false;
  }

  /// `IF R1<5 GOTOB AGAIN` over blocks that do not leave and write nothing of what it looks at.
  void whileTrue(const Item &condition, const Item &item, RuleContext &ctx) const {
    const Block &here = ctx.block();
    if (condition.condition == noExpression || item.arguments != 1 || here.skip >= 0 ||
        item.nameEnd > item.nameBegin || item.jump == JumpKind::Forward || here.items.size() != 2 ||
        !memory().seen.insert({ctx.source().id(), item.begin}).second)
      return;
    const auto back = blockNamed(ctx.index(), here, item, here.argumentsOf(item)[0]);
    if (!back || *back >= here.begin || here.begin - *back > readable)
      return;
    if (entersBracket(*back, here.begin, ctx)) // another rule's matter
      return;
    const std::set<uint64_t> read = variablesOf(condition, here);
    const Value holds = evaluate(here, condition.condition, ctx.before(), nullptr);
    if (read.empty() ||
        (holds.isConstant() ? truthOf(holds) != Truth::Yes
                            : !givenBefore(read, ctx.index().programAt(here.begin), here, ctx)) ||
        !staysInside(*back, here.begin, read, ctx))
      return;
    if (auto finding = ctx.report(ctx.range(here)))
      finding.message("`{0}`: once it leads back it always does, nothing on the path changes what "
                      "its condition looks at",
                      ctx.text(SourceRange{ctx.source().id(), condition.begin, item.end}));
  }

  /// Whether a bracket of structured flow ends between two places that began before them.
  static bool entersBracket(uint32_t from, uint32_t end, const RuleContext &ctx) {
    int depth = 0;
    for (const Block &block : blocks(ctx.index(), from, end)) {
      for (const Item &inner : block.items) {
        if (inner.kind != ItemKind::Structure)
          continue;
        depth += opensBracket(inner.structure) - closesBracket(inner.structure);
        if (depth < 0)
          return true;
      }
    }
    return false;
  }

  /// Whether the program gives each of the variables a value before the block: others may be
  /// changed from outside.
  static bool givenBefore(const std::set<uint64_t> &read, const ProgramInfo &program,
                          const Block &here, const RuleContext &ctx) {
    if (here.begin - program.body > readable)
      return false;
    std::set<uint64_t> given;
    for (const Block &block : blocks(ctx.index(), program.body, here.begin)) {
      for (const Item &other : block.items)
        if (other.kind == ItemKind::Assignment || other.kind == ItemKind::Definition)
          given.insert(block.keyOf(other.target));
    }
    return llvm::all_of(read, [&](uint64_t key) { return given.count(key) != 0; });
  }

  /// Whether the blocks of [from, end) hold no way out and write none of the variables. A call may
  /// do either.
  static bool staysInside(uint32_t from, uint32_t end, const std::set<uint64_t> &read,
                          const RuleContext &ctx) {
    for (const Block &block : blocks(ctx.index(), from, end)) {
      if (!block.issues.empty() || mayChange(block, read, ctx))
        return false;
      for (const Item &inner : block.items) {
        const bool counts = inner.kind == ItemKind::Structure &&
                            inner.structure == Structure::For &&
                            read.count(block.keyOf(inner.target));
        const bool writes = inner.kind == ItemKind::Instruction &&
                            llvm::any_of(block.argumentsOf(inner), [&](const Argument &argument) {
                              return argument.expression != noExpression &&
                                     read.count(block.variableOf(argument.expression));
                            });
        if (counts || writes ||
            (inner.kind != ItemKind::Assignment && inner.kind != ItemKind::Structure &&
             inner.kind != ItemKind::Instruction && inner.kind != ItemKind::Output))
          return false;
      }
      // A code without an entry is the machine builder's: it may end the program.
      for (const Word &word : block.words)
        if ((word.address == letterAddress('M') || word.address == letterAddress('G')) &&
            codeOf(ctx.dialect(), word) == noCode)
          return false;
    }
    return true;
  }

  /// The variables that decide; empty when something else decides as well.
  static std::set<uint64_t> variablesOf(const Item &item, const Block &block) {
    std::set<uint64_t> read;
    if (item.condition >= block.expressions.size())
      return read;
    const Expression &condition = block.expressions[item.condition];
    for (uint32_t i = 0; i < condition.count; ++i) {
      const ExpressionOp &op = block.operations[condition.first + i];
      if (op.op == Op::Variable)
        read.insert(uint64_t(op.value));
      else if (op.op == Op::Opaque || op.op == Op::VariableAt || op.op == Op::ElementAt ||
               op.op == Op::Unknown)
        return {};
    }
    return read;
  }

  /// Whether a block of the loop may write one of the variables, or leave it.
  static bool mayWrite(const Block &block, const std::set<uint64_t> &read) {
    return llvm::any_of(block.items, [&](const Item &inner) {
      return inner.kind == ItemKind::Input ||
             (inner.kind == ItemKind::Assignment &&
              (read.count(block.keyOf(inner.target)) || !block.keyOf(inner.target)));
    });
  }
  static bool mayChange(const Block &block, const std::set<uint64_t> &read,
                        const RuleContext &ctx) {
    if (mayWrite(block, read))
      return true;
    // The condition may read what a code of the control leaves.
    return block.skip >= 0 ||
           findCode(ctx.dialect(), block,
                    {Action::Return, Action::ProgramEnd, Action::ProgramEndRewind,
                     Action::ProgramStop, Action::OptionalStop}) ||
           llvm::any_of(codesOf(ctx.dialect(), block), [&](CodeIndex code) {
             return llvm::any_of(ctx.dialect().codes[code].stores, [&](const Store &store) {
               return !store.list.empty() || read.count(store.variable);
             });
           });
  }

  static constexpr uint32_t readable = 1u << 16; ///< bytes of a loop that are looked at
  /// Brackets in a loop's body, one in the other: no control takes more, and each of them would be
  /// read once for every loop round it.
  static constexpr unsigned deepest = 32;
};

} // namespace
NCVET_RULE(FlowEndlessLoop, flow_endless_loop)
} // namespace ncvet
