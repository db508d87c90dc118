// Fuzzes sequences of edits: a check that remembers the one before finds what a fresh one finds.
#include "lsp/server/checks.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace ncvet;

/// Programs that are edited: long enough for runs that are taken over.
std::string startingText(unsigned which) {
  std::string text = which % 2 ? "%\nO1 (A)\nT1 M06\nG90 G54 G00 X0. Y0. S900 M03\nG43 H1 Z9.\n"
                               : "O1\nT0101\nG00 X50. Z2. S900 M03\nG41\n";
  text += "G01 Z-1. F100.\n";
  for (unsigned i = 0; i < 90; ++i)
    text += (which % 2 ? "X" + std::to_string(i % 17) + ". Y" : "Z-") + std::to_string(i % 13) +
            (i % 29 == 28 ? ". F20.\n" : ".\n");
  return text + (which % 2 ? "G00 Z9.\nM98 P2\nM30\nO2\nX1.\nM99\n%\n" : "G40 X60.\nM30\n");
}

std::shared_ptr<Session> sessionOf(unsigned which) {
  static const std::vector<DialectSummary> dialects = [] {
    std::vector<DialectSummary> all = listDialects();
    llvm::erase_if(all, [](const DialectSummary &d) { return d.abstract; });
    return all;
  }();
  static std::vector<std::shared_ptr<Session>> sessions(dialects.size());
  which %= sessions.size();
  if (!sessions[which]) {
    SessionOptions options;
    options.dialect = dialects[which].id;
    options.profile = "all";
    options.limits.repeatedBlocks = 20'000;
    sessions[which] = std::make_shared<Session>(options);
  }
  return sessions[which];
}

std::string told(const lsp::CheckResult &result) {
  std::string all = result.error;
  for (const lsp::Problem &problem : result.problems)
    all += problem.diagnostic + "\n";
  return all;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  if (size < 2 || size > 400)
    return 0;
  lsp::CheckJob job;
  job.session = sessionOf(data[0]);
  job.overlay = std::make_shared<SourceSet::Overlay>();
  job.document.path = "fuzz.nc";
  std::string text = startingText(data[1]);
  CheckMemory memory;
  for (size_t at = 2; at + 4 <= size;) {
    // place, bytes that go, bytes that come
    const size_t place = (size_t(data[at]) << 8 | data[at + 1]) % (text.size() + 1);
    const size_t gone = std::min<size_t>(data[at + 2] % 40, text.size() - place);
    const size_t come = std::min<size_t>(data[at + 3] % 16, size - at - 4);
    text.replace(place, gone, reinterpret_cast<const char *>(data) + at + 4, come);
    at += 4 + come;
    job.document.text = std::make_shared<const std::string>(text);
    if (told(*lsp::check(job, nullptr, &memory)) != told(*lsp::check(job, nullptr)))
      std::abort();
  }
  return 0;
}
