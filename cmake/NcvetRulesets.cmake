# ncvet_rulesets: rulesets/**.json as byte arrays in the binary.
file(GLOB_RECURSE ruleset_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/rulesets/*.json)
set(ruleset_table ${CMAKE_BINARY_DIR}/generated/ruleset_table.cpp)
add_custom_command(
  OUTPUT ${ruleset_table}
  COMMAND ${CMAKE_COMMAND} -DROOT=${CMAKE_SOURCE_DIR}/rulesets -DOUT=${ruleset_table}
          -P ${CMAKE_SOURCE_DIR}/cmake/RulesetTable.cmake
  DEPENDS ${ruleset_files} ${CMAKE_SOURCE_DIR}/cmake/RulesetTable.cmake
  VERBATIM)
add_library(ncvet_rulesets STATIC ${ruleset_table})
target_link_libraries(ncvet_rulesets PUBLIC ncvet_dialect)
target_include_directories(ncvet_rulesets PUBLIC ${CMAKE_SOURCE_DIR})
