# rulesets/**.json as text tables in the binary; part of the dialect layer, which loads them.
file(GLOB_RECURSE ruleset_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/rulesets/*.json)
set(ruleset_table ${CMAKE_BINARY_DIR}/generated/ruleset_table.cpp)
add_custom_command(
  OUTPUT ${ruleset_table}
  COMMAND ${CMAKE_COMMAND} -DROOT=${CMAKE_SOURCE_DIR}/rulesets -DOUT=${ruleset_table}
          -P ${CMAKE_SOURCE_DIR}/cmake/RulesetTable.cmake
  DEPENDS ${ruleset_files} ${CMAKE_SOURCE_DIR}/cmake/RulesetTable.cmake
  VERBATIM)
target_sources(ncvet_dialect PRIVATE ${ruleset_table})
