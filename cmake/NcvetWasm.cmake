# The WebAssembly module ncvet.wasm and the script that loads it, for Node and for workers of browsers.
foreach(layer ncvet_analyzer ncvet_check ncvet_rules ncvet_lsp ncvet)
  target_compile_options(${layer} PRIVATE -include ${CMAKE_SOURCE_DIR}/cmake/cross/wasm_library.h)
endforeach()
# A module is fetched before it runs, and the server is a quarter of its code and runs little. em++
# inlines nothing at -Os unless it is told to: twice the code, at several times the time.
target_compile_options(ncvet_lsp PRIVATE -Os -finline-functions)

set(exports _main _malloc _free _ncvet_serves _ncvet_take _ncvet_work _ncvet_exit_code)
list(JOIN exports "," exports)
target_link_options(ncvet PRIVATE
  -O2 # of the script, and of the module as a whole
  -sMODULARIZE=1 -sEXPORT_NAME=createNcvetModule -sENVIRONMENT=node,worker
  -sINVOKE_RUN=0 -sNODEJS_CATCH_EXIT=0 -sNODEJS_CATCH_REJECTION=0
  -sFORCE_FILESYSTEM=1 -sEXPORTED_RUNTIME_METHODS=FS,ENV,callMain -sEXPORTED_FUNCTIONS=${exports}
  # Nested structures of a program are followed by calls: as much stack as a process has elsewhere.
  -sTOTAL_STACK=8MB -sINITIAL_MEMORY=64MB -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB)
# emscripten's optimiser is a script that uses a library of Debian's.
set_target_properties(ncvet PROPERTIES
  RULE_LAUNCH_LINK "${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs")
