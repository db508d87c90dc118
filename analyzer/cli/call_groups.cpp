// Puts files that call one another into an order in which callers come first.
#include "analyzer/cli/call_groups.h"

#include "analyzer/program/block_reading.h"
#include "analyzer/program/call_reading.h"
#include "analyzer/program/flow_shape.h"
#include "formats/readers/table_words.h"

#include "llvm/ADT/EquivalenceClasses.h"
#include "llvm/ADT/SCCIterator.h"
#include "llvm/Support/Path.h"

#include <algorithm>
#include <map>
#include <set>

namespace ncvet::cli {

namespace {

/// A file, and those that it calls.
struct Caller {
  Job *job = nullptr;
  std::set<std::string> calls; ///< names
  bool isStraight = false;     ///< all that it calls is called by each run of it
  std::vector<size_t> called;  ///< their numbers, of all files that a name may mean
  std::vector<size_t> surely; ///< of those that the control takes, as far as they are in its folder
};

/// What calls may name the file by: its name, and the programs in it.
std::set<std::string> namesOf(const SourceFile &file, const FileIndex &index) {
  std::set<std::string> names;
  llvm::StringRef stem = llvm::sys::path::stem(file.path());
  names.insert(stem.upper());
  stem.consume_front("%");
  stem.consume_front_insensitive("O");
  if (uint32_t number = 0; !stem.empty() && !stem.getAsInteger(10, number))
    names.insert(std::to_string(number));
  for (const ProgramInfo &program : index.programs()) {
    if (program.number >= 0)
      names.insert(std::to_string(program.number));
    if (!program.name.empty())
      names.insert(program.name);
  }
  return names;
}

bool endsRun(const Block &block, const Dialect &dialect) {
  return llvm::any_of(block.words, [&](const Word &word) {
    const CodeIndex code = codeOf(dialect, word);
    if (code == noCode)
      return false;
    const Action action = dialect.codes[code].action;
    return action == Action::Return || action == Action::ProgramEnd ||
           action == Action::ProgramEndRewind;
  });
}

/// Whether the file is one program in which nothing decides what is run.
bool runsStraight(const FileIndex &index, const Reader &reader, const Dialect &dialect) {
  if (index.programs().size() != 1 || !index.subprograms().empty())
    return false;
  const ProgramInfo &program = index.programs().front();
  if (readShape(reader, program.begin, program.end).branches)
    return false;
  bool ended = false;
  for (const Block &block : blocks(reader, program.begin, program.end)) {
    if (block.skip >= 0 || (ended && !block.isEmpty()))
      return false;
    ended |= endsRun(block, dialect);
  }
  return true;
}

/// The file of the caller's folder that a call names; empty: there is none.
std::string fileNamed(ProgramFolders &folders, llvm::StringRef caller, llvm::StringRef name) {
  const llvm::StringRef folder = llvm::sys::path::parent_path(caller);
  const ProgramFolders::Programs &programs =
      folders.programs(folder.empty() ? std::string(".") : folder.str());
  if (int64_t number = 0; !name.getAsInteger(10, number))
    if (const auto file = programs.byNumber.find(number); file != programs.byNumber.end())
      return file->second;
  const auto file = programs.byName.find(name);
  return file == programs.byName.end() ? std::string() : file->second;
}

/// The jobs, and which of them each one calls.
std::vector<Caller> callersOf(llvm::ArrayRef<Job *> jobs, Session &session) {
  std::vector<Caller> callers(jobs.size());
  std::multimap<std::string, size_t> named;
  for (size_t i = 0; i < jobs.size(); ++i) {
    Caller &caller = callers[i];
    caller.job = jobs[i];
    const SourceFile &file = *jobs[i]->source;
    auto setup = session.setup(file.path(), file.text());
    if (!setup) { // its check tells
      llvm::consumeError(setup.takeError());
      continue;
    }
    const Dialect &dialect = *setup->dialect;
    const std::unique_ptr<Reader> reader = makeReader(dialect, file.text());
    const FileIndex index(file, *reader, dialect);
    caller.calls = readCallsOf(file, dialect).calls;
    caller.isStraight = runsStraight(index, *reader, dialect);
    for (const std::string &name : namesOf(file, index))
      named.emplace(name, i);
  }
  for (Caller &caller : callers)
    for (const std::string &name : caller.calls) {
      const std::string taken = fileNamed(*session.folders(), caller.job->source->path(), name);
      const auto [begin, end] = named.equal_range(name);
      for (auto at = begin; at != end; ++at) {
        caller.called.push_back(at->second);
        if (callers[at->second].job->source->path() == taken)
          caller.surely.push_back(at->second);
      }
    }
  return callers;
}

/// An order in which callers come before what they call.
std::vector<size_t> callersFirst(const std::vector<Caller> &callers) {
  std::vector<bool> seen(callers.size());
  std::vector<size_t> order;                   // what is called first, to begin with
  std::vector<std::pair<size_t, size_t>> path; // files, and how many of its calls were looked at
  for (size_t i = callers.size(); i-- > 0;) {
    if (!seen[i])
      path.emplace_back(i, 0);
    seen[i] = true;
    while (!path.empty()) {
      auto &[file, looked] = path.back();
      if (looked == callers[file].called.size()) {
        order.push_back(file);
        path.pop_back();
      } else if (const size_t next = callers[file].called[looked++]; !seen[next]) {
        seen[next] = true;
        path.emplace_back(next, 0);
      }
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

/// A file in which nothing decides what is called, and those of them that it calls.
struct StraightCaller {
  const Job *job = nullptr; ///< null: the one that calls all of them
  std::vector<StraightCaller *> called;
};

} // namespace
} // namespace ncvet::cli

template <>
struct llvm::GraphTraits<ncvet::cli::StraightCaller *> {
  using NodeRef = ncvet::cli::StraightCaller *;
  using ChildIteratorType = std::vector<NodeRef>::iterator;
  static NodeRef getEntryNode(NodeRef node) { return node; }
  static ChildIteratorType child_begin(NodeRef node) { return node->called.begin(); }
  static ChildIteratorType child_end(NodeRef node) { return node->called.end(); }
};

namespace ncvet::cli {

namespace {

/// Calls `visit` with the jobs of each circle of calls that never ends.
void forEachCircle(const std::vector<Caller> &callers,
                   llvm::function_ref<void(llvm::ArrayRef<StraightCaller *>)> visit) {
  std::vector<StraightCaller> straight(callers.size());
  StraightCaller all;
  for (size_t i = 0; i < callers.size(); ++i) {
    straight[i].job = callers[i].job;
    if (callers[i].isStraight)
      all.called.push_back(&straight[i]);
    for (const size_t called : callers[i].surely)
      if (callers[i].isStraight && callers[called].isStraight)
        straight[i].called.push_back(&straight[called]);
  }
  for (auto circle = llvm::scc_begin(&all); !circle.isAtEnd(); ++circle)
    if (circle.hasCycle())
      visit(*circle);
}

} // namespace

std::vector<CallGroup> groupsByCalls(llvm::ArrayRef<Job *> jobs, Session &session) {
  const std::vector<Caller> callers = callersOf(jobs, session);
  llvm::EquivalenceClasses<size_t> together;
  for (size_t i = 0; i < jobs.size(); ++i) {
    together.insert(i);
    for (const size_t other : callers[i].called)
      together.unionSets(i, other);
  }
  std::vector<CallGroup> groups;
  std::map<size_t, size_t> numbers; ///< of groups, by the leader of the files
  std::map<const Job *, size_t> groupOf;
  for (const size_t i : callersFirst(callers)) {
    const auto [at, fresh] = numbers.try_emplace(together.getLeaderValue(i), groups.size());
    if (fresh)
      groups.emplace_back();
    groups[at->second].jobs.push_back(jobs[i]);
    groupOf[jobs[i]] = at->second;
  }
  forEachCircle(callers, [&](llvm::ArrayRef<StraightCaller *> circle) {
    auto paths = std::make_shared<std::vector<std::string>>();
    for (const StraightCaller *caller : circle)
      paths->push_back(caller->job->source->path());
    llvm::sort(*paths);
    for (const StraightCaller *caller : circle)
      groups[groupOf[caller->job]].circles[caller->job] = paths;
  });
  return groups;
}

} // namespace ncvet::cli
