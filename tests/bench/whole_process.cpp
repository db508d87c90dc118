// Times `ncvet check` as a whole process beside `wc -w` on the same file in the same run.
//
//   ncvet_bench NCVET PROGRAMS.tsv [--runs N] [--against OTHER] [--instructions]
//   ncvet_bench NCVET rs274.tsv --interpreter [--runs N]
//
// The commands run in turn, N times (5): `wc -w`, ncvet, and with --against the other binary. The
// table shows medians; a unit is the CPU time of `wc -w`. --instructions counts them where the
// machine does not, which takes minutes. --interpreter: in turn with LinuxCNC's `rs274`, which
// interprets the same programs.
#include "measured_process.h"
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

namespace {

using namespace ncvet::bench;

struct Program {
  std::string path;
  std::string name;
  uint64_t blocks = 0; ///< that the control executes
  std::string dialect;
  std::string goal; ///< what is aimed at, in words; empty: nothing
};

struct Options {
  std::string ncvet, programs, other;
  int runs = 5;
  bool instructions = false;
  bool interpreter = false; ///< beside LinuxCNC's
};

std::vector<Program> readTable(const std::string &path) {
  std::vector<Program> programs;
  const size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash);
  std::ifstream table(path);
  for (std::string line; std::getline(table, line);) {
    std::istringstream columns(line);
    Program program;
    if (!(columns >> program.name >> program.blocks >> program.dialect))
      continue;
    std::getline(columns >> std::ws, program.goal);
    program.path = folder + "/" + program.name;
    programs.push_back(std::move(program));
  }
  return programs;
}

std::vector<std::string> checkBy(const std::string &ncvet, const Program &program) {
  return {ncvet,  "check",     "--dialect", program.dialect, "--format",
          "json", "--fail-on", "never",     program.path};
}

/// Several runs of one command.
class Runs {
public:
  void add(const Measured &one) { all_.push_back(one); }

  /// The median of its CPU times, in seconds.
  double cpu() const {
    std::vector<double> times = sorted();
    return times[times.size() / 2];
  }
  /// How far its CPU times are from each other: half of the range that the middle half of them
  /// covers, as a share of the median.
  double noise() const {
    const std::vector<double> times = sorted();
    return (times[times.size() * 3 / 4] - times[times.size() / 4]) / 2 / cpu();
  }
  long peakKiB() const {
    long most = 0;
    for (const Measured &one : all_)
      most = std::max(most, one.peakKiB);
    return most;
  }
  uint64_t instructions() const { return all_.front().instructions; }
  bool failed() const {
    return std::any_of(all_.begin(), all_.end(), [](const Measured &one) { return one.failed; });
  }

private:
  std::vector<double> sorted() const {
    std::vector<double> times;
    for (const Measured &one : all_)
      times.push_back(one.cpuSeconds);
    std::sort(times.begin(), times.end());
    return times;
  }

  std::vector<Measured> all_;
};

/// What the start of the process takes, from a program of a few lines.
struct Start {
  long peakKiB = 0;
  uint64_t instructions = 0;
};

void printRow(const Program &program, const Runs &words, const Runs &check, uint64_t instructions,
              const Start &start) {
  const double seconds = check.cpu();
  std::printf("%-18s %8llu %9.1f %9.1f %7.2f %10.2f", program.name.c_str(),
              static_cast<unsigned long long>(program.blocks), words.cpu() * 1e3, seconds * 1e3,
              seconds / words.cpu(), static_cast<double>(program.blocks) * 1e-6 / seconds);
  if (instructions > start.instructions)
    std::printf(" %12.0f", static_cast<double>(instructions - start.instructions) /
                               static_cast<double>(program.blocks));
  else
    std::printf(" %12s", "-");
  std::printf(" %7.1f  %s%s\n", static_cast<double>(check.peakKiB()) / 1024.0, program.goal.c_str(),
              check.failed() ? "  FAILED" : "");
}

/// The other binary beside this one; what is within the noise is said to be so.
void printComparison(const Runs &words, const Runs &check, const Runs &other) {
  const double ratio = other.cpu() / check.cpu();
  const double noise = check.noise() + other.noise();
  const bool told = std::fabs(std::log(ratio)) > 2 * noise;
  std::printf("%-18s %8s %9s %9.1f %7.2f   %5.2f times as fast%s (noise %.0f %%), %+.1f MiB%s\n",
              "  other binary", "", "", other.cpu() * 1e3, other.cpu() / words.cpu(), ratio,
              told ? "" : ", no more than noise", noise * 100,
              static_cast<double>(check.peakKiB() - other.peakKiB()) / 1024.0,
              other.failed() ? "  FAILED" : "");
}

