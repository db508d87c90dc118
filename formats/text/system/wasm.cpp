// The operating system: what a WebAssembly module gets from Node or a browser.
#include "formats/text/system/system.h"

#include <sys/resource.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <thread>

namespace ncvet::system {

/// Files are copied into memory.
void dropPages(const char *, const char *) {}

llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readPipe(llvm::StringRef, uint64_t) {
  return llvm::createStringError(std::make_error_code(std::errc::invalid_argument),
                                 "it is not a regular file");
}

int standardInput() { return STDIN_FILENO; }
int standardOutput() { return STDOUT_FILENO; }

size_t readSome(int descriptor, char *into, size_t most) {
  return size_t(std::max<ssize_t>(::read(descriptor, into, most), 0));
}

void ignoreBrokenPipes() {}

bool writeAll(int descriptor, llvm::StringRef bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
    if (done <= 0)
      return false;
    bytes = bytes.drop_front(size_t(done));
  }
  return true;
}

void keepFreedMemory() {}
void giveBackFreeMemory() {}

llvm::ArrayRef<const char *> arguments(int count, const char *const *words) {
  return {words, size_t(count)};
}

unsigned processors() { return 1; }

uint64_t memoryHeld() { return uint64_t(__builtin_wasm_memory_size(0)) << 16; }

double secondsOfThread() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A crash ends the module: its host is told, and nothing of it can go on.
void noteCrashes(void (*)()) {}
CrashStack::CrashStack() = default;
CrashStack::~CrashStack() = default;
std::string lastCrash() { return "abort"; }

struct FolderEvents::Queue {};
FolderEvents::FolderEvents() = default;
FolderEvents::~FolderEvents() = default;
void FolderEvents::watch(const std::set<std::string> &) {}
bool FolderEvents::wait(std::chrono::milliseconds longest) {
  std::this_thread::sleep_for(longest);
  return false;
}

} // namespace ncvet::system

/// LLVM waits for other programs by it; there are none, and emscripten does not have it.
extern "C" pid_t wait4(pid_t, int *, int, struct rusage *) {
  errno = ECHILD;
  return -1;
}
