// A state that goes from place to place without being copied.
#pragma once

#include "interp/state/state.h"

#include <memory>
#include <utility>

namespace ncvet {

/// Owns a state of some kilobytes: who moves it moves a pointer. What was moved from holds none.
class HeldState {
public:
  HeldState() : HeldState(MachineState()) {}
  HeldState(const MachineState &state) : held_(std::make_unique<Held>(state, next())) {}
  HeldState(const HeldState &other) : HeldState(*other) {}
  HeldState(HeldState &&) = default;
  HeldState &operator=(const HeldState &other) { return *this = *other; }
  HeldState &operator=(HeldState &&) = default;
  HeldState &operator=(const MachineState &state) {
    if (held_) {
      static_cast<MachineState &>(*held_) = state;
      held_->serial = next();
    } else {
      held_ = std::make_unique<Held>(state, next());
    }
    return *this;
  }
  ~HeldState() = default;

  MachineState &operator*() { return *held_; }
  const MachineState &operator*() const { return *held_; }
  MachineState *operator->() { return held_.get(); }
  const MachineState *operator->() const { return held_.get(); }
  operator MachineState &() { return *held_; }
  operator const MachineState &() const { return *held_; }

  /// False: it was moved from.
  bool isHeld() const { return bool(held_); }
  /// Another one for each state that is held, and whenever another takes its place.
  uint64_t serial() const { return held_->serial; }

private:
  struct Held : MachineState {
    Held(const MachineState &state, uint64_t number) : MachineState(state), serial(number) {}
    uint64_t serial;
  };
  static uint64_t next() {
    static thread_local uint64_t last = 0;
    return ++last;
  }

  std::unique_ptr<Held> held_;
};

} // namespace ncvet
