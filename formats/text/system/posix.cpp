// The operating system: Linux, and others like it.
#include "formats/text/system/system.h"

#include "llvm/Support/Process.h"
#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <map>
#include <thread>

namespace ncvet::system {

void dropPages(const char *first, const char *last) {
  const uintptr_t page = llvm::sys::Process::getPageSizeEstimate();
  const uintptr_t begin = (reinterpret_cast<uintptr_t>(first) + page - 1) / page * page;
  const uintptr_t end = reinterpret_cast<uintptr_t>(last) / page * page;
  if (begin < end)
    ::madvise(reinterpret_cast<void *>(begin), end - begin, MADV_DONTNEED);
}

namespace {

constexpr size_t readStep = 1u << 16;

llvm::Error refuse(std::errc code, const llvm::Twine &why) {
  return llvm::createStringError(std::make_error_code(code), why);
}

llvm::Error fromSystem() {
  const std::error_code code(errno, std::generic_category());
  return llvm::createStringError(code, llvm::Twine(code.message()));
}

/// Closes the descriptor when it is left.
struct Descriptor {
  int number;
  ~Descriptor() { ::close(number); }
};

/// Whether the pipe holds something, or another program has it open to write into it.
bool isWrittenTo(int descriptor) {
  pollfd ready{descriptor, POLLIN, 0};
  if (::poll(&ready, 1, 0) > 0 && (ready.revents & POLLIN))
    return true;
  char byte = 0; // nothing is lost: it is empty
  return ::read(descriptor, &byte, 1) < 0 && errno == EAGAIN;
}

} // namespace

llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readPipe(llvm::StringRef path, uint64_t most) {
  const Descriptor pipe{::open(path.str().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  if (pipe.number < 0)
    return fromSystem();
  if (!isWrittenTo(pipe.number))
    return refuse(std::errc::invalid_argument, "it is a pipe into which nothing writes");
  // From here on its writer is waited for.
  if (::fcntl(pipe.number, F_SETFL, 0) != 0)
    return fromSystem();
  std::string bytes;
  for (;;) {
    const size_t before = bytes.size();
    bytes.resize(before + readStep);
    const ssize_t read = ::read(pipe.number, bytes.data() + before, readStep);
    if (read < 0 && errno != EINTR)
      return fromSystem();
    bytes.resize(before + size_t(std::max<ssize_t>(read, 0)));
    if (bytes.size() > most)
      return refuse(std::errc::file_too_large, "it is too large");
    if (read == 0)
      return llvm::MemoryBuffer::getMemBufferCopy(bytes, path);
  }
}

int standardInput() { return STDIN_FILENO; }
int standardOutput() { return STDOUT_FILENO; }

size_t readSome(int descriptor, char *into, size_t most) {
  ssize_t got = 0;
  do
    got = ::read(descriptor, into, most);
  while (got < 0 && errno == EINTR);
  return size_t(std::max<ssize_t>(got, 0));
}

void ignoreBrokenPipes() { std::signal(SIGPIPE, SIG_IGN); }

bool writeAll(int descriptor, llvm::StringRef bytes) {
  while (!bytes.empty()) {
    const ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
    if (done < 0 && errno == EINTR)
      continue;
    if (done <= 0)
      return false;
    bytes = bytes.drop_front(size_t(done));
  }
  return true;
}

void keepFreedMemory() {
  constexpr int keptBytes = 1 << 30;
  ::mallopt(M_MMAP_THRESHOLD, keptBytes);
  ::mallopt(M_TRIM_THRESHOLD, keptBytes);
}

void giveBackFreeMemory() { ::malloc_trim(0); }

llvm::ArrayRef<const char *> arguments(int count, const char *const *words) {
  return {words, size_t(count)};
}

unsigned processors() { return std::max(1u, std::thread::hardware_concurrency()); }

uint64_t memoryHeld() {
  const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (file < 0)
    return 0;
  char text[128] = {}; // pages of all kinds, the resident ones second
  const ssize_t length = ::read(file, text, sizeof text - 1);
  ::close(file);
  uint64_t pages = 0;
  const llvm::StringRef held =
      llvm::StringRef(text, length > 0 ? size_t(length) : 0).split(' ').second;
  if (held.split(' ').first.getAsInteger(10, pages))
    return 0;
  return pages * uint64_t(::sysconf(_SC_PAGESIZE));
}

double secondsOfThread() {
  timespec used{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return double(used.tv_sec) + double(used.tv_nsec) * 1e-9;
}

namespace {

/// Those that LLVM recovers from.
constexpr int crashSignals[] = {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGTRAP};
using Handler = void (*)(int);
std::array<Handler, NSIG> recover; ///< LLVM's handlers, which jump out of the crash
void (*noteCrash)() = nullptr;
thread_local int crashedBy = 0;

void onCrash(int signal) {
  crashedBy = signal;
  noteCrash();
  recover[size_t(signal)](signal);
}

} // namespace

void noteCrashes(void (*note)()) {
  noteCrash = note;
  for (const int signal : crashSignals) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    if (action.sa_handler == onCrash)
      continue;
    recover[size_t(signal)] = action.sa_handler;
    action.sa_handler = onCrash;
    // Finding out the place may crash as well.
    action.sa_flags |= SA_ONSTACK | SA_NODEFER;
    ::sigaction(signal, &action, nullptr);
  }
}

/// A stack for the handler, which has to run when the thread's own is full.
CrashStack::CrashStack() {
  constexpr size_t size = 128 * 1024;
  memory_ = std::make_unique<char[]>(size);
  stack_t stack{};
  stack.ss_sp = memory_.get();
  stack.ss_size = size;
  ::sigaltstack(&stack, nullptr);
}

CrashStack::~CrashStack() {
  stack_t none{};
  none.ss_flags = SS_DISABLE;
  ::sigaltstack(&none, nullptr);
}

std::string lastCrash() {
  switch (crashedBy) {
  case SIGABRT:
    return "abort";
  case SIGBUS:
    return "bus error";
  case SIGFPE:
    return "arithmetic fault";
  case SIGILL:
    return "illegal instruction";
  case SIGSEGV:
    return "segmentation fault";
  default:
    return "trap";
  }
}

struct FolderEvents::Queue {
  int number;
  std::map<std::string, int> watched; ///< the system's number of each folder
};

FolderEvents::FolderEvents() {
  const int queue = ::inotify_init1(IN_CLOEXEC | IN_NONBLOCK);
  if (queue >= 0)
    queue_ = std::make_unique<Queue>(Queue{queue, {}});
}

FolderEvents::~FolderEvents() {
  if (queue_)
    ::close(queue_->number);
}

void FolderEvents::watch(const std::set<std::string> &folders) {
  constexpr uint32_t changes =
      IN_CLOSE_WRITE | IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO | IN_ONLYDIR;
  if (!queue_)
    return;
  std::map<std::string, int> now;
  // Asking again is harmless, and finds folders that were removed and made again. What cannot be
  // watched, as the system's number of watches is limited, is still looked at from time to time.
  for (const std::string &folder : folders)
    now[folder] = ::inotify_add_watch(queue_->number, folder.c_str(), changes);
  std::set<int> kept;
  for (const auto &[folder, number] : now)
    kept.insert(number);
  for (const auto &[folder, number] : queue_->watched)
    if (number >= 0 && !kept.count(number))
      ::inotify_rm_watch(queue_->number, number);
  queue_->watched = std::move(now);
}

bool FolderEvents::wait(std::chrono::milliseconds longest) {
  if (!queue_) {
    std::this_thread::sleep_for(longest);
    return false;
  }
  pollfd of = {queue_->number, POLLIN, 0};
  if (::poll(&of, 1, int(longest.count())) <= 0)
    return false; // a signal ends it as well
  alignas(inotify_event) char events[16 * 1024];
  return ::read(queue_->number, events, sizeof events) > 0;
}

} // namespace ncvet::system
