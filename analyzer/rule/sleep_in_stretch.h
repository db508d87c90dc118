// How a rule that is told of every move says that the next ones do not interest it.
#pragma once

namespace ncvet {

/// Of the rule that is being told, on this thread; the dispatcher looks at it after each call.
inline constinit thread_local bool ruleSleeps = false;

/// The rule has nothing to say of the following moves either, as long as each only goes on as the
/// one before: in the same modes, with the same facts known, with the same words. Only such things
/// may decide it, no number of the block.
inline void sleepInStretch() { ruleSleeps = true; }

} // namespace ncvet
