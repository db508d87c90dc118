// Tables of FANUC, NCT and DIN 66025: which control has which code, and what it means there.
#include "formats/dialect/loader.h"
#include "formats/readers/select/make_reader.h"
#include "interp/execute/execute.h"

#include "llvm/Support/Regex.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

const char *const controls[] = {"din66025", "fanuc-0t", "fanuc-0m", "nct-104t", "nct-104m"};

std::shared_ptr<const Dialect> table(llvm::StringRef id) {
  auto dialect = loadDialect(id, builtinDialects());
  if (dialect)
    return *dialect;
  ADD_FAILURE() << llvm::toString(dialect.takeError());
  return nullptr;
}

bool isFree(const Condition &when) {
  return !when.has && !when.any && !when.lacks && when.active.empty() && when.with.empty() &&
         when.without.empty() && when.withCode.empty() && when.withoutCode.empty() && !when.first &&
         !when.pending && when.options.empty() && when.broken.empty();
}

/// A code is in the table of a control that lacks it only to say so.
bool has(const Dialect &dialect, llvm::StringRef name) {
  const CodeIndex index = dialect.find(name);
  if (index == noCode)
    return false;
  for (const Notice &notice : dialect.codes[index].notices)
    if (notice.rule == "block-code-not-on-control" && isFree(notice.when))
      return false;
  return true;
}

/// Runs blocks one by one and tells what their codes meant.
class Control {
public:
  explicit Control(llvm::StringRef id) : dialect_(table(id)), state_(initialState(*dialect_)) {}

  Control &option(llvm::StringRef name, llvm::StringRef value) {
    machine_.options[name] = value.str();
    return *this;
  }
  Control &run(std::initializer_list<llvm::StringRef> blocks) {
    for (llvm::StringRef text : blocks)
      execute(text);
    return *this;
  }
  /// The entry that `code` of the block means.
  CodeInfo meaning(llvm::StringRef code, llvm::StringRef text) {
    execute(text);
    const CodeIndex base = dialect_->find(code);
    for (const CodeUse &use : outcome_.codes)
      if (dialect_->codes[use.code].base == base)
        return dialect_->codes[use.code];
    ADD_FAILURE() << code.str() << " is not in the block " << text.str();
    return {};
  }
  std::string group(const CodeInfo &code) const {
    return code.group == noGroup ? "" : dialect_->groups[code.group].id;
  }
  /// Rules of the notices that hold for the codes of the block.
  std::vector<std::string> notices(llvm::StringRef text) {
    const MachineState before = state_;
    execute(text);
    const ConditionContext context{*dialect_, machine_, block_, outcome_.codes, before};
    std::vector<std::string> rules;
    for (const CodeUse &use : outcome_.codes) {
      const CodeInfo &code = dialect_->codes[use.code];
      for (const Notice &notice : code.notices)
        if (holds(notice.when, &code, context))
          rules.push_back(notice.rule);
    }
    return rules;
  }
  const Dialect &dialect() const { return *dialect_; }

private:
  void execute(llvm::StringRef text) {
    text_ = text.str() + "\n";
    makeReader(*dialect_, text_)->read(0, block_);
    const MachineState before = state_;
    Executor(*dialect_, machine_, 0).execute(block_, before, state_, outcome_);
  }

  std::shared_ptr<const Dialect> dialect_;
  MachineProfile machine_;
  MachineState state_;
  std::string text_;
  Block block_;
  Outcome outcome_;
};

/// One row of the reference's tables. A letter per control, in the order D FT FM NT NM: `+` the
/// control has the code, `-` it lacks the code, `.` the reference says nothing.
struct Row {
  const char *codes, *columns;
};

