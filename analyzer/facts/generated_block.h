// Blocks that a dialog of the control wrote: their comments carry what the dialog reads back.
#pragma once

#include "formats/dialect/machine.h"
#include "formats/readers/block.h"

#include <string>
#include <vector>

namespace ncvet {

/// A dialog of the control, as the machine's options list them.
struct Dialog {
  std::string file; ///< name of its page: "Drill1.html"
  std::string part; ///< part cycle that it writes, in capitals; empty: none
};

/// The dialogs that are installed: option `dialogFolder`, option `dialogs`, a list of `PAGE=PART`
/// between blanks, and option `dialogLines`, the names that the dialog of one part sets.
struct Dialogs {
  std::string folder;
  std::vector<Dialog> list;
  std::vector<std::string> lines; ///< names that a dialog sets, in its order; empty: not known

  /// The dialog with this page, whatever its folder and capitals; null when it is not known.
  const Dialog *find(llvm::StringRef path) const;
};

/// True when the dialect's table knows of dialogs at all.
bool hasDialogs(const Dialect &dialect);
Dialogs dialogsOf(const Dialect &dialect, const MachineProfile &machine);

/// The comments of a generated block, sorted out.
struct GeneratedBlock {
  const Comment *notice = nullptr;        ///< "Automatically generated code"
  const Comment *page = nullptr;          ///< `HtmlFile = '…'`
  llvm::StringRef path;                   ///< of the page, between its quotes
  std::vector<const Comment *> codeLines; ///< `LineCode1 = '…'`
  std::vector<const Comment *> own;       ///< all others up to the end of the last code's line
  std::string code;                       ///< texts of the code lines, one blank between words

  bool isGenerated() const { return notice || page || !codeLines.empty(); }
  bool isTechnology() const { return !codeLines.empty(); }
};

/// `block` must outlive the result.
GeneratedBlock readGenerated(const Block &block, llvm::StringRef text);

/// The block's code after its last code line, without comments, one blank between words.
std::string codeAfter(const GeneratedBlock &generated, const Block &block, llvm::StringRef text);

/// Name before the `=` of an assignment, in capitals; empty when the item is none.
std::string assignedName(const Item &item, llvm::StringRef text);

/// Item of the block that gives `name` its value, or null.
const Item *findAssignment(const Block &block, llvm::StringRef name, llvm::StringRef text);

} // namespace ncvet
