// The packed tables are those of the JSON files, in everything.
#include "formats/packed/packed_tables.h"
#include "formats/packed/packer.h"
#include "formats/packed/shipped.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

std::shared_ptr<const Dialect> loaded(llvm::Expected<std::shared_ptr<const Dialect>> dialect) {
  if (dialect)
    return *dialect;
  ADD_FAILURE() << llvm::toString(dialect.takeError());
  return std::make_shared<Dialect>();
}

TEST(PackedTables, EveryControlIsTheOneOfItsJson) {
  for (const DialectSummary &summary : listDialects()) {
    const auto read = loaded(loadDialect(summary.id, builtinDialects()));
    const auto unpacked = loaded(loadShipped(summary.id));
    EXPECT_EQ(summary.abstract, unpacked->abstract) << summary.id;
    EXPECT_EQ(pack(*read), pack(*unpacked)) << summary.id;
    // What is not packed.
    EXPECT_EQ(unpacked->variableRanges.shown, unpacked->shown.get()) << summary.id;
    ASSERT_EQ(read->layers.size(), unpacked->layers.size()) << summary.id;
    for (size_t i = 0; i < read->layers.size(); ++i) {
      EXPECT_EQ(read->layers[i].name, unpacked->layers[i].name);
      EXPECT_EQ(read->layers[i].text, unpacked->layers[i].text) << read->layers[i].name;
    }
  }
}

TEST(PackedTables, WhatIsKnownOfAllControlsIsThatOfTheirJson) {
  auto read = loadIndex();
  ASSERT_TRUE(bool(read)) << llvm::toString(read.takeError());
  EXPECT_EQ(pack(*read),
            pack(PackedIndex{shippedDialects(), shippedDetection(), shippedNeededTexts()}));
}

TEST(PackedTables, AMachineProfileIsLaidOverAPackedTableAsOverAnother) {
  const char *profile = R"({"codes": {"M70": {"summary": "door", "does": "switch"}},
                            "options": {"mCodesPerBlock": 2}})";
  for (const DialectSummary &summary : listDialects()) {
    if (summary.abstract)
      continue;
    const auto read = loaded(loadDialect(summary.id, builtinDialects()));
    auto expected = overlay(read, "machine.json", profile);
    auto given = overlay(loaded(loadShipped(summary.id)), "machine.json", profile);
    ASSERT_EQ(bool(expected), bool(given)) << summary.id;
    if (expected && given)
      EXPECT_EQ(pack(**expected), pack(**given)) << summary.id;
    else
      EXPECT_EQ(llvm::toString(expected.takeError()), llvm::toString(given.takeError()));
  }
}

/// A profile without codes is laid over the table as it is; with them the table is made anew.
TEST(PackedTables, AMachineProfileThatLeavesTheTableIsLaidOverItAsOverItsLayers) {
  for (const DialectSummary &summary : listDialects()) {
    if (summary.abstract)
      continue;
    const auto table = loaded(loadShipped(summary.id));
    const std::string first =
        table->options.empty() ? "no" : table->options.begin()->getKey().str();
    const std::string options[] = {"",
                                   R"("nobody": 1)",
                                   R"("mCodesPerBlock": 2)",
                                   R"("courseProfile": true)",
                                   R"("toolChangeByM6": false)",
                                   "\"" + first + "\": true"};
    for (const std::string &given : options) {
      const std::string own = R"("options": {)" + given + "}";
      auto expected = overlay(table, "machine.json", "{" + own + R"(, "codes": {}})");
      auto laid = overlay(table, "machine.json", "{" + own + "}");
      ASSERT_EQ(bool(expected), bool(laid)) << summary.id << " " << given;
      if (expected && laid)
        EXPECT_TRUE(pack(**expected) == pack(**laid)) << summary.id << " " << given;
      else
        EXPECT_EQ(llvm::toString(expected.takeError()), llvm::toString(laid.takeError()));
    }
  }
}

TEST(PackedTables, AnUnknownControlIsAnErrorAsEver) {
  for (const char *id : {"", "nobody", "iso"}) {
    auto read = loadDialect(id, builtinDialects());
    auto unpacked = loadShipped(id);
    ASSERT_FALSE(read || unpacked) << id;
    EXPECT_EQ(llvm::toString(read.takeError()), llvm::toString(unpacked.takeError()));
  }
}

struct Values {
  double number = 0;
  int64_t whole = 0;
  uint64_t set = 0;
  bool yes = false;
  char letter = 0;
  std::string text;
  std::optional<double> perhaps;
  std::vector<std::pair<uint16_t, std::string>> list;
  std::variant<double, std::string> either;
  llvm::StringMap<int> named;
};

TEST(PackedTables, ValuesComeOutAsTheyWentIn) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr int64_t least = std::numeric_limits<int64_t>::min();
  for (const double number : {0.0, -0.0, 1.0, 251.0, 252.0, 1e9, -1.0, 0.1, infinity, -infinity})
    for (const int64_t whole :
         {int64_t(0), int64_t(-1), int64_t(63), int64_t(-65), least, ~least}) {
      Values in{number, whole,  uint64_t(whole),       true, 'G',
                "a\0b", number, {{9, "x"}, {999, ""}}, "e",  {}};
      in.named["b"] = -3;
      in.named["a"] = 128;
      std::string bytes;
      Packer(bytes).all(in);
      Values out;
      out.text = "old";
      Unpacker unpacker(bytes);
      unpacker.all(out);
      EXPECT_TRUE(unpacker.atEnd());
      EXPECT_EQ(0, memcmp(&number, &out.number, sizeof number)) << number;
      EXPECT_EQ(whole, out.whole);
      EXPECT_EQ(in.set, out.set);
      EXPECT_TRUE(out.yes);
      EXPECT_EQ('G', out.letter);
      EXPECT_EQ(in.text, out.text);
      EXPECT_EQ(in.perhaps, out.perhaps);
      EXPECT_EQ(in.list, out.list);
      EXPECT_EQ(in.either, out.either);
      EXPECT_EQ(2u, out.named.size());
      EXPECT_EQ(-3, out.named["b"]);
      EXPECT_EQ(128, out.named["a"]);
    }
}

} // namespace
} // namespace ncvet
