// `ncvet view`: a page is written, told of, and opened.
#include "tests/support/process.h"

#include "llvm/Support/Process.h"
#include <gmock/gmock.h>

#include <cstdlib>

using namespace ncvet::test;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

namespace {

/// A program in the place of the system's that opens files: it writes down what it was given.
class Opener {
public:
  Opener() : path_(std::getenv("PATH")) {
    shop_.file("bin/xdg-open", "#!/bin/sh\necho \"$1\" >\"$(dirname \"$0\")/../opened\"\n");
    std::filesystem::permissions(shop_.path() / "bin" / "xdg-open",
                                 std::filesystem::perms::owner_all);
    setenv("PATH", ((shop_.path() / "bin").string() + ":" + path_).c_str(), 1);
  }
  ~Opener() { setenv("PATH", path_.c_str(), 1); }

  /// What was opened; it may still be about to be. Empty after ten seconds.
  std::string opened() const {
    for (int i = 0; i < 100 && shop_.text("opened").empty(); ++i)
      usleep(100'000);
    return shop_.text("opened");
  }

private:
  Shop shop_;
  std::string path_;
};

} // namespace

TEST(View, WritesThePageAndSaysWhere) {
  Shop shop;
  shop.file("a.nc", programWithoutFeed());
  const ProcessResult result =
      shop.run({"view", "--dialect", "fanuc-0t", "-o", "a.html", "--no-open", "a.nc"});
  EXPECT_EQ(0, result.exitCode) << result.err;
  EXPECT_EQ("a.html\n", result.out);
  EXPECT_THAT(result.err, IsEmpty());
  EXPECT_THAT(shop.text("a.html"), HasSubstr("\"rule\":\"feed-missing\""));
  EXPECT_THAT(shop.text("a.html"), HasSubstr("id=\"path-0\""));
}

TEST(View, OpensAPageOfItsOwn) {
  Opener opener;
  Shop shop;
  shop.file("shaft.nc", programWithoutFeed());
  const ProcessResult result = shop.run({"view", "--dialect", "fanuc-0t", "shaft.nc"});
  EXPECT_EQ(0, result.exitCode) << result.err;
  EXPECT_THAT(result.out, HasSubstr("ncvet-shaft-"));
  EXPECT_EQ(result.out, opener.opened());
  std::filesystem::remove(result.out.substr(0, result.out.find('\n')));
}

TEST(View, AFileThatCannotBeReadIsToldAndNothingIsOpened) {
  Shop shop;
  const ProcessResult result = shop.run({"view", "--no-open", "-o", "a.html", "gone.nc"});
  EXPECT_EQ(2, result.exitCode);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, HasSubstr("gone.nc"));
}
