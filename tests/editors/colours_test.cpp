// Colours before the server answers: they are made of the tables, and are those that the server
// gives.
#include "tests/support/packed_extension.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include "llvm/ADT/StringExtras.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace ncvet::test {
namespace {

namespace fs = std::filesystem;

const fs::path editors = fs::path(places::sourceFolder()) / "lsp" / "editors";
const fs::path programs = fs::path(places::sourceFolder()) / "tests" / "programs";

TEST(Colours, AreUpToDateWithTheTables) {
  if (!llvm::sys::findProgramByName("python3"))
    GTEST_SKIP() << "python3 is absent: ./dev editors cannot run";
  const TemporaryFolder temporary;
  const fs::path log = temporary.path() / "log";
  const int status = runOuter(
      {"python3", "-B", (editors / "generate" / "generate.py").string(), "--check"}, log, 60);
  EXPECT_EQ(status, 0) << contentsOf(log);
}

/// `17 of 18`, the last line of what colours.mjs says.
std::pair<unsigned, unsigned> countsOf(llvm::StringRef said) {
  const auto [same, all] = said.rtrim().rsplit('\n').second.split(" of ");
  std::pair<unsigned, unsigned> counts;
  return same.getAsInteger(10, counts.first) || all.getAsInteger(10, counts.second)
             ? std::pair(0u, 0u)
             : counts;
}

/// At least so many in a hundred characters of the programs of each control have the colour that
/// the server gives them; `languageOf` is that of a control's folder, empty: it is left out.
void expectColours(const fs::path &grammars, unsigned hundredths,
                   llvm::function_ref<std::string(const std::string &)> languageOf) {
  const auto modules = nodeModules(extensionFolder);
  if (!modules)
    GTEST_SKIP() << "npm cannot fetch vscode-textmate";
  const TemporaryFolder temporary;
  const fs::path log = temporary.path() / "log";
  std::vector<std::string> command = {"node",
                                      places::sourceFolder() + "/tests/editors/vscode/colours.mjs",
                                      modules->string(), places::program(), grammars.string()};
  for (const auto &entry : fs::recursive_directory_iterator(programs)) {
    const std::string language = languageOf(entry.path().parent_path().filename().string());
    if (entry.path().extension() == ".nc" && entry.path().parent_path().parent_path() == programs &&
        !language.empty())
      command.push_back(entry.path().string() + "::" + language);
  }
  ASSERT_EQ(runOuter(command, log, 120), 0) << contentsOf(log);
  const std::string said = contentsOf(log);
  const auto [same, all] = countsOf(said);
  EXPECT_GT(all, 5000u) << said;
  EXPECT_GE(same * 100, all * hundredths) << said;
}

/// What a word is the grammar sees by its spelling alone: it cannot know every name and number.
TEST(Colours, OfTheGrammarsAreThoseOfTheServer) {
  expectColours(editors / "vscode" / "syntaxes", 98, [](const std::string &folder) {
    return folder == "examples" ? "gcode" : "ncvet-" + folder;
  });
}

/// A grammar of tree-sitter cannot tell a sign from an operator, nor controls of one ending apart.
TEST(Colours, OfTreeSitterAreThoseOfTheServer) {
  expectColours(editors / "tree-sitter", 96, [](const std::string &folder) {
    return std::string(folder == "linuxcnc" ? "" : "gcode");
  });
}

/// What tree-sitter would refuse is looked for without it.
TEST(Colours, GrammarsOfTreeSitterAreOnesThatItTakes) {
  if (!llvm::sys::findProgramByName("node"))
    GTEST_SKIP() << "there is no Node";
  const TemporaryFolder temporary;
  const fs::path log = temporary.path() / "log", grammars = editors / "tree-sitter";
  EXPECT_EQ(runOuter({"node", places::sourceFolder() + "/tests/editors/tree_sitter/check.mjs",
                      grammars.string()},
                     log, 60),
            0);
  expectDone(log);
}

/// The group of syntax at the first byte of each word of a line, by Neovim with its set-up.
TEST(Colours, OfNeovimAreThereWithoutTheServer) {
  if (!llvm::sys::findProgramByName("nvim"))
    GTEST_SKIP() << "nvim is absent";
  const TemporaryFolder temporary;
  const fs::path file = temporary.path() / "PART.MPF", script = temporary.path() / "ask.lua",
                 out = temporary.path() / "out";
  std::ofstream(file) << "N10 G1 X-5 F100 M8 R1=3 TRANS GOTOF END ; away\n";
  std::ofstream(script)
      << "local groups, line = {}, vim.fn.getline(1)\n"
         "for at in line:gmatch('()%S+') do\n"
         "  table.insert(groups, vim.fn.synIDattr(vim.fn.synID(1, at, 1), 'name'))\n"
         "end\n"
         "vim.fn.writefile(groups, '"
      << out.string() << "')\nvim.cmd('qall!')\n";
  const fs::path log = temporary.path() / "log";
  EXPECT_EQ(
      runOuter({"nvim", "--headless", "-u", "NONE", "-i", "NONE", "-n", "--cmd",
                "set rtp+=" + (editors / "neovim").string(), "-c", "syntax on", "-c",
                "set filetype=ncvet-sinumerik", "-c", "luafile " + script.string(), file.string()},
               log, 60),
      0)
      << contentsOf(log);
  EXPECT_EQ(contentsOf(out),
            "ncvetNumberOfBlock\nncvetCode\nncvetAxis\nncvetParameter\nncvetMiscellaneous\n"
            "ncvetVariable\nncvetCode\nncvetKeyword\nncvetVariable\nncvetComment\n"
            "ncvetComment\n")
      << contentsOf(log);
}

TEST(Colours, OfEmacsAreThereWithoutTheServer) {
  const TemporaryFolder temporary;
  const fs::path log = temporary.path() / "log";
  if (runOuter({"emacs", "--batch", "-q", "--eval",
                "(progn (package-initialize) (kill-emacs (if (locate-library \"eglot\") 0 1)))"},
               log, 60) != 0)
    GTEST_SKIP() << "emacs with Eglot is absent";
  const std::string ask =
      "(progn (package-initialize) (load \"" + (editors / "emacs" / "ncvet.el").string() +
      "\" nil t) (with-temp-buffer (insert \"N10 G1 X-5 #1=3 (AWAY)\\n\") (ncvet-mode)"
      " (font-lock-ensure) (dolist (at '(1 5 8 12 17))"
      " (princ (format \"%s\\n\" (get-text-property at 'face))))))";
  EXPECT_EQ(runOuter({"emacs", "--batch", "-q", "--eval", ask}, log, 60), 0);
  EXPECT_THAT(contentsOf(log),
              testing::HasSubstr("font-lock-constant-face\nfont-lock-builtin-face\n"
                                 "font-lock-keyword-face\nfont-lock-variable-name-face\n"
                                 "font-lock-comment-face\n"));
}

/// The library that Kate uses gives each kind of word a colour of its own.
TEST(Colours, OfKateAreThoseOfItsLibrary) {
  if (!llvm::sys::findProgramByName("kate-syntax-highlighter"))
    GTEST_SKIP() << "kate-syntax-highlighter is absent";
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "org.kde.syntax-highlighting" / "syntax",
                 file = temporary.path() / "PART.MPF", log = temporary.path() / "log";
  fs::create_directories(folder);
  for (const auto &entry : fs::directory_iterator(editors / "kate"))
    if (entry.path().extension() == ".xml")
      fs::copy(entry.path(), folder / entry.path().filename());
  std::ofstream(file) << "N10 G1 X5 M8 ; AWAY\n";
  EXPECT_EQ(runOuter({"env", "XDG_DATA_HOME=" + temporary.path().string(),
                      "QT_QPA_PLATFORM=offscreen", "kate-syntax-highlighter", file.string()},
                     log, 60),
            0);
  const std::string said = contentsOf(log);
  EXPECT_THAT(said, testing::HasSubstr("Definition (NC Program (SINUMERIK))"));
  std::set<std::string> styles;
  for (llvm::StringRef word : {"N10", "G1", "X", "5", "M8", "; AWAY"}) {
    const llvm::StringRef before =
        llvm::StringRef(said).split((">" + word + "</span>").str()).first;
    styles.insert(before.rsplit("<span ").second.str());
  }
  EXPECT_EQ(styles.size(), 6u) << said;
}

} // namespace
} // namespace ncvet::test
