# Packages: a .deb by cpack, and a program without shared libraries for the archive that runs on any
# Linux. `./dev package` makes both.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON) # the tests are in no package

# The same objects, linked with all libraries inside. LLVM's configuration names shared libraries by
# their paths (and a solver that is not used), so the archives are listed here; lower layers come last.
find_library(NCVET_STATIC_Z NAMES libz.a)
find_library(NCVET_STATIC_TINFO NAMES libtinfo.a)
set(layers ncvet_lsp ncvet_rules ncvet_check ncvet_analyzer ncvet_reports ncvet_interp ncvet_readers
           ncvet_packed ncvet_dialect ncvet_finding ncvet_text)
add_executable(ncvet_static EXCLUDE_FROM_ALL $<TARGET_OBJECTS:ncvet>)
foreach(layer IN LISTS layers)
  target_link_libraries(ncvet_static PRIVATE $<TARGET_FILE:${layer}>)
endforeach()
add_dependencies(ncvet_static ncvet ${layers})
target_link_libraries(ncvet_static PRIVATE $<TARGET_FILE:LLVMSupport> $<TARGET_FILE:LLVMDemangle>
                      ${NCVET_RE2} ${NCVET_STATIC_Z} ${NCVET_STATIC_TINFO})
# The linker warns of lookups of users by name, which a home folder that HOME names does not need. It is
# not told to be silent: then it says nothing of a layer that is missing above either.
target_link_options(ncvet_static PRIVATE -static)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR ncvet)
set(CPACK_PACKAGE_CONTACT "ncvet maintainers <maintainers@ncvet.example>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "linter for part programs of CNC machines")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"It follows a part program as the control would: modal codes, calls, jumps,
loops, block skip, canned cycles and compensation. Then it reports what the
control will refuse and what was probably not meant, as text, for an editor
by the Language Server Protocol, and for continuous integration as SARIF.")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/DebianTree.cmake)
set(CPACK_VERBATIM_VARIABLES ON)
include(CPack)
