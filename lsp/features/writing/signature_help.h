// Signature help: the parameters of the call, instruction or cycle that is being written.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

struct SignatureParameter {
  uint32_t begin = 0, end = 0; ///< bytes of `Signature::label`
  std::string documentation;
};

struct Signature {
  std::string label;         ///< `CYCLE81(RTP, RFP, SDIS, DP, DPR, DTB)`
  std::string documentation; ///< one line
  std::vector<SignatureParameter> parameters;
  int active = -1; ///< index into `parameters`; -1: none
};

/// What is being written at `offset`: an argument of a call in brackets, of an instruction, of a
/// macro call, or a word of a code that has a format. None elsewhere.
std::optional<Signature> signatureHelp(Snapshot &snapshot, uint32_t offset);

} // namespace ncvet::lsp
