// Times `ncvet check` as a whole process beside `wc -l` and `wc -w` on the same file in the same
// run.
//
//   ncvet_bench NCVET PROGRAMS.tsv [RUNS]
//
// Every command runs RUNS times (5); the table shows the median time and the largest memory.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

/// What one command took.
struct Measured {
  double seconds = 0;    ///< wall clock, from fork to the end
  double cpuSeconds = 0; ///< user and system time
  long peakKiB = 0;      ///< largest resident set
  bool failed = false;   ///< could not start, was killed, or ended with an unexpected status
};

/// Runs a command once, its output to /dev/null.
Measured runOnce(const std::vector<std::string> &command) {
  std::vector<char *> argv;
  argv.reserve(command.size() + 1);
  for (const std::string &word : command)
    argv.push_back(const_cast<char *>(word.c_str()));
  argv.push_back(nullptr);
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    const int null = open("/dev/null", O_WRONLY);
    dup2(null, STDOUT_FILENO);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  Measured result;
  int status = 0;
  rusage usage{};
  result.failed = child < 0 || wait4(child, &status, 0, &usage) < 0 || !WIFEXITED(status) ||
                  WEXITSTATUS(status) != 0;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  auto seconds = [](const timeval &time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  result.cpuSeconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peakKiB = usage.ru_maxrss;
  return result;
}

/// Median times and the largest memory of several runs; failed when one of them was.
Measured run(const std::vector<std::string> &command, int runs) {
  std::vector<double> wall;
  std::vector<double> cpu;
  Measured result;
  for (int i = 0; i < runs; ++i) {
    const Measured one = runOnce(command);
    result.failed = result.failed || one.failed;
    result.peakKiB = std::max(result.peakKiB, one.peakKiB);
    wall.push_back(one.seconds);
    cpu.push_back(one.cpuSeconds);
  }
  auto median = [](std::vector<double> &values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  result.seconds = median(wall);
  result.cpuSeconds = median(cpu);
  return result;
}

struct Program {
  std::string path;
  std::string name;
  uint64_t blocks = 0;  ///< that the control executes
  double megabytes = 0; ///< 10^6 bytes
};

std::vector<Program> readTable(const std::string &path) {
  std::vector<Program> programs;
  const size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash);
  std::ifstream table(path);
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    Program program;
    struct stat info {};
    if (!(words >> program.name >> program.blocks))
      continue;
    program.path = folder + "/" + program.name;
    if (stat(program.path.c_str(), &info) != 0)
      continue;
    program.megabytes = static_cast<double>(info.st_size) * 1e-6;
    programs.push_back(std::move(program));
  }
  return programs;
}

/// One row of the table. `executed` blocks are counted per second where they are not 0: `wc` reads
/// the blocks of a file, but executes no loop.
void printRow(const Program &program, const char *command, const Measured &measured,
              uint64_t executed, double beside) {
  std::printf("%-18s %-8s %9.1f %9.1f %9.1f", program.name.c_str(), command, measured.seconds * 1e3,
              measured.cpuSeconds * 1e3, program.megabytes / measured.seconds);
  if (executed > 0)
    std::printf(" %11.2f", static_cast<double>(executed) * 1e-6 / measured.seconds);
  else
    std::printf(" %11s", "-");
  std::printf(" %9.1f", static_cast<double>(measured.peakKiB) / 1024.0);
  if (beside > 0)
    std::printf(" %8.1fx", measured.seconds / beside);
  std::printf("%s\n", measured.failed ? "  FAILED" : "");
}

} // namespace

int main(int argc, char **argv) {
  if (argc < 3 || argc > 4) {
    std::fputs("usage: ncvet_bench NCVET PROGRAMS.tsv [RUNS]\n", stderr);
    return 2;
  }
  const std::string ncvet = argv[1];
  const int runs = argc == 4 ? std::max(1, std::atoi(argv[3])) : 5;
  const std::vector<Program> programs = readTable(argv[2]);
  if (programs.empty()) {
    std::fprintf(stderr, "ncvet_bench: no programs in %s\n", argv[2]);
    return 2;
  }
  std::printf("median of %d runs; memory: the largest; 1 MB = 10^6 bytes, 1 MiB = 2^20 bytes\n\n",
              runs);
  std::printf("%-18s %-8s %9s %9s %9s %11s %9s %9s\n", "program", "command", "ms", "CPU ms", "MB/s",
              "Mblocks/s", "MiB", "to wc -l");
  bool failed = false;
  double startMs = 0;
  long startKiB = 0;
  for (const Program &program : programs) {
    const Measured lines = run({"wc", "-l", program.path}, runs);
    const Measured words = run({"wc", "-w", program.path}, runs);
    const Measured check = run({ncvet, "check", "--dialect", "fanuc-0m", "--format", "json",
                                "--fail-on", "never", program.path},
                               runs);
    failed = failed || check.failed;
    printRow(program, "wc -l", lines, 0, 0);
    printRow(program, "wc -w", words, 0, lines.seconds);
    printRow(program, "ncvet", check, program.blocks, lines.seconds);
    if (program.name == "tiny.nc") {
      startMs = check.seconds * 1e3;
      startKiB = check.peakKiB;
    } else if (startKiB > 0) {
      std::printf("%-18s memory above start-up: %.1f MiB\n", "",
                  static_cast<double>(check.peakKiB - startKiB) / 1024.0);
    }
    std::fflush(stdout);
  }
  std::printf("\nstart-up (tiny.nc): %.1f ms, %.1f MiB\n", startMs,
              static_cast<double>(startKiB) / 1024.0);
  return failed ? 1 : 0;
}
