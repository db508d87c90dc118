// Every rule's page has the same sections in the same order, and lists the options that it has;
// pages and sources are written in plain words.
#include "analyzer/rule/rule_page.h"
#include "formats/finding/page_text.h"
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/plain_words.h"
#include "tests/support/rule_pages.h"

namespace ncvet::test {
namespace {

std::vector<std::string> sectionsOf(llvm::StringRef body) {
  std::vector<std::string> sections;
  bool inside = false; // a fenced program
  for (const std::string &line : linesOf(body.str())) {
    if (line.rfind("```", 0) == 0)
      inside = !inside;
    else if (!inside && line.rfind("## ", 0) == 0)
      sections.push_back(line.substr(3));
  }
  return sections;
}

TEST(RulePageForm, EveryPageHasTheSameSectionsInTheSameOrder) {
  for (const RuleEntry &entry : allRules()) {
    const ncvet::RulePage page = readRulePage(entry.info);
    std::vector<std::string> due = {"What it reports", "Why it matters at the machine", "Wrong",
                                    "Right"};
    if (!page.options.empty())
      due.emplace_back("Options");
    due.emplace_back("Limits");
    EXPECT_EQ(due, sectionsOf(page.body)) << entry.info.id.str();
  }
}

TEST(RulePageForm, TheSectionOfTheOptionsListsThoseOfTheHead) {
  for (const RuleEntry &entry : allRules()) {
    const ncvet::RulePage page = readRulePage(entry.info);
    std::vector<std::string> due, listed;
    for (const RuleOption &option : page.options)
      due.push_back(option.name);
    const llvm::StringRef section = page.body.split("\n## Options\n").second.split("\n## ").first;
    for (const std::string &line : linesOf(section.str()))
      if (line.rfind("- `", 0) == 0)
        listed.push_back(llvm::StringRef(line).drop_front(3).split('`').first.str());
    EXPECT_EQ(due, listed) << entry.info.id.str();
  }
}

TEST(RulePageForm, ItsWordsAreThoseOfAPlainEnglish) {
  for (const RuleEntry &entry : allRules()) {
    EXPECT_EQ(std::vector<std::string>(), hardWords(entry.info.help)) << entry.info.id.str();
    EXPECT_EQ(std::vector<std::string>(), hardWords(entry.info.summary)) << entry.info.id.str();
  }
}

/// Comments, messages and other texts of a source. A single word in quotes is a name.
std::string textsOf(llvm::StringRef source) {
  std::string texts, quoted;
  while (!source.empty()) {
    llvm::StringRef line;
    std::tie(line, source) = source.split('\n');
    bool inside = false; // of quotation marks
    for (; !line.empty(); line = line.drop_front()) {
      if (!inside && line.startswith("//")) {
        texts += line.ltrim('/').str() + ' ';
        break;
      }
      if (inside && line.startswith("\\"))
        line = line.drop_front();
      else if (inside && line[0] != '"')
        quoted += line[0];
      else if (line[0] == '"')
        inside = !inside;
      if (!inside && llvm::StringRef(quoted).contains(' '))
        texts += quoted + ' ';
      if (!inside)
        quoted.clear();
    }
  }
  return texts;
}

TEST(Sources, AreWrittenInPlainWords) {
  namespace fs = std::filesystem;
  for (const char *room : {"analyzer", "formats", "interp", "lsp", "rules"})
    for (const auto &file :
         fs::recursive_directory_iterator(fs::path(places::sourceFolder()) / room)) {
      const fs::path &path = file.path();
      if (path.extension() != ".cpp" && path.extension() != ".h")
        continue;
      const std::string source = contentsOf(path);
      EXPECT_EQ(std::vector<std::string>(), hardWords(textsOf(source))) << path;
      EXPECT_EQ(std::vector<std::string>(), hardNames(source)) << path;
    }
}

TEST(Tests, AreWrittenInPlainWords) {
  namespace fs = std::filesystem;
  for (const auto &file :
       fs::recursive_directory_iterator(fs::path(places::sourceFolder()) / "tests")) {
    const fs::path &path = file.path();
    if ((path.extension() == ".cpp" || path.extension() == ".h") && path.stem() != "plain_words" &&
        path.stem() != "page_form_test") { // the two that know the words
      EXPECT_EQ(std::vector<std::string>(), hardNames(contentsOf(path))) << path;
    }
  }
}

TEST(PlainWords, AreLookedForInsideOfNames) {
  EXPECT_EQ(hardNames("const char *behindLineBlanks(size_t p);").size(), 1U);
  EXPECT_EQ(hardNames("struct InFront {};").size(), 1U);
  EXPECT_EQ(hardNames("bool standsInside_ = false;").size(), 1U);
  EXPECT_TRUE(hardNames("understands(before, after);").empty());
}

TEST(PageOfOneControl, LeavesOutTheProgramsOfOthersAndWhatIntroducesOnlyThem) {
  const std::string other = "```nc haas-mill wrong\nM30\n```\n\n",
                    own = "```nc ecs wrong\nM30\n\n# no heading\n```\n\n";
  const std::vector<std::string> ecs = {"ecs"}, mefi = {"mefi"};
  EXPECT_EQ(withProgramsOf(ecs, "# rule\n\nA paragraph.\n\n## Wrong\n\n" + other + own +
                                    "Of another:\n\n" + other + "Of two.\n\n" + other + own +
                                    "Of its own\nin two lines:\n\n" + own + "### More\n\n" + other +
                                    "## Limits\n\nThe end.\n"),
            "# rule\n\nA paragraph.\n\n## Wrong\n\n" + own + "Of two.\n\n" + own +
                "Of its own\nin two lines:\n\n" + own + "## Limits\n\nThe end.\n");
  // A sentence that ends in a colon introduces the next program only.
  EXPECT_EQ(withProgramsOf(ecs, "All of them stop. This one does not:\n\n" + other + own),
            "All of them stop.\n\n" + own);
  EXPECT_EQ(withProgramsOf(mefi, "Of another:\n\n" + other), "Of another:\n\n" + other);
}

TEST(PageForReaders, HasNoMarksOfTestsAndNoPlacesOfManuals) {
  EXPECT_EQ(forReaders("## Wrong\n\n```nc ecs wrong\nG1 X1\n' ^^ expect: definite\nM30\n```\n\n"
                       "Source: ECS manual, lines 2009-2014.\n"),
            "## Wrong\n\n```nc ecs\nG1 X1\nM30\n```\n\n");
  EXPECT_EQ(forReaders("```nc sinumerik wrong\nG1\nM0\n;^-1 expect: definite\n```\n"),
            "```nc sinumerik\nG1\nM0\n```\n");
  EXPECT_EQ(forReaders("```nc ecs right machine={\"options\": {}}\nG1 X1\n```\n"),
            "With the machine profile `{\"options\": {}}`:\n\n```nc ecs\nG1 X1\n```\n");
}

} // namespace
} // namespace ncvet::test
