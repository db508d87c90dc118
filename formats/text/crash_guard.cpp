// Crash guard: LLVM's crash recovery, made to tell where the crash was and to survive a full stack.
#include "formats/text/crash_guard.h"

#include "llvm/Support/CrashRecoveryContext.h"
#include "llvm/Support/raw_ostream.h"

#include <array>
#include <csignal>
#include <cstring>
#include <exception>
#include <memory>

namespace ncvet {

namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif
#else
constexpr bool sanitized = false;
#endif

/// Those that LLVM recovers from.
constexpr int crashSignals[] = {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGTRAP};
using Handler = void (*)(int);
std::array<Handler, NSIG> recover; ///< LLVM's handlers, which jump out of the crash

/// What is known of the last crash of a thread. Nothing in it allocates.
struct Crash {
  int signal;
  bool noting; ///< its place is being found out: another crash meanwhile ends that
  char place[256];
};
thread_local Crash crash;

/// Writes into a fixed buffer; what does not fit is lost.
class PlaceStream : public llvm::raw_ostream {
public:
  explicit PlaceStream(llvm::MutableArrayRef<char> buffer) : buffer_(buffer) { SetUnbuffered(); }

private:
  void write_impl(const char *bytes, size_t size) override {
    size = std::min(size, buffer_.size() - 1 - length_);
    std::memcpy(buffer_.data() + length_, bytes, size);
    length_ += size;
    buffer_[length_] = '\0';
  }
  uint64_t current_pos() const override { return length_; }

  llvm::MutableArrayRef<char> buffer_;
  size_t length_ = 0;
};

void notePlace() {
  if (crash.noting)
    return;
  crash.noting = true;
  crash.place[0] = '\0';
  // The innermost entry is the nearest place.
  if (const void *innermost = llvm::SavePrettyStackState()) {
    PlaceStream out(crash.place);
    static_cast<const llvm::PrettyStackTraceEntry *>(innermost)->print(out);
  }
}

void onCrash(int signal) {
  crash.signal = signal;
  notePlace();
  recover[size_t(signal)](signal);
}

/// A stack for the handler, which has to run when the thread's own is full.
class HandlerStack {
public:
  HandlerStack() {
    stack_t stack{};
    stack.ss_sp = memory_.get();
    stack.ss_size = size;
    ::sigaltstack(&stack, nullptr);
  }
  ~HandlerStack() {
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    ::sigaltstack(&none, nullptr);
  }

private:
  static constexpr size_t size = 128 * 1024;
  std::unique_ptr<char[]> memory_ = std::make_unique<char[]>(size);
};

llvm::StringRef nameOf(int signal) {
  switch (signal) {
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

std::string described(llvm::StringRef what) {
  const llvm::StringRef place = crash.place;
  return (what + (place.empty() ? "" : " at " + place)).str();
}

} // namespace

void enableCrashGuard() {
  if (sanitized)
    return;
  llvm::CrashRecoveryContext::Enable();
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

std::optional<std::string> runGuarded(llvm::function_ref<void()> work) {
  static thread_local const HandlerStack handlerStack;
  const void *const entries = llvm::SavePrettyStackState();
  crash = {};
  std::optional<std::string> thrown;
  const auto run = [&] {
    try {
      work();
    } catch (const std::exception &exception) {
      thrown = exception.what();
    }
  };
  llvm::CrashRecoveryContext context;
  if (context.RunSafely(run))
    return thrown;
  llvm::RestorePrettyStackState(entries);
  return described(nameOf(crash.signal));
}

void CrashPlace::print(llvm::raw_ostream &out) const {
  // Counted here, because the line index may allocate, and the heap may be what is broken.
  out << file_.display() << ':' << file_.lines().countLineEnds(0, offset_) + 1;
}

} // namespace ncvet
