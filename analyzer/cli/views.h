// Programs as reports show them whole: their colours and the paths of their tools.
#pragma once

#include "analyzer/setup/session.h"
#include "formats/reports/program_view.h"

namespace ncvet::cli {

/// The colours and the tool path of a file of `sources`; programs that it calls are added to these.
/// Where the file has no setup there is neither.
ProgramView viewOf(Session &session, SourceSet &sources, const SourceFile &file);

/// What the colours are called.
llvm::ArrayRef<llvm::StringLiteral> colourNames();

} // namespace ncvet::cli
