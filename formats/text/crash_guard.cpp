// Crash guard: LLVM's crash recovery, made to tell where the crash was and to survive a full stack.
#include "formats/text/crash_guard.h"

#include "formats/text/system/system.h"

#include "llvm/Support/CrashRecoveryContext.h"
#include "llvm/Support/raw_ostream.h"

#include <cstring>
#include <exception>

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

/// What is known of the last crash of a thread. Nothing in it allocates.
struct Crash {
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

std::string described(llvm::StringRef what) {
  const llvm::StringRef place = crash.place;
  return (what + (place.empty() ? "" : " at " + place)).str();
}

} // namespace

void enableCrashGuard() {
  if (sanitized)
    return;
  llvm::CrashRecoveryContext::Enable();
  system::noteCrashes(notePlace);
}

std::optional<std::string> runGuarded(llvm::function_ref<void()> work) {
  static thread_local const system::CrashStack stack;
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
  return described(system::lastCrash());
}

void CrashPlace::print(llvm::raw_ostream &out) const {
  // Counted here, because the line index may allocate, and the heap may be what is broken.
  out << file_.display() << ':' << file_.lines().countLineEnds(0, offset_) + 1;
}

} // namespace ncvet
