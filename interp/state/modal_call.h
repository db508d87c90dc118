// Programs that run after every later move: G66, MCALL.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/text/source.h"
#include "interp/value/variables.h"

namespace ncvet {

struct ModalCall;
/// The innermost modal call in force; null: none. States share it.
using ModalCalls = llvm::IntrusiveRefCntPtr<const ModalCall>;

/// A modal call. After a move its program runs, and after the moves of that program the call that
/// was in force before it (NCT 99M, section 20: calls in each other).
struct ModalCall {
  bool known = true; ///< false: some call, or none
  CodeIndex code = noCode;
  FileId file = 0;
  uint32_t at = 0;      ///< the block that made it
  int64_t program = -1; ///< its number; -1: the block's call names it
  Value repeat = Value::of(1);
  Variables arguments; ///< by variable; of a call by name by their place, from 1
  ModalCalls outer;
  mutable unsigned users = 0; ///< states that share it

  void Retain() const { ++users; }
  void Release() const {
    if (--users == 0)
      delete this;
  }
  unsigned depth() const { return outer ? outer->depth() + 1 : 1; }
  uint64_t hash() const;
};

/// Calls in each other that are followed: no control has more levels of macros.
constexpr unsigned maxModalCalls = 4;

/// A call of which nothing is known; it may also be none.
ModalCalls unknownModalCall();
bool equal(const ModalCalls &a, const ModalCalls &b);
ModalCalls join(const ModalCalls &a, const ModalCalls &b);

} // namespace ncvet
