// A program writes data that later programs work with.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CoordinateOffsetTableWritten final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().machineData.empty())
      to.on(EventKind::Statement);
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind != EventKind::Statement)
      return ctx.reportNotices(id, event);
    const Item &item = ctx.block().items[size_t(event.number)];
    if (item.kind != ItemKind::Assignment)
      return;
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    const llvm::StringRef name = ctx.text(range);
    for (const std::string &data : ctx.dialect().machineData)
      if (name.startswith_insensitive(data))
        if (auto finding = ctx.report(range))
          finding.message("`{0}` stays as it is written here: every later program works with it",
                          name);
  }

private:
  static constexpr llvm::StringLiteral id{"coordinate-offset-table-written"};
};

} // namespace
NCVET_RULE(CoordinateOffsetTableWritten, coordinate_offset_table_written)
} // namespace ncvet
