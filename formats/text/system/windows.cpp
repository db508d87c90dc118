// The operating system: Windows.
#include "formats/text/system/system.h"

#include "llvm/Support/ConvertUTF.h"
#include <fcntl.h>
#include <io.h>
#include <windows.h> // with the shell

#include <algorithm>
#include <cerrno>
#include <cwchar>
#include <string>
#include <thread>
#include <vector>

#define PSAPI_VERSION 2 // in the system's own library
#include <psapi.h>      // needs windows.h before it

namespace ncvet::system {

/// Pages of a mapped file leave the working set by themselves when memory is short.
void dropPages(const char *, const char *) {}

/// Named pipes are in a name space of their own here, and no files of a folder.
llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readPipe(llvm::StringRef, uint64_t) {
  return llvm::createStringError(std::make_error_code(std::errc::invalid_argument),
                                 "it is not a regular file");
}

namespace {

/// Without this, line ends are translated and a byte 26 ends the input.
int asBytes(int descriptor) {
  ::_setmode(descriptor, _O_BINARY);
  return descriptor;
}

} // namespace

int standardInput() { return asBytes(0); }
int standardOutput() { return asBytes(1); }

size_t readSome(int descriptor, char *into, size_t most) {
  const int got = ::_read(descriptor, into, unsigned(std::min<size_t>(most, INT_MAX)));
  return size_t(std::max(got, 0));
}

void ignoreBrokenPipes() {}

bool writeAll(int descriptor, llvm::StringRef bytes) {
  while (!bytes.empty()) {
    const int done =
        ::_write(descriptor, bytes.data(), unsigned(std::min<size_t>(bytes.size(), INT_MAX)));
    if (done <= 0)
      return false;
    bytes = bytes.drop_front(size_t(done));
  }
  return true;
}

void keepFreedMemory() {}
void giveBackFreeMemory() {}

/// The run time library gives them in the code page of the machine, which lacks most letters.
llvm::ArrayRef<const char *> arguments(int, const char *const *) {
  static std::vector<std::string> texts;
  static std::vector<const char *> words;
  int count = 0;
  wchar_t **const wide = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  for (int i = 0; i < count; ++i) {
    std::string &text = texts.emplace_back();
    const auto *const bytes = reinterpret_cast<const char *>(wide[i]);
    llvm::convertUTF16ToUTF8String(llvm::ArrayRef<char>(bytes, 2 * ::wcslen(wide[i])), text);
  }
  ::LocalFree(wide);
  for (const std::string &text : texts)
    words.push_back(text.c_str());
  return words;
}

unsigned processors() { return std::max(1u, std::thread::hardware_concurrency()); }

uint64_t memoryHeld() {
  PROCESS_MEMORY_COUNTERS counters{};
  const bool told =
      ::K32GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters) != 0;
  return told ? counters.WorkingSetSize : 0;
}

double secondsOfThread() {
  FILETIME begun, ended, kernel, user;
  if (!::GetThreadTimes(::GetCurrentThread(), &begun, &ended, &kernel, &user))
    return 0;
  const auto ticks = [](const FILETIME &time) { // of 100 ns
    return double(uint64_t(time.dwHighDateTime) << 32 | time.dwLowDateTime);
  };
  return (ticks(kernel) + ticks(user)) * 1e-7;
}

namespace {

void (*noteCrash)() = nullptr;
thread_local DWORD crashedBy = 0;

/// Exceptions that end a program; others are how a debugger or the run time library talk.
bool isCrash(DWORD code) {
  switch (code) {
  case EXCEPTION_ACCESS_VIOLATION:
  case EXCEPTION_ARRAY_BOUNDS_EXCEEDED:
  case EXCEPTION_ILLEGAL_INSTRUCTION:
  case EXCEPTION_IN_PAGE_ERROR:
  case EXCEPTION_INT_DIVIDE_BY_ZERO:
  case EXCEPTION_PRIV_INSTRUCTION:
  case EXCEPTION_STACK_OVERFLOW:
    return true;
  default:
    return false;
  }
}

LONG CALLBACK onException(PEXCEPTION_POINTERS exception) {
  const DWORD code = exception->ExceptionRecord->ExceptionCode;
  if (isCrash(code)) {
    crashedBy = code;
    noteCrash();
  }
  return EXCEPTION_CONTINUE_SEARCH; // LLVM's recovery comes next
}

} // namespace

void noteCrashes(void (*note)()) {
  const bool first = !noteCrash;
  noteCrash = note;
  if (first)
    ::AddVectoredExceptionHandler(/*First=*/1, onException);
}

/// So many bytes of the stack are kept for what handles that it is full.
CrashStack::CrashStack() {
  ULONG kept = 128 * 1024;
  ::SetThreadStackGuarantee(&kept);
}
CrashStack::~CrashStack() = default;

std::string lastCrash() {
  switch (crashedBy) {
  case EXCEPTION_ACCESS_VIOLATION:
  case EXCEPTION_IN_PAGE_ERROR:
    return "access violation";
  case EXCEPTION_STACK_OVERFLOW:
    return "stack overflow";
  case EXCEPTION_INT_DIVIDE_BY_ZERO:
    return "arithmetic fault";
  case EXCEPTION_ILLEGAL_INSTRUCTION:
  case EXCEPTION_PRIV_INSTRUCTION:
    return "illegal instruction";
  default:
    return "abort";
  }
}

struct FolderEvents::Queue {};
FolderEvents::FolderEvents() = default;
FolderEvents::~FolderEvents() = default;
void FolderEvents::watch(const std::set<std::string> &) {}
bool FolderEvents::wait(std::chrono::milliseconds longest) {
  std::this_thread::sleep_for(longest);
  return false;
}

} // namespace ncvet::system
