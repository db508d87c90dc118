// Programs as reports show them whole: their colours and the paths of their tools.
#include "analyzer/cli/views.h"

#include "analyzer/trace/tool_path_trace.h"
#include "formats/text/crash_guard.h"
#include "lsp/features/showing/semantic_tokens.h"

namespace ncvet::cli {

namespace {

/// Colours for the first part of a text: they take half as much again of a page as the text.
constexpr uint32_t mostColouredText = 4u << 20;
/// Moves of one program: 30 MB of a page, and what a browser still draws.
constexpr size_t mostMoves = 1'500'000;

std::vector<TextColour> coloursOf(Session &session, const SourceFile &file,
                                  const std::string &name) {
  auto snapshot = lsp::Snapshot::make(
      session, nullptr, name, SharedText(std::make_shared<const std::string>(file.text().str())));
  if (!snapshot) {
    llvm::consumeError(snapshot.takeError()); // the check reports it
    return {};
  }
  std::vector<TextColour> colours;
  const uint32_t end = std::min(uint32_t(file.text().size()), mostColouredText);
  for (const lsp::SemanticToken &token : lsp::semanticTokens(**snapshot, 0, end))
    colours.push_back({token.begin, token.end, uint8_t(token.type),
                       (token.modifiers & lsp::tokenDefinition) != 0});
  return colours;
}

} // namespace

ProgramView viewOf(Session &session, SourceSet &sources, const SourceFile &file) {
  const std::string &name = file.path().empty() ? file.display() : file.path();
  auto view = std::make_unique<ProgramView>();
  view->file = file.id();
  auto setup = session.setup(name, file.text());
  if (!setup) {
    llvm::consumeError(setup.takeError()); // the check reports it
    return *view;
  }
  const auto crash = runGuarded([&] {
    view->colours = coloursOf(session, file, name);
    Project project(sources, setup->dialect, *setup->machine, setup->config->searchFolders,
                    setup->folders);
    view->path = traceToolPath(project, project.unit(file), setup->limits, mostMoves);
  });
  if (!crash)
    return std::move(*view);
  static_cast<void>(view.release()); // whatever it holds is not to be trusted
  ProgramView empty;
  empty.file = file.id();
  return empty;
}

llvm::ArrayRef<llvm::StringLiteral> colourNames() { return lsp::tokenTypeNames(); }

} // namespace ncvet::cli