constexpr Row rows[] = {
    {"G00 G01 G02 G03 G04", "+++++"},
    {"G06 G34 G35", "+.-.."},
    {"G08 G09 G61 G62 G63 G64", "+..--"},
    {"G15 G16 G38 G39", "-..++"},
    {"G17 G18 G19 G40 G41 G42", "+++++"},
    {"G20 G21 G22 G23", "-++++"},
    {"G32", "-+.--"},
    {"G33", "+--++"},
    {"G43 G44", "+.+.+"},
    {"G49", "..+.+"},
    {"G50 G51 G50.1 G51.1 G52 G68 G69", "-++++"},
    {"G50.2 G51.2", "...+."},
    {"G53", "+++++"},
    {"G54 G55 G56 G57 G58 G59", "+++++"},
    {"G70 G71", "++-+-"},
    {"G72", "-+-+-"},
    {"G73", "-++++"},
    {"G74", "+++++"},
    {"G75 G77 G79", "-+-+-"},
    {"G76", "-++++"},
    {"G78", "-+-+-"},
    {"G80 G81 G82 G83 G84 G85 G86 G87 G88 G89", "+++++"},
    {"G83.1", "---++"},
    {"G83.3", "---+-"},
    {"G84.2 G84.3", "-++++"},
    {"G90 G92 G94 G95", "+++++"},
    {"G91", "+-+++"},
    {"G96 G97", "+++++"},
    {"G98 G99", "-++++"},
    {"G12", "....-"},
    {"M00 M01 M02 M03 M04 M05 M06 M07 M08 M09 M19 M30", "+++++"},
    {"M10", "+...."},
    {"M11 M17", "+++++"},
    {"M12 M13 M14 M15 M16 M18", ".++++"},
    {"M31", "...+."},
    {"M40 M41 M42 M43 M44 M45 M48 M49 M50 M51 M55 M56 M58 M59 M60 M61 M62", "+...."},
    {"M71 M72 M73 M74 M75 M76 M77 M78 M80 M81 M84 M85", "+...."},
    {"M77", "...--"},
    {"M96 M97 M98 M99", "-++++"},
};

TEST(FanucNctTables, EachControlHasTheCodesOfItsColumn) {
  for (size_t control = 0; control < std::size(controls); ++control) {
    auto dialect = table(controls[control]);
    ASSERT_TRUE(dialect);
    for (const Row &row : rows) {
      llvm::SmallVector<llvm::StringRef, 16> names;
      llvm::StringRef(row.codes).split(names, ' ');
      const char mark = row.columns[control];
      // M31 is known, but with a remark that the machine's builder chose it.
      for (llvm::StringRef name : names)
        if (mark != '.') {
          EXPECT_EQ(has(*dialect, name), mark == '+') << name.str() << " on " << dialect->id;
        }
    }
  }
}

TEST(FanucNctTables, EveryCodeHasATitleAndASource) {
  for (const char *control : controls) {
    auto dialect = table(control);
    ASSERT_TRUE(dialect);
    for (const CodeInfo &code : dialect->codes) {
      EXPECT_FALSE(code.title.empty()) << code.name << " on " << control;
      EXPECT_FALSE(code.source.empty()) << code.name << " on " << control;
    }
  }
}

TEST(FanucNctTables, EveryDetectionMarkIsARegularExpression) {
  for (const char *control : controls) {
    auto dialect = table(control);
    ASSERT_TRUE(dialect);
    EXPECT_FALSE(dialect->detect.empty()) << control;
    for (const DetectMark &mark : dialect->detect) {
      std::string problem;
      EXPECT_TRUE(llvm::Regex(mark.pattern).isValid(problem)) << mark.pattern << ": " << problem;
    }
  }
}

TEST(FanucNctTables, TheSameNumberIsAnotherCycleOnLatheAndMill) {
  EXPECT_EQ(Control("nct-104t").meaning("G73", "G73 P10 Q20 U1 W1").cycle,
            CycleKind::PatternRepeat);
  EXPECT_EQ(Control("nct-104m").meaning("G73", "G73 Z-9 R1 Q2").cycle, CycleKind::ChipBreak);
  EXPECT_EQ(Control("nct-104t").meaning("G74", "G74 Z-9 Q2").cycle, CycleKind::GrooveFace);
  EXPECT_EQ(Control("nct-104m").meaning("G74", "G74 Z-9 R1").cycle, CycleKind::TapLeft);
  EXPECT_EQ(Control("din66025").meaning("G74", "G74 X0").action, Action::ReferenceReturn);
  EXPECT_EQ(Control("nct-104t").meaning("G76", "G76 X18 Z-16 P0.9 Q0.3 F1.5").cycle,
            CycleKind::ThreadMulti);
  EXPECT_EQ(Control("nct-104t").meaning("G76", "G76 X0 I0.2 J0 Z-20 R1 F0.1").cycle,
            CycleKind::FineBore);
  EXPECT_EQ(Control("nct-104m").meaning("G76", "G76 X5 I0.2 J0 Z-20 R1 F80").cycle,
            CycleKind::FineBore);
  EXPECT_EQ(Control("din66025").meaning("G70", "G70").action, Action::Inch);
  EXPECT_EQ(Control("nct-104t").meaning("G70", "G70 P1 Q2").cycle, CycleKind::Finish);
}

