# cmake --install: binary, man page, schemas, example machines, shell completion, licence.
include(GNUInstallDirs)
install(TARGETS ncvet RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES analyzer/cli/ncvet.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(DIRECTORY rulesets/schema rulesets/machines
        DESTINATION ${CMAKE_INSTALL_DATADIR}/ncvet FILES_MATCHING PATTERN "*.json")
install(FILES analyzer/cli/completion/ncvet.bash RENAME ncvet
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES analyzer/cli/completion/_ncvet
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
install(FILES analyzer/cli/completion/ncvet.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
