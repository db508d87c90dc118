// Puts files that call one another into an order in which callers come first.
#include "analyzer/cli/call_groups.h"

#include "analyzer/program/call_reading.h"

#include "llvm/ADT/EquivalenceClasses.h"
#include "llvm/Support/Path.h"

#include <algorithm>
#include <map>
#include <set>

namespace ncvet::cli {

namespace {

/// What calls may name the file by: its name, and the programs in it.
std::set<std::string> namesOf(const SourceFile &file, const Dialect &dialect) {
  std::set<std::string> names;
  llvm::StringRef stem = llvm::sys::path::stem(file.path());
  names.insert(stem.upper());
  stem.consume_front("%");
  stem.consume_front_insensitive("O");
  if (uint32_t number = 0; !stem.empty() && !stem.getAsInteger(10, number))
    names.insert(std::to_string(number));
  const std::unique_ptr<Reader> reader = makeReader(dialect, file.text());
  const FileIndex index(file, *reader, dialect);
  for (const ProgramInfo &program : index.programs()) {
    if (program.number >= 0)
      names.insert(std::to_string(program.number));
    if (!program.name.empty())
      names.insert(program.name);
  }
  return names;
}

/// Which of the jobs each one calls, by their numbers.
std::vector<std::vector<size_t>> calledBy(llvm::ArrayRef<Job *> jobs, Session &session) {
  std::vector<std::set<std::string>> calls(jobs.size());
  std::multimap<std::string, size_t> named;
  for (size_t i = 0; i < jobs.size(); ++i) {
    const SourceFile &file = *jobs[i]->source;
    auto setup = session.setup(file.path(), file.text());
    if (!setup) { // its check tells
      llvm::consumeError(setup.takeError());
      continue;
    }
    calls[i] = readCallsOf(file, *setup->dialect).calls;
    for (const std::string &name : namesOf(file, *setup->dialect))
      named.emplace(name, i);
  }
  std::vector<std::vector<size_t>> called(jobs.size());
  for (size_t i = 0; i < jobs.size(); ++i)
    for (const std::string &name : calls[i]) {
      const auto [begin, end] = named.equal_range(name);
      for (auto at = begin; at != end; ++at)
        called[i].push_back(at->second);
    }
  return called;
}

/// An order in which callers come before what they call.
std::vector<size_t> callersFirst(const std::vector<std::vector<size_t>> &called) {
  std::vector<bool> seen(called.size());
  std::vector<size_t> order;                   // what is called first, to begin with
  std::vector<std::pair<size_t, size_t>> path; // files, and how many of its calls were looked at
  for (size_t i = called.size(); i-- > 0;) {
    if (!seen[i])
      path.emplace_back(i, 0);
    seen[i] = true;
    while (!path.empty()) {
      auto &[file, looked] = path.back();
      if (looked == called[file].size()) {
        order.push_back(file);
        path.pop_back();
      } else if (const size_t next = called[file][looked++]; !seen[next]) {
        seen[next] = true;
        path.emplace_back(next, 0);
      }
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

} // namespace

std::vector<std::vector<Job *>> groupsByCalls(llvm::ArrayRef<Job *> jobs, Session &session) {
  const std::vector<std::vector<size_t>> called = calledBy(jobs, session);
  llvm::EquivalenceClasses<size_t> together;
  for (size_t i = 0; i < jobs.size(); ++i) {
    together.insert(i);
    for (const size_t other : called[i])
      together.unionSets(i, other);
  }
  std::vector<std::vector<Job *>> groups;
  std::map<size_t, size_t> numbers; ///< of groups, by the leader of the files
  for (const size_t i : callersFirst(called)) {
    const auto [at, fresh] = numbers.try_emplace(together.getLeaderValue(i), groups.size());
    if (fresh)
      groups.emplace_back();
    groups[at->second].push_back(jobs[i]);
  }
  return groups;
}

} // namespace ncvet::cli
