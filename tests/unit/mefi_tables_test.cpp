// The table of MEFI CNC872: every code and macro of the supplement, and what sets it apart.
#include "formats/dialect/loader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ncvet {
namespace {

class MefiTable : public ::testing::Test {
protected:
  void SetUp() override {
    auto loaded = loadDialect("mefi", builtinDialects());
    ASSERT_TRUE(bool(loaded)) << llvm::toString(loaded.takeError());
    dialect_ = *loaded;
  }
  const CodeInfo &code(llvm::StringRef name) const {
    const CodeIndex index = dialect_->find(name);
    EXPECT_NE(index, noCode) << name.str();
    return dialect_->codes[index == noCode ? 0 : index];
  }
  std::vector<std::string> required(llvm::StringRef name) const {
    std::vector<std::string> names;
    for (const WordSpec &spec : code(name).words)
      if (spec.need == Need::Required && spec.variable)
        names.push_back(spec.name);
    llvm::sort(names);
    return names;
  }
  std::shared_ptr<const Dialect> dialect_;
};

TEST_F(MefiTable, KnowsEveryCodeOfTheSupplement) {
  for (const char *name : {"G00", "G01", "G02", "G03", "G17", "G18", "G19", "G41", "G42", "G53",
                           "G54", "G80", "G81", "G82", "G83", "G84", "G85", "G86", "G87", "G90",
                           "G91", "G94", "G95", "M00", "M03", "M04", "M05", "M06", "M09", "M30"})
    EXPECT_FALSE(code(name).source.empty()) << name;
}

TEST_F(MefiTable, KnowsTheMacrosAndCalls) {
  EXPECT_NE(dialect_->keyword("program"), noCode) << "names are read in capitals or not";
  EXPECT_EQ(code("ENDPROGRAM").action, Action::ProgramEndRewind);
  EXPECT_NE(dialect_->keyword("CALLCYCLE"), noCode);
  EXPECT_NE(dialect_->keyword("TRANSLATE"), noCode);
}

TEST_F(MefiTable, CyclesRunInEveryBlockUntilTheyAreCancelled) {
  EXPECT_TRUE(dialect_->emptyBlocksRun);
  EXPECT_TRUE(dialect_->cycleSurvivesMotion);
  for (const char *name : {"G81", "G82", "G83", "G84", "G85", "G86", "G87"}) {
    EXPECT_TRUE(code(name).firesOnEveryBlock) << name;
    EXPECT_EQ(code(name).opposite, dialect_->find("G80")) << name;
  }
}

TEST_F(MefiTable, EachCycleNeedsTheParametersOfTheSupplement) {
  using ::testing::ElementsAre;
  EXPECT_THAT(required("G81"), ElementsAre("R30", "R31", "R32"));
  EXPECT_THAT(required("G82"), ElementsAre("R29", "R30", "R31", "R32"));
  EXPECT_THAT(required("G83"), ElementsAre("R28", "R30", "R31", "R32"));
  EXPECT_THAT(required("G84"), ElementsAre("R30", "R31", "R32"));
  EXPECT_THAT(required("G85"), ElementsAre("R30", "R31", "R32"));
  EXPECT_THAT(required("G86"), ElementsAre("R28", "R29", "R30", "R31", "R32"));
  EXPECT_THAT(required("G87"), ElementsAre("R28", "R29", "R30", "R31", "R32", "R33", "R34"));
}

TEST_F(MefiTable, TheStartStateIsTheMachinesBusiness) {
  for (const StandardGroup group : {StandardGroup::Motion, StandardGroup::Plane,
                                    StandardGroup::Distance, StandardGroup::FeedMode})
    EXPECT_EQ(dialect_->groups[dialect_->group(group)].initial, 0xFF)
        << toString(group).str() << ": no default is stated";
}

} // namespace
} // namespace ncvet
