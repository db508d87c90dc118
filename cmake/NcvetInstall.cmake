# cmake --install: binary, man page, schemas, shell completion.
include(GNUInstallDirs)
install(TARGETS ncvet RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