TEST(FanucNctTables, AG92WithSLimitsTheSpindle) {
  Control lathe("nct-104t");
  EXPECT_EQ(lathe.meaning("G92", "G92 S3000").action, Action::SpeedLimit);
  EXPECT_EQ(lathe.meaning("G92", "G92 X50 Z40").action, Action::PresetPosition);
  Control fanuc("fanuc-0t");
  EXPECT_EQ(fanuc.meaning("G92", "G92 S3000").action, Action::SpeedLimit);
  EXPECT_EQ(fanuc.meaning("G92", "G92 X50 Z40").action, Action::PresetPosition);
  EXPECT_EQ(fanuc.meaning("G92", "G92 X19 Z-20 F1.5").cycle, CycleKind::ThreadPass);
  EXPECT_EQ(fanuc.meaning("G92", "G92 X18.5").cycle, CycleKind::ThreadPass)
      << "the thread is already in force";
}

TEST(FanucNctTables, ParameterAndExecutingBlocksOfTwoBlockCyclesReadTheirWordsDifferently) {
  const auto role = [](const CodeInfo &code, char letter) {
    for (const WordSpec &word : code.words)
      if (word.any & maskOf(letter))
        return word.role;
    return Role::None;
  };
  Control nct("nct-104t");
  const CodeInfo data = nct.meaning("G71", "G71 U2 R1");
  EXPECT_EQ(role(data, 'U'), Role::CutDepth);
  EXPECT_EQ(role(data, 'R'), Role::Retract);
  const CodeInfo cut = nct.meaning("G71", "G71 P10 Q40 U-1 W0.1 F0.3");
  EXPECT_EQ(role(cut, 'U'), Role::AllowanceX);
  EXPECT_EQ(role(cut, 'P'), Role::ProfileFirst);
  for (const WordSpec &word : cut.words)
    EXPECT_FALSE(word.hasRange && (word.any & maskOf('U'))) << "an allowance has a sign";
  for (const WordSpec &word : data.words)
    if (word.any & maskOf('P')) {
      EXPECT_EQ(word.need, Need::Optional);
    }
  EXPECT_EQ(role(nct.meaning("G73", "G73 U7 W7 R3"), 'R'), Role::PassCount);
  EXPECT_EQ(role(nct.meaning("G76", "G76 P020060 Q0.1 R0.05"), 'P'), Role::ThreadForm);
  EXPECT_EQ(role(nct.meaning("G76", "G76 X18 Z-16 P0.92 Q0.3 F1.5"), 'P'), Role::Height);
  EXPECT_EQ(role(nct.meaning("G74", "G74 R1"), 'R'), Role::Retract);
  EXPECT_EQ(role(nct.meaning("G74", "G74 X10 Z-10 P10 Q3 F0.1"), 'Z'), Role::Depth);
  EXPECT_EQ(role(nct.meaning("G75", "G75 X60 Z-20 P3 Q20 F0.1"), 'X'), Role::Depth);
}

TEST(FanucNctTables, FanucLatheCodesFollowTheShapeOfTheBlock) {
  Control lathe("fanuc-0t");
  EXPECT_EQ(lathe.meaning("G73", "G73 U3 R1").cycle, CycleKind::RoughTurn);
  EXPECT_EQ(lathe.meaning("G73", "G73 P5 Q25 U2 W1 F0.3").cycle, CycleKind::RoughTurn);
  EXPECT_EQ(lathe.meaning("G73", "G73 U10 W0 R5").cycle, CycleKind::PatternRepeat);
  EXPECT_EQ(lathe.meaning("G73", "G73 P5 Q25 U0.4 W0.1 F0.2").cycle, CycleKind::PatternRepeat);
  EXPECT_EQ(lathe.meaning("G72", "G72 P5 Q25").cycle, CycleKind::Finish);
  EXPECT_EQ(lathe.meaning("G72", "G72 W2 R1").cycle, CycleKind::RoughFace);
  EXPECT_EQ(lathe.meaning("G72", "G72 P5 Q25 U0.4 W0.1 F0.2").cycle, CycleKind::RoughFace);
  EXPECT_EQ(lathe.meaning("G71", "G71 U2 R1").cycle, CycleKind::RoughTurn);
  EXPECT_EQ(lathe.meaning("G71", "G71").action, Action::Metric);
  EXPECT_EQ(lathe.meaning("G70", "G70 P5 Q25").cycle, CycleKind::Finish);
  EXPECT_EQ(lathe.meaning("G21", "G21 G40").action, Action::Metric);
  EXPECT_EQ(lathe.meaning("G21", "G21 X47.2 Z-55 F5").cycle, CycleKind::ThreadPass);
  EXPECT_EQ(lathe.meaning("G20", "G20 X46 Z20").cycle, CycleKind::TurnPass);
  EXPECT_EQ(lathe.meaning("G20", "G20 G00 X46").action, Action::Inch);
  EXPECT_EQ(lathe.meaning("G50", "G50 S2500").action, Action::SpeedLimit);
  EXPECT_EQ(lathe.meaning("G50", "G50 X200 Z150").action, Action::PresetPosition);
  EXPECT_EQ(lathe.meaning("G50", "G50").action, Action::ScalingOff);
  EXPECT_EQ(lathe.meaning("G78", "G78 P021260 Q100 R0.05").cycle, CycleKind::ThreadMulti);
  EXPECT_EQ(lathe.meaning("G78", "G78 X47.2 Z-55 F5").cycle, CycleKind::ThreadPass);
}

