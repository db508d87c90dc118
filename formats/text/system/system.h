// What ncvet asks of the operating system beyond LLVM's Support library. One source for each
// system has it all; the build picks one.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/Support/Error.h"
#include "llvm/Support/MemoryBuffer.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <set>
#include <string>

namespace ncvet::system {

/// Gives the whole pages in [begin, end) of a mapped file back; they are read again when touched.
void dropPages(const char *begin, const char *end);

/// The bytes of a pipe into which another program writes, of at most `most`. One into which nothing
/// writes would never end: it fails, with the reason alone as text.
llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readPipe(llvm::StringRef path, uint64_t most);

/// Descriptors of the standard streams, on which bytes arrive as they were sent.
int standardInput();
int standardOutput();
/// Waits for bytes; how many came, 0 at the end or when there will be none.
size_t readSome(int descriptor, char *into, size_t most);
/// Writing to a reader that has gone fails, and does not end the process.
void ignoreBrokenPipes();
/// False when not all of them could be written.
bool writeAll(int descriptor, llvm::StringRef bytes);

/// The heap keeps what is freed, for a program that soon needs as much again.
void keepFreedMemory();
/// Gives memory that nobody holds back to the system.
void giveBackFreeMemory();

/// Bytes of memory that this process holds; 0 where the system does not tell.
uint64_t memoryHeld();

/// The words of the command line in UTF-8, the program's name first. Valid as long as it runs.
llvm::ArrayRef<const char *> arguments(int count, const char *const *words);

/// Threads that run at a time; 1 where the system has none but the first.
unsigned processors();

/// Seconds of a processor that this thread has used; where the system does not tell, those since
/// some moment.
double secondsOfThread();

/// From now on, when this process crashes, `note` is called before LLVM's recovery, which must be
/// on, takes over. It may be called with hardly any stack and a broken heap.
void noteCrashes(void (*note)());
/// Of a thread that is to survive a crash even when its stack is full: made once in it.
class CrashStack {
public:
  CrashStack();
  ~CrashStack();
  CrashStack(const CrashStack &) = delete;

private:
  std::unique_ptr<char[]> memory_;
};
/// What the last crash of this thread was: "segmentation fault".
std::string lastCrash();

/// Changes in folders, as far as the system tells of them.
class FolderEvents {
public:
  FolderEvents();
  ~FolderEvents();
  FolderEvents(const FolderEvents &) = delete;

  /// The folders of which it tells from now on, without those below them.
  void watch(const std::set<std::string> &folders);
  /// Waits so long, or until something has changed in one of them, and says whether it has. Of
  /// folders on a network nobody tells, and some systems tell nothing.
  bool wait(std::chrono::milliseconds longest);

private:
  struct Queue;
  std::unique_ptr<Queue> queue_; ///< null: nobody tells of changes
};

} // namespace ncvet::system
