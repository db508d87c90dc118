// The machine's states at a block of an open document.
#include "lsp/features/showing/document_states.h"

#include "analyzer/flow/states_at_block.h"

namespace ncvet::lsp {

DocumentStates::DocumentStates(Session &session, std::shared_ptr<const SourceSet::Overlay> open,
                               const std::string &path, const SharedText &text, uint32_t offset,
                               const std::atomic<bool> &cancelled, CheckMemory &memory)
    : sources_(std::make_unique<SourceSet>(std::move(open))) {
  const SourceFile &file = sources_->add(path, text, path);
  Recheck again{text, memory};
  at_ = std::make_unique<const StatesAt>(
      statesInCheck(session, *sources_, file, offset, &cancelled, again));
}

DocumentStates::DocumentStates(DocumentStates &&) = default;
DocumentStates::~DocumentStates() = default;

const MachineState *DocumentStates::firstBefore() const {
  return at_->ways.empty() ? nullptr : &at_->ways.front().before;
}

} // namespace ncvet::lsp
