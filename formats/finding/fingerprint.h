// Fingerprints: names for findings that stay the same when a program is renumbered or grows.
#pragma once

#include "formats/text/source.h"

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/DenseMap.h"

#include <string>

namespace ncvet {

/// The text of `block` as far as it tells the machine something: without the parts in `leftOut`
/// (the block number and the comments, in order of their begin) and without blanks, in upper case;
/// of a text of more than 1024 bytes the rest is given by its hash.
std::string fingerprintText(const SourceFile &file, SourceRange block,
                            llvm::ArrayRef<SourceRange> leftOut);

/// Gives the findings of one file their fingerprints; ask in the order of the findings.
/// A fingerprint is a hash of the rule's id, the enclosing program's name, the block's text and
/// the number of equal findings before: it survives renumbering, respacing and new blocks, and
/// it is the same on every machine.
class Fingerprints {
public:
  uint64_t next(llvm::StringRef ruleId, llvm::StringRef program, llvm::StringRef blockText);

private:
  llvm::DenseMap<uint64_t, uint32_t> seen_;
};

/// 16 hexadecimal digits, as reports and baselines write a fingerprint.
std::string fingerprintString(uint64_t fingerprint);

} // namespace ncvet