/// By control: its table is a part of what is started. Of controls without a program of their own
/// the first one counts.
class Starts {
public:
  Start &of(const Program &program) {
    const bool isOwn = program.name.starts_with("tiny.");
    if (isOwn && first_.empty())
      first_ = program.dialect;
    return byDialect_[isOwn || byDialect_.count(program.dialect) ? program.dialect : first_];
  }

private:
  std::map<std::string, Start> byDialect_;
  std::string first_;
};

bool measure(const Options &options, const Program &program, Start &start) {
  Runs words, check, other;
  for (int i = 0; i < options.runs; ++i) {
    words.add(runOnce({"wc", "-w", program.path}));
    check.add(runOnce(checkBy(options.ncvet, program)));
    if (!options.other.empty())
      other.add(runOnce(checkBy(options.other, program)));
  }
  uint64_t instructions = check.instructions();
  if (!instructions && options.instructions)
    instructions = countByCallgrind(checkBy(options.ncvet, program));
  printRow(program, words, check, instructions, start);
  if (!options.other.empty())
    printComparison(words, check, other);
  if (!start.peakKiB)
    start = {check.peakKiB(), instructions};
  std::fflush(stdout);
  return !check.failed() && (options.other.empty() || !other.failed());
}

/// `rs274` on the program; false: one of the two has failed.
bool measureBesideInterpreter(const Options &options, const Program &program) {
  const std::string folder = program.path.substr(0, program.path.size() - program.name.size());
  Runs check, interpreter;
  for (int i = 0; i < options.runs; ++i) {
    // What it says of its state is thrown away.
    interpreter.add(runOnce({"sh", "-c", "exec rs274 -g -t \"$1\" -v \"$2\" \"$3\" 2>/dev/null",
                             "sh", folder + "rs274.tbl", folder + "rs274.var", program.path}));
    check.add(runOnce(checkBy(options.ncvet, program)));
  }
  const bool failed = check.failed() || interpreter.failed();
  std::printf("%-18s %8llu %9.1f %9.1f %7.1f %7s%s\n", program.name.c_str(),
              static_cast<unsigned long long>(program.blocks), interpreter.cpu() * 1e3,
              check.cpu() * 1e3, interpreter.cpu() / check.cpu(), program.goal.c_str(),
              failed ? "  FAILED" : "");
  std::fflush(stdout);
  return !failed;
}

bool besideInterpreter(const Options &options, const std::vector<Program> &programs) {
  std::printf("CPU time, median of %d runs, beside LinuxCNC's rs274 on the same files\n\n",
              options.runs);
  if (runOnce({"sh", "-c", "command -v rs274"}).failed) {
    std::printf("rs274 is not installed: nothing to compare with\n");
    return true;
  }
  std::printf("%-18s %8s %9s %9s %7s %7s\n", "program", "blocks", "rs274 ms", "ncvet ms", "times",
              "goal");
  bool good = true;
  for (const Program &program : programs)
    good &= measureBesideInterpreter(options, program);
  return good;
}

bool readOptions(int argc, char **argv, Options &options) {
  if (argc < 3)
    return false;
  options.ncvet = argv[1];
  options.programs = argv[2];
  for (int i = 3; i < argc; ++i) {
    const std::string option = argv[i];
    if (option == "--instructions")
      options.instructions = true;
    else if (option == "--interpreter")
      options.interpreter = true;
    else if (option == "--runs" && i + 1 < argc)
      options.runs = std::max(1, std::atoi(argv[++i]));
    else if (option == "--against" && i + 1 < argc)
      options.other = argv[++i];
    else
      return false;
  }
  return true;
}

} // namespace

int main(int argc, char **argv) {
  Options options;
  if (!readOptions(argc, argv, options)) {
    std::fputs("usage: ncvet_bench NCVET PROGRAMS.tsv [--runs N] [--against OTHER] "
               "[--instructions | --interpreter]\n",
               stderr);
    return 2;
  }
  const std::vector<Program> programs = readTable(options.programs);
  if (programs.empty()) {
    std::fprintf(stderr, "ncvet_bench: no programs in %s\n", options.programs.c_str());
    return 2;
  }
  if (options.interpreter)
    return besideInterpreter(options, programs) ? 0 : 1;
  std::printf("CPU time, median of %d runs; memory: the largest; units: of wc -w on the same file\n"
              "instructions per block: without those of the start\n\n",
              options.runs);
  std::printf("%-18s %8s %9s %9s %7s %10s %12s %7s  %s\n", "program", "blocks", "wc -w ms",
              "ncvet ms", "units", "Mblocks/s", "instr/block", "MiB", "goal");
  bool failed = false;
  Starts starts;
  for (const Program &program : programs)
    failed |= !measure(options, program, starts.of(program));
  return failed ? 1 : 0;
}