TEST(FanucNctTables, FanucLatheG90AndG94AreCyclesOnlyWithTheirWords) {
  Control lathe("fanuc-0t");
  EXPECT_EQ(lathe.meaning("G90", "G90 G00 X40 Z2").action, Action::Absolute);
  EXPECT_EQ(lathe.meaning("G90", "G21 G90 G40").action, Action::Absolute);
  EXPECT_EQ(lathe.meaning("G90", "G90 X38 Z-20 F0.2").cycle, CycleKind::TurnPass);
  EXPECT_EQ(lathe.meaning("G94", "G94 X20 Z-2 F0.1").cycle, CycleKind::FacePass);
  EXPECT_EQ(lathe.meaning("G94", "G94 G01 X20 F100").action, Action::FeedPerMinute);
  EXPECT_EQ(lathe.meaning("G98", "G98").action, Action::FeedPerMinute);
  EXPECT_EQ(lathe.meaning("G99", "G99 G18").action, Action::FeedPerRevolution);
  EXPECT_EQ(lathe.meaning("G98", "G83 G98 Z-28 R1 Q10 F0.1").action, Action::ReturnInitial);
  EXPECT_EQ(lathe.meaning("G99", "G99 X4").action, Action::ReturnR) << "drilling is in force";
  EXPECT_EQ(Control("fanuc-0t").option("codeSet", "B").meaning("G99", "G99").action,
            Action::ReturnR);
}

TEST(FanucNctTables, AOnePassCycleRunsInEveryBlockUntilAMotionCode) {
  for (const char *id : {"nct-104t", "fanuc-0t"}) {
    Control lathe(id);
    const CodeInfo pass = lathe.meaning("G77", "G77 X46 Z20 F0.3");
    EXPECT_EQ(pass.cycle, CycleKind::TurnPass);
    EXPECT_EQ(lathe.group(pass), "cycle");
    EXPECT_TRUE(pass.firesOnEveryBlock);
  }
}

TEST(FanucNctTables, TheCodesOfOneModalGroupExcludeEachOther) {
  for (const char *id : controls) {
    auto dialect = table(id);
    const auto same = [&](llvm::StringRef a, llvm::StringRef b) {
      return dialect->codes[dialect->find(a)].group == dialect->codes[dialect->find(b)].group;
    };
    EXPECT_TRUE(same("G00", "G03")) << id;
    EXPECT_TRUE(same("G40", "G42")) << id;
    EXPECT_TRUE(same("G54", "G59")) << id;
    EXPECT_TRUE(same("G81", "G80")) << id;
    EXPECT_TRUE(same("G94", "G95")) << id;
    EXPECT_TRUE(same("M03", "M19")) << id;
    EXPECT_TRUE(same("M00", "M30")) << id;
    const GroupInfo &compensation = dialect->groups[dialect->group(StandardGroup::Compensation)];
    ASSERT_LT(compensation.initial, compensation.members.size()) << id;
    EXPECT_EQ(dialect->codes[compensation.members[compensation.initial]].name, "G40") << id;
  }
}

TEST(FanucNctTables, CoolantMayBeSwitchedOnTwiceInABlockButNotOnAndOff) {
  EXPECT_THAT(Control("nct-104t").notices("M7 M8"), ::testing::IsEmpty());
  EXPECT_THAT(Control("nct-104t").notices("M8 M9"),
              ::testing::ElementsAre("block-modal-group-conflict"));
}

