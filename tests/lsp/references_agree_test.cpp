// What the engine follows is where the editor goes: every call and jump of the page programs.
#include "analyzer/flow/engine.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"
#include "lsp/features/navigation/definition.h"
#include "tests/support/marked_text.h"
#include "tests/support/rule_pages.h"

#include "gtest/gtest.h"

namespace {

using namespace ncvet;
using namespace ncvet::lsp;

/// Follows a program, and looks up the names of each block that calls or jumps.
class Agreement final : public FlowListener {
public:
  explicit Agreement(Snapshot &snapshot) : snapshot_(snapshot) {}

  FlowInterest interest() const override {
    FlowInterest interest;
    interest.everyBlock = interest.onePath = true;
    return interest;
  }
  void executed(const Step &step, bool) override {
    if (leaves_)
      compare(step.unit(), step.block);
    // Calls in the data of a contour are not followed.
    leaves_ = goesElsewhere(step.outcome.flow) && step.before.profile == ProfileMode::Off;
    if (!leaves_)
      return;
    from_ = &step.unit();
    block_ = step.block;
  }
  void pathLost(SourceRange, llvm::StringRef) override { leaves_ = false; }

  unsigned compared = 0;
  std::string apart; ///< blocks from which the two go to different places

private:
  static bool goesElsewhere(const Flow &flow) {
    switch (flow.kind) {
    case FlowKind::Call:
    case FlowKind::CallLocal:
    case FlowKind::CallNamed:
      return true;
    case FlowKind::Jump:
      return flow.condition == Truth::Yes;
    default:
      return false;
    }
  }

  /// The next block that is executed is `block`.
  void compare(const FileUnit &unit, const Block &block) {
    bool named = false;
    for (const Occurrence &one : snapshot_.names(*from_).within(block_.begin, block_.next)) {
      if (one.use != NameUse::Call && one.use != NameUse::Jump)
        continue;
      named = true;
      if (leadsTo(one, unit, block)) {
        ++compared;
        return;
      }
    }
    if (named) // else only the run knows what is meant
      apart += from_->source.text(block_.begin, block_.end).str() + " -> " +
               unit.source.text(block.begin, block.end).str() + "\n";
  }

  bool leadsTo(const Occurrence &one, const FileUnit &unit, const Block &block) {
    const auto target = targetOf(snapshot_, *from_, one);
    if (!target || target->unit != &unit)
      return false;
    if (one.kind == NameKind::Program)
      return target->program == &unit.index.programAt(block.begin);
    Block at;
    readBlockAt(unit.source, *unit.reader, target->name.begin, at);
    while (at.begin < block.begin && (at.isEmpty() || one.kind == NameKind::Subprogram)) {
      if (at.next > block.begin)
        return false;
      unit.reader->read(at.next, at);
    }
    return at.begin == block.begin;
  }

  Snapshot &snapshot_;
  bool leaves_ = false;
  FileUnit *from_ = nullptr;
  Block block_; ///< the one before
};

std::string definedAt(const char *dialect, llvm::StringRef program) {
  const auto text = test::markedText(dialect, program);
  const auto place = definition(*text, text.marks[0]);
  return place ? text->source().displayLine(text->source().position(place->name.begin).line) : "";
}

TEST(ReferencesAgree, OfAChoiceHaveADirectionEach) {
  EXPECT_EQ(definedAt("sinumerik", "A1: G0\nCASE(R1) OF 1 GOTOB A<|>1\nA1: G1\n"), "A1: G0");
  EXPECT_EQ(definedAt("sinumerik", "A1: G0\nCASE(R1) OF 1 GOTOF A<|>1\nA1: G1\n"), "A1: G1");
}

TEST(ReferencesAgree, OfStoredProgramsAreTheirNames) {
  EXPECT_EQ(definedAt("sinumerik", "%_N_A_MPF\nCALL \"_N_HO<|>LE_SPF\"\nM30\n%_N_HOLE_SPF\nM17\n"),
            "%_N_HOLE_SPF");
}

/// Whether blocks of a text call or jump: the others need not be followed.
bool leadsSomewhere(const Dialect &dialect, const std::string &text) {
  const auto reader = makeReader(dialect, text);
  const ReferenceReader references(dialect);
  bool leads = false;
  Block block;
  for (uint32_t at = reader->first(); at < text.size() && !leads; at = block.next) {
    reader->read(at, block);
    references.all(block, text, [&](const Reference &) { leads = true; });
  }
  return leads;
}

TEST(ReferencesAgree, LeadWhereTheEngineGoes) {
  std::map<std::string, std::unique_ptr<Session>> sessions;
  std::map<std::string, unsigned> compared;
  for (const test::PageProgram &program : test::allPagePrograms()) {
    if (!leadsSomewhere(*test::dialectNamed(program.dialect), program.files[0].text))
      continue;
    auto &session = sessions[program.dialect];
    if (!session) {
      SessionOptions options;
      options.dialect = program.dialect;
      session = std::make_unique<Session>(std::move(options));
    }
    const test::TemporaryFolder folder;
    for (const test::ProgramFile &file : program.files)
      std::ofstream(folder.path() / file.name, std::ios::binary) << file.text;
    const std::string path = (folder.path() / program.files[0].name).string();
    auto snapshot = Snapshot::make(*session, nullptr, path,
                                   std::make_shared<const std::string>(program.files[0].text));
    ASSERT_TRUE(bool(snapshot)) << llvm::toString(snapshot.takeError());
    Agreement agreement(**snapshot);
    const AnalysisLimits limits;
    Engine engine((*snapshot)->project(), (*snapshot)->unit(), limits, nullptr);
    engine.listen(agreement);
    engine.follow();
    EXPECT_EQ(agreement.apart, "") << program.name();
    compared[program.dialect] += agreement.compared;
  }
  for (const char *dialect : {"fanuc-0m", "fanuc-0t", "haas-lathe", "nct-104m", "nct-104t", "ecs",
                              "sinumerik", "linuxcnc"})
    EXPECT_GT(compared[dialect], 0u) << dialect;
}

} // namespace
