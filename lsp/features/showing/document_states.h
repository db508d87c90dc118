// The machine's states at a block of an open document.
#pragma once

#include "analyzer/check/checker.h"

namespace ncvet {
struct MachineState; // interp/state/state.h
}

namespace ncvet::lsp {

/// States of the machine, with the files in which the paths to them lie. Who only hands them on
/// need not see what a state is made of.
class DocumentStates {
public:
  /// The states at the block that begins at `offset` of the text of the file `path`. `memory` is
  /// what checks of the document have left.
  DocumentStates(Session &session, std::shared_ptr<const SourceSet::Overlay> open,
                 const std::string &path, const SharedText &text, uint32_t offset,
                 const std::atomic<bool> &cancelled, CheckMemory &memory);
  DocumentStates(DocumentStates &&);
  ~DocumentStates();

  const StatesAt &at() const { return *at_; }
  const SourceSet &sources() const { return *sources_; }
  /// The state before the block on the first path; null when none leads there.
  const MachineState *firstBefore() const;

private:
  std::unique_ptr<SourceSet> sources_;
  std::unique_ptr<const StatesAt> at_;
};

} // namespace ncvet::lsp