TEST(FanucNctTables, FactsOfTheTableSpeakWhereTheyApply) {
  using ::testing::Contains;
  using ::testing::IsEmpty;
  EXPECT_THAT(Control("nct-104t").notices("G73 U3.0 R1.0"), Contains("block-foreign-dialect-code"));
  EXPECT_THAT(Control("nct-104t").notices("G73 U7 W7 R3"), IsEmpty());
  EXPECT_THAT(Control("nct-104t").notices("G76 R0.05 P020060 Q100"),
              Contains("turning-thread-pitch-unit"));
  EXPECT_THAT(Control("nct-104t").notices("G76 R0.05 P020060 Q0.1"), IsEmpty());
  EXPECT_THAT(Control("nct-104m").notices("G22 X100 Y80 Z50 I0 J0 K0 U20 P1"),
              Contains("block-value-out-of-range"));
  EXPECT_THAT(Control("nct-104m").notices("G43 H3 D3"), Contains("tool-length-offset-incomplete"));
  EXPECT_THAT(Control("nct-104m").notices("G17 G76 X5 Y5 I0.2 K0.2 Z-20 R1 F80"),
              Contains("cycle-missing-parameter"));
  EXPECT_THAT(Control("nct-104m").notices("G99 G87 X5 I0.2 J0 Z-10 R-30 F80"),
              Contains("cycle-wrong-mode"));
  EXPECT_THAT(Control("nct-104m").notices("G98 G87 X5 I0.2 J0 Z-10 R-30 F80"), IsEmpty());
  EXPECT_THAT(Control("nct-104m").notices("G88 X5 Y5 Z-20 R1 P1 F80"),
              Contains("cycle-manual-operation"));
  EXPECT_THAT(Control("fanuc-0m").notices("G83 X5 Y5 Z-30 R1 Q5 E1 F100"),
              Contains("block-code-not-on-control"));
  EXPECT_THAT(Control("fanuc-0t").notices("G91 G0 X-4"), Contains("block-code-not-on-control"));
  EXPECT_THAT(Control("fanuc-0t").option("codeSet", "B").notices("G91 G0 X-4"), IsEmpty());
  EXPECT_THAT(Control("fanuc-0t").notices("G33 Z-20 F1.5"), Contains("block-code-not-on-control"));
  EXPECT_THAT(Control("fanuc-0t").run({"G21 G90"}).notices("G33 Z-20 F1.5"), IsEmpty())
      << "G90 as a mode shows that the codes are not those of set A";
  EXPECT_THAT(Control("fanuc-0t").option("codeSet", "C").notices("G70 P1 Q2"),
              Contains("block-foreign-dialect-code"));
  for (const char *id : {"nct-104m", "fanuc-0m", "nct-104t", "fanuc-0t"}) {
    EXPECT_THAT(Control(id).option("spindleEncoder", "false").notices("G84.2 Z-12 R3 F1 S500"),
                Contains("cycle-spindle-not-prepared"))
        << id;
    EXPECT_THAT(Control(id).notices("G84.2 Z-12 R3 F1 S500"), IsEmpty()) << id;
  }
  EXPECT_THAT(
      Control("nct-104m").option("spindleOrientation", "false").notices("G76 I0.2 Z-20 R1 F80"),
      Contains("cycle-spindle-not-prepared"));
}

TEST(FanucNctTables, TheFactsOfOnePlaneAreNotSaidTwice) {
  EXPECT_EQ(Control("nct-104m").run({"G17"}).notices("G17 G76 I0.2 K0.2 Z-20 R1 F80").size(), 1u);
  EXPECT_EQ(Control("nct-104m").run({"G99"}).notices("G99 G87 I0.2 Z-10 R-30 F80").size(), 1u);
}

TEST(FanucNctTables, LaterFanucControlsRepeatWithK) {
  Control mill("fanuc-0m");
  EXPECT_TRUE(mill.meaning("G81", "G81 Z-6 R1 K3 F100").takes & maskOf('K'));
  EXPECT_THAT(mill.notices("G76 Z-6 R1 Q0.2 K1 F100"), ::testing::IsEmpty());
}

TEST(FanucNctTables, TappingAfterM29NeedsNoTurningSpindle) {
  Control mill("fanuc-0m");
  EXPECT_EQ(mill.meaning("G84", "G84 Z-12 R3 F500").spindle, SpindleNeed::Clockwise);
  EXPECT_EQ(mill.run({"G80", "M29 S500"}).meaning("G84", "G84 Z-12 R3 F500").spindle,
            SpindleNeed::StartsItself);
}

TEST(FanucNctTables, NctControlsReadTheIncrementOperatorAndTheOthersDoNot) {
  for (const char *id : controls)
    EXPECT_EQ(table(id)->lexical.incrementOperator, llvm::StringRef(id).startswith("nct")) << id;
}

} // namespace
} // namespace ncvet
