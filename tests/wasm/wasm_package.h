// The npm package that `./dev package npm` makes, for tests that run it.
#pragma once

#include "tests/support/places.h"
#include "tests/support/process.h"

#include <filesystem>

namespace ncvet::test {

/// The unpacked package.
inline std::filesystem::path wasmPackage() {
  return std::filesystem::path(places::sourceFolder()) / "build" / "package" / "npm" / "package";
}

/// Why the package cannot be tested; empty: it can.
inline std::string whyNoWasmPackage() {
  namespace fs = std::filesystem;
  if (!llvm::sys::findProgramByName("node"))
    return "node is not installed: ./dev packages browser";
  const fs::path module = wasmPackage() / "lib" / "ncvet.wasm";
  if (!fs::exists(module))
    return "the npm package is not built: ./dev package npm";
  if (fs::last_write_time(module) < fs::last_write_time(places::program()))
    return "the npm package is older than the program: ./dev package npm";
  return "";
}

/// Tests of what the package holds.
class WasmPackage : public testing::Test {
protected:
  void SetUp() override {
    if (const std::string why = whyNoWasmPackage(); !why.empty())
      GTEST_SKIP() << why;
    shop_.binary(command());
  }
  static std::string command() { return (wasmPackage() / "bin" / "ncvet.js").string(); }

  Shop shop_;
};

} // namespace ncvet::test
