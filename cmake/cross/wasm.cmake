# WebAssembly, from Debian's emscripten. Exceptions are those of the machine itself (Node since 17,
# browsers since 2022): they cost nothing until one is thrown, which the command line needs.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
# Its own tools need a library that Debian keeps aside from a Node of another source.
set(ENV{NODE_PATH} /usr/share/nodejs)
set(CMAKE_C_FLAGS_INIT "-sSUPPORT_LONGJMP=wasm")
set(CMAKE_CXX_FLAGS_INIT "-fwasm-exceptions -sSUPPORT_LONGJMP=wasm")
# Everything is found in the folder that libraries.sh makes.
set(CMAKE_FIND_ROOT_PATH ${CMAKE_FIND_ROOT_PATH} ${CMAKE_PREFIX_PATH})
