// ./dev shape: each kind of what breaks the shape is told, in a small tree that has all of them.
#include "tests/support/outer_program.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

#include "gtest/gtest.h"

#include <string>

namespace {

namespace fs = std::filesystem;
using namespace ncvet::test;

/// A tree of sources with the project's own table of rooms.
class Shape : public ::testing::Test {
protected:
  void SetUp() override {
    if (runOuter({python, "-c", "import shutil, sys; sys.exit(not shutil.which('ctags'))"}, log(),
                 30) != 0)
      GTEST_SKIP() << "universal-ctags is not installed";
    fs::create_directories(tree_.path() / "tests/shape");
    fs::copy_file(source / "tests/shape/rooms.txt", tree_.path() / "tests/shape/rooms.txt");
  }

  void write(const std::string &name, const std::string &text) {
    fs::create_directories((tree_.path() / name).parent_path());
    tree_.write(name, text);
  }

  int examine() {
    return runOuter({"env", "-C", tree_.path().string(), python, "-B",
                     (source / "tests/shape/shape.py").string()},
                    log(), 60);
  }
  std::string told() const { return contentsOf(log()); }

private:
  fs::path log() const { return logs_.path() / "log"; }

  const std::string python = "python3";
  const fs::path source = ncvet::places::sourceFolder();
  TemporaryFolder tree_, logs_;
};

TEST_F(Shape, OfASoundTreeIsNotComplainedAbout) {
  write("formats/text/a.h", "namespace ncvet { class Block; int sum(int one, int other); }\n");
  write("analyzer/rule/b.cpp", "#include \"formats/text/a.h\"\nnamespace ncvet { int twice(int x) "
                               "{ return sum(x, x); } }\n");
  EXPECT_EQ(examine(), 0) << told();
}

TEST_F(Shape, OfABrokenTreeIsToldKindByKind) {
  write("formats/text/a.h", "#include \"formats/text/b.h\"\n#include \"lsp/server/c.h\"\n");
  write("formats/text/b.h",
        "#include \"formats/text/a.h\"\nnamespace ncvet { int measured(int x); }\n");
  write("lsp/server/c.h", "namespace ncvet { class Distant { int x; }; }\n");
  write("interp/value/long.cpp",
        "int slow() {\n" + std::string(60, '\n') + "  return 0;\n}\n" + std::string(440, '\n'));
  write("interp/value/chance.cpp",
        "namespace ncvet { int x(Distant *d) { return measured(1); } }\n");
  EXPECT_EQ(examine(), 1);
  const std::string text = told();
  for (const std::string line :
       {"interp/value/long.cpp:1: slow has 63 lines", "interp/value/long.cpp has 503 lines",
        "files include one another: formats/text/a, formats/text/b",
        "formats/text/a.h may not include lsp/server/c.h",
        "interp/value/chance.cpp uses Distant and includes nothing that declares it, as "
        "lsp/server/c.h does",
        "interp/value/chance.cpp uses measured and includes nothing that declares it, as "
        "formats/text/b.h does"})
    EXPECT_NE(text.find("shape: " + line + "\n"), std::string::npos) << line << "\n" << text;
  EXPECT_NE(text.find("1 functions over 60 lines, 1 files over 500, 1 circles, 1 arrows up, "
                      "2 names known by chance"),
            std::string::npos)
      << text;
}

TEST_F(Shape, OfAFileOutsideOfAllRoomsIsTold) {
  write("formats/stray.cpp", "int stray;\n");
  EXPECT_EQ(examine(), 1);
  EXPECT_NE(told().find("formats/stray.cpp lies in no room"), std::string::npos) << told();
}

} // namespace
