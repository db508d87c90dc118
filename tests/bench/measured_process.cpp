// Starts a command and measures it.
#include "measured_process.h"

#include <fcntl.h>
#include <linux/perf_event.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>

namespace ncvet::bench {

namespace {

std::vector<char *> argumentsOf(const std::vector<std::string> &command) {
  std::vector<char *> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string &word : command)
    arguments.push_back(const_cast<char *>(word.c_str()));
  arguments.push_back(nullptr);
  return arguments;
}

/// A counter of the instructions that a process executes from its next `exec` on; negative where
/// the machine has none, or does not allow it.
int openCounter(pid_t process) {
  perf_event_attr wanted{};
  wanted.type = PERF_TYPE_HARDWARE;
  wanted.size = sizeof wanted;
  wanted.config = PERF_COUNT_HW_INSTRUCTIONS;
  wanted.disabled = wanted.enable_on_exec = wanted.inherit = 1;
  wanted.exclude_kernel = wanted.exclude_hv = 1;
  return int(syscall(SYS_perf_event_open, &wanted, process, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

[[noreturn]] void becomeCommand(const std::vector<char *> &arguments, int gate) {
  char go = 0;
  while (read(gate, &go, 1) < 0) {
  }
  const int null = open("/dev/null", O_WRONLY);
  dup2(null, STDOUT_FILENO);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

double secondsOf(const timeval &time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

} // namespace

Measured runOnce(const std::vector<std::string> &command) {
  const std::vector<char *> arguments = argumentsOf(command);
  Measured result;
  int gate[2]; // the child waits until its instructions are counted
  if (pipe2(gate, O_CLOEXEC) != 0) {
    result.failed = true;
    return result;
  }
  const pid_t child = fork();
  if (child == 0)
    becomeCommand(arguments, gate[0]);
  const int counter = child > 0 ? openCounter(child) : -1;
  const auto begin = std::chrono::steady_clock::now();
  result.failed = child < 0 || write(gate[1], "", 1) != 1;
  int status = 0;
  rusage usage{};
  result.failed = result.failed || wait4(child, &status, 0, &usage) < 0 || !WIFEXITED(status) ||
                  WEXITSTATUS(status) != 0;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  result.cpuSeconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
  result.peakKiB = usage.ru_maxrss;
  if (counter >= 0) {
    if (read(counter, &result.instructions, sizeof result.instructions) !=
        ssize_t(sizeof result.instructions))
      result.instructions = 0;
    close(counter);
  }
  close(gate[0]);
  close(gate[1]);
  return result;
}

uint64_t countByCallgrind(const std::vector<std::string> &command) {
  std::string line = "valgrind --tool=callgrind --callgrind-out-file=/dev/null";
  for (const std::string &word : command)
    line += " '" + word + "'"; // paths of this project's own making: no quotes in them
  line += " 2>&1 >/dev/null";
  std::FILE *const output = popen(line.c_str(), "r");
  if (!output)
    return 0;
  uint64_t collected = 0;
  char text[512];
  while (std::fgets(text, sizeof text, output))
    if (const char *const found = std::strstr(text, "Collected : "))
      collected = std::strtoull(found + std::strlen("Collected : "), nullptr, 10);
  pclose(output);
  return collected;
}

} // namespace ncvet::bench
