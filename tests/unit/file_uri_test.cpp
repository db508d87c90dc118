// URIs of files: there and back, on both kinds of systems.
#include "formats/text/file_uri.h"

#include <gtest/gtest.h>

namespace ncvet {
namespace {

constexpr auto posix = llvm::sys::path::Style::posix, windows = llvm::sys::path::Style::windows;

TEST(FileUri, OfAPathOnLinux) {
  EXPECT_EQ(uriOfPath("/home/a b/O1.nc", posix), "file:///home/a%20b/O1.nc");
  EXPECT_EQ(pathOfUri("file:///home/a%20b/O1.nc", posix), "/home/a b/O1.nc");
  EXPECT_EQ(pathOfUri("file://localhost/O1.nc", posix), "/O1.nc");
}

TEST(FileUri, OfADriveOnWindows) {
  EXPECT_EQ(uriOfPath("C:\\parts\\Teil ü.nc", windows), "file:///C:/parts/Teil%20%C3%BC.nc");
  EXPECT_EQ(pathOfUri("file:///C:/parts/O1.nc", windows), "C:/parts/O1.nc");
  EXPECT_EQ(pathOfUri("file:///c%3A/parts/O1.nc", windows), "c:/parts/O1.nc"); // as VS Code has it
}

TEST(FileUri, OfANetworkShareOnWindows) {
  EXPECT_EQ(uriOfPath("\\\\dnc\\parts\\O1.nc", windows), "file://dnc/parts/O1.nc");
  EXPECT_EQ(pathOfUri("file://dnc/parts/O1.nc", windows), "//dnc/parts/O1.nc");
}

TEST(FileUri, WhatIsNoAbsolutePathAndNoFileStaysAsItIs) {
  EXPECT_EQ(uriOfPath("O1.nc", windows), "O1.nc");
  EXPECT_EQ(uriOfPath("O1.nc", posix), "O1.nc");
  EXPECT_EQ(pathOfUri("untitled:Untitled-1", posix), "untitled:Untitled-1");
  EXPECT_EQ(pathOfUri("file://", posix), "file://");
}

} // namespace
} // namespace ncvet
