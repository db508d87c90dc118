// What the client's configuration says: the section `ncvet` of its settings.
#pragma once

#include "analyzer/setup/session.h"

#include <nlohmann/json.hpp>

namespace ncvet::lsp {

/// Which hints are shown in the text.
struct HintSettings {
  bool units = true;   ///< effective values of ambiguous numbers
  bool values = true;  ///< variables and computed targets, where they are certain
  bool motion = false; ///< modal motion of blocks that only give coordinates
};

struct FormatSettings {
  bool spaces = true;       ///< one blank between words; false: none
  unsigned renumber = 0;    ///< step of new block numbers; 0: they are left as they are
  unsigned firstNumber = 0; ///< 0: as large as the step
};

struct Settings {
  SessionOptions session;
  std::string machineFile; ///< of the session's machine; empty: none is set
  HintSettings hints;
  FormatSettings format;
  bool workspaceDiagnostics = false; ///< all programs of the workspace are checked, open or not
};

/// Reads settings; what has another form than it should, or that there is not, is left at its
/// default and said in `problems`.
Settings readSettings(const nlohmann::json &json, std::vector<std::string> &problems);

/// The names of all settings, within the section: `hints.units`. Ascending.
std::vector<std::string> settingNames();

} // namespace ncvet::lsp
