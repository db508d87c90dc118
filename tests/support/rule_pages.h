// The programs in the rules' pages: fenced blocks that say for which dialect they are right or
// wrong.
#pragma once

#include "tests/support/run_program.h"

namespace ncvet::test {

/// A fenced program of a rule's page.
struct PageProgram {
  std::string rule;
  std::string dialect;
  bool wrong = false;
  unsigned count = 0; ///< of this dialect and kind in the page, from 1
  std::string machine;
  std::vector<ProgramFile> files; ///< the first one is analysed
  std::string problem;            ///< what is wrong with the fence itself

  std::string name() const {
    std::string text =
        rule + "_" + dialect + (wrong ? "_wrong_" : "_right_") + std::to_string(count);
    std::replace_if(
        text.begin(), text.end(), [](char c) { return !isalnum(uint8_t(c)); }, '_');
    return text;
  }
};

/// Shown by the test runner in place of the object's bytes.
inline void PrintTo(const PageProgram &program, std::ostream *out) { *out << program.name(); }

/// The dialects that a page's metadata claims.
inline std::vector<std::string> claimedDialects(llvm::StringRef page) {
  std::vector<std::string> dialects;
  llvm::StringRef head = page.split("```json").second.split("```").first;
  llvm::StringRef list = head.split("\"dialects\"").second.split('[').second.split(']').first;
  while (!list.empty()) {
    const auto [name, rest] = list.split('"').second.split('"');
    if (!name.empty())
      dialects.push_back(name.str());
    list = rest;
  }
  return dialects;
}

inline std::vector<PageProgram> programsOf(const RuleInfo &rule) {
  std::vector<PageProgram> programs;
  std::map<std::string, unsigned> counts;
  PageProgram *open = nullptr;
  for (const std::string &line : linesOf(rule.help.str())) {
    if (line.rfind("```", 0) == 0) {
      if (open || line.rfind("```nc", 0) != 0) {
        open = nullptr;
        continue;
      }
      open = &programs.emplace_back();
      open->rule = rule.id.str();
      const llvm::StringRef info = llvm::StringRef(line).drop_front(5).trim();
      const auto [dialect, rest] = info.split(' ');
      const auto [kind, tail] = rest.trim().split(' ');
      open->dialect = dialect.str();
      open->wrong = kind == "wrong";
      if (kind != "wrong" && kind != "right")
        open->problem = "a fence is `nc <dialect> wrong|right`: " + line;
      llvm::StringRef machine = tail.trim();
      if (machine.consume_front("machine="))
        open->machine = machine.str();
      else if (!machine.empty())
        open->problem = "unknown words in a fence: " + line;
      open->count = ++counts[open->dialect + kind.str()];
      open->files.push_back({"PROGRAM.nc", ""});
      continue;
    }
    if (!open)
      continue;
    if (line.rfind("=== ", 0) == 0) {
      const std::string name = line.substr(4);
      if (open->files.size() == 1 && open->files[0].text.empty())
        open->files[0].name = name;
      else
        open->files.push_back({name, ""});
      continue;
    }
    open->files.back().text += line + "\n";
  }
  return programs;
}

inline std::vector<PageProgram> allPagePrograms() {
  std::vector<PageProgram> all;
  for (const RuleEntry &entry : allRules())
    for (PageProgram &program : programsOf(entry.info))
      all.push_back(std::move(program));
  return all;
}

} // namespace ncvet::test
