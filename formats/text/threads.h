// Whether the program has threads.
#pragma once

namespace ncvet {

/// False in WebAssembly: pages of other sites, static ones above all, share no memory between
/// threads. What a thread does elsewhere is then done by its caller.
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
inline constexpr bool hasThreads = false;
#else
inline constexpr bool hasThreads = true;
#endif

} // namespace ncvet
