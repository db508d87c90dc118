// How the server deals with the memory that edits of long texts leave free.
#pragma once

namespace ncvet::lsp {

/// Every edit makes a new text: from now on the memory of old ones is used again, instead of being
/// given back and asked for page by page. For the whole process.
void keepFreedMemory();
/// Gives back to the system what is free now. Takes some milliseconds.
void giveBackFreeMemory();

} // namespace ncvet::lsp
