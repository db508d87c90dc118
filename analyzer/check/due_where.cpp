// Findings that are due in some texts only: what a text programs at all, by one look through it.
#include "analyzer/check/due_where.h"

#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule_page.h"

namespace ncvet {

namespace {

/// What a text programs; read on until all that is asked for was met.
class Traits {
public:
  Traits(const FileUnit &unit) : unit_(unit) {}

  bool has(uint8_t wanted) {
    if ((found_ & wanted) != wanted && !read_)
      read();
    return (found_ & wanted) == wanted;
  }

private:
  static constexpr uint8_t all = programsSpindle | programsThreeAxes;
  static constexpr uint16_t threeAxes =
      1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y) | 1u << unsigned(Axis::Z);

  void read() {
    read_ = true;
    for (const Block &block : blocks(*unit_.reader)) {
      look(block);
      if (found_ == all)
        return;
    }
  }

  void look(const Block &block) {
    const Dialect &dialect = *unit_.dialect;
    for (const Word &word : block.words) {
      const AddressInfo &address = dialect.addresses[word.address];
      if (address.unit == AddressUnit::Speed || word.address == letterAddress('S'))
        found_ |= programsSpindle;
      if (address.kind == AddressKind::Axis || address.kind == AddressKind::Increment)
        axes_ |= uint16_t(1u << unsigned(address.axis));
    }
    if ((axes_ & threeAxes) == threeAxes)
      found_ |= programsThreeAxes;
    if (findCode(dialect, block,
                 {Action::SpindleCw, Action::SpindleCcw, Action::SpindleStop, Action::LiveToolCw,
                  Action::LiveToolCcw, Action::LiveToolStop, Action::AxisEngage,
                  Action::ToolChange}))
      found_ |= programsSpindle;
  }

  const FileUnit &unit_;
  uint16_t axes_ = 0;
  uint8_t found_ = 0;
  bool read_ = false;
};

} // namespace

void dropUndue(Project &project, const FileUnit &unit, std::vector<Finding> &findings) {
  std::map<FileId, Traits> traits;
  const auto has = [&](const FileUnit &text, uint8_t wanted) {
    return traits.try_emplace(text.source.id(), text).first->second.has(wanted);
  };
  llvm::erase_if(findings, [&](const Finding &finding) {
    // What is more than style has another proof than the axes that the text names.
    const uint8_t wanted = rulePage(finding.rule).dueWhere &
                           (finding.severity == Severity::Style ? 0xFF : ~programsThreeAxes);
    return wanted && !has(unit, wanted) &&
           !has(project.unit(project.sources().get(finding.range.file)), wanted);
  });
}

} // namespace ncvet
