// Switches of the machine that a program leaves on: what all the `…-left-on` rules share.
#include "analyzer/rule/switch_left_on.h"

#include "interp/state/any_state.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

namespace {

/// The block that switches `info` off, from the table's `off`: a block as text, or a code
/// "with zeros" or of a mirror, which takes each axis that may be on. Empty when the table names no
/// code of this control.
std::string offBlock(const SwitchInfo &info, uint16_t axes, const Dialect &dialect) {
  const llvm::StringRef name = llvm::StringRef(info.off).split(' ').first;
  const CodeIndex index = dialect.find(name);
  if (index == noCode) {
    // A call, an instruction or a word with its values: `TRANSLATE(0,0,0)`, `<DRA:0>`, `RNDM=0`.
    const bool call = dialect.find(name.split('(').first) != noCode;
    const bool instruction =
        name.contains(':') && dialect.find(name.split(':').first.str() + ">") != noCode;
    return call || instruction || name.contains('=') ? info.off : "";
  }
  std::string block = name.str();
  const bool perAxis = dialect.codes[index].action == Action::MirrorOff;
  if (!perAxis && !llvm::StringRef(info.off).contains("zero"))
    return info.off;
  bool any = false;
  for (unsigned letter = 0; letter < 26; ++letter) {
    const AddressInfo &address = dialect.addresses[letter];
    if (address.kind != AddressKind::Axis || !(axes >> unsigned(address.axis) & 1))
      continue;
    block += ' ';
    block += char('A' + letter);
    block += '0';
    any = true;
  }
  return any ? block : "";
}

/// Whether the tool was changed since the switch was turned on, by the text: that was told there.
bool isToldAtChange(unsigned index, const SwitchInfo &info, const MachineState &state) {
  const Origin &on = state.origin.ofSwitch(index), &tool = state.origin.of(StatePart::Tool);
  return info.atToolChange && on.known() && tool.known() && on.file == tool.file &&
         on.begin < tool.begin;
}

} // namespace

void listenForLeftOn(llvm::StringRef id, Subscriptions &to) {
  for (const SwitchInfo &info : to.dialect().switches)
    if (info.leftOn == id) {
      to.on(EventKind::ProgramEnd);
      if (info.atToolChange)
        to.on(EventKind::ToolChange);
    }
}

void reportLeftOn(llvm::StringRef id, const Event &event, RuleContext &ctx) {
  const bool toolChange = event.kind == EventKind::ToolChange;
  // The end of a called program is the caller's business: it may switch off what is on.
  if (!toolChange && (event.kind != EventKind::ProgramEnd || ctx.callDepth() > 0))
    return;
  const Dialect &dialect = ctx.dialect();
  llvm::SmallVector<unsigned, 4> left;
  bool certain = false;
  std::optional<Severity> severity;
  for (unsigned i = 0; i < dialect.switches.size() && i < maxSwitches; ++i) {
    const SwitchInfo &info = dialect.switches[i];
    if (info.leftOn != id || (toolChange && !info.atToolChange) ||
        isToldAtChange(i, info, toolChange ? ctx.before() : ctx.after()))
      continue;
    bool must = ctx.after().switchMustBeOn(i), may = ctx.after().switchMayBeOn(i);
    if (toolChange) {
      // Switched on in the block of the change itself: that is for the new tool.
      must &= ctx.before().switchMustBeOn(i);
      may &= ctx.before().switchMayBeOn(i);
    }
    // After a code that nobody knows everything may be on: only what is certain counts.
    if (!may || (!must && (ctx.after().may(Fact::UnknownCode) || anySwitchMayBeOn(ctx.after()) ||
                           !ctx.after().origin.ofSwitch(i).known())))
      continue;
    left.push_back(i);
    certain |= must;
    if (info.severity && (!severity || *info.severity > *severity))
      severity = info.severity;
  }
  if (left.empty())
    return;
  auto finding = ctx.report(event, certain && event.certain);
  if (!finding)
    return;
  std::string titles, blocks;
  for (const unsigned i : left) {
    const SwitchInfo &info = dialect.switches[i];
    if (!titles.empty())
      titles += i == left.back() ? " and " : ", ";
    titles += info.title;
    const std::string off = offBlock(info, ctx.after().switches.axesOf(unsigned(i)), dialect);
    if (!off.empty())
      blocks += (blocks.empty() ? "" : "\n") + off;
    finding.note(ctx.after().origin.ofSwitch(i), info.title + " is switched on here");
  }
  const std::string what = toolChange ? "the tool is changed" : "the program ends";
  finding.severity(severity).message("{0} with {1} still on", what, titles);
  if (!blocks.empty() && event.word) {
    std::string description = "insert ";
    llvm::SmallVector<llvm::StringRef, 4> lines;
    llvm::StringRef(blocks).split(lines, '\n');
    description += ("`" + llvm::Twine(llvm::join(lines, "`, `")) + "` before this block").str();
    finding.fix(FixSafety::Unsafe, description, ctx.insertBlockBefore(lines.front()));
    for (const llvm::StringRef line : llvm::drop_begin(lines))
      finding.edit(ctx.insertBlockBefore(line));
  }
}

} // namespace ncvet
