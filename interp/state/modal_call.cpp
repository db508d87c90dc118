// Programs that run after every later move: G66, MCALL.
#include "interp/state/modal_call.h"

#include "llvm/ADT/Hashing.h"
#include "llvm/ADT/bit.h"

namespace ncvet {

uint64_t ModalCall::hash() const {
  if (!known)
    return 1;
  return llvm::hash_combine(file, at, program, llvm::bit_cast<uint64_t>(repeat.asNumber().lo),
                            llvm::bit_cast<uint64_t>(repeat.asNumber().hi), arguments.hash(),
                            outer ? outer->hash() : uint64_t(0));
}

ModalCalls unknownModalCall() {
  auto *call = new ModalCall;
  call->known = false;
  return call;
}

bool equal(const ModalCalls &a, const ModalCalls &b) {
  if (a == b)
    return true;
  if (!a || !b || a->known != b->known)
    return false;
  return !a->known ||
         (a->file == b->file && a->at == b->at && a->program == b->program &&
          a->repeat == b->repeat && a->arguments == b->arguments && equal(a->outer, b->outer));
}

ModalCalls join(const ModalCalls &a, const ModalCalls &b) {
  if (equal(a, b))
    return a;
  if (!a || !b || !a->known || !b->known || a->file != b->file || a->at != b->at ||
      a->program != b->program || !equal(a->outer, b->outer))
    return unknownModalCall();
  auto *call = new ModalCall(*a);
  call->users = 0;
  call->repeat = join(a->repeat, b->repeat);
  call->arguments = Variables::join(a->arguments, b->arguments);
  return call;
}

} // namespace ncvet
