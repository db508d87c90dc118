# ncvet_rules: every pair rules/<category>/<rule-id>.{cpp,md}; the table of rules, their help and
# their factories are made from the pages, so that adding a rule is adding the pair.
file(GLOB rule_sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/rules/*/*.cpp)
file(GLOB rule_pages CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/rules/*/*.md)
set(rule_table ${CMAKE_BINARY_DIR}/generated/rule_table.cpp)
add_custom_command(
  OUTPUT ${rule_table}
  COMMAND ${CMAKE_COMMAND} -DPAGES_ROOT=${CMAKE_SOURCE_DIR}/rules -DOUT=${rule_table}
          -P ${CMAKE_SOURCE_DIR}/cmake/RuleTable.cmake
  DEPENDS ${rule_pages} ${CMAKE_SOURCE_DIR}/cmake/RuleTable.cmake
  VERBATIM)
ncvet_batched(rule_batches ncvet_rules 30 ${rule_sources})
add_library(ncvet_rules STATIC ${rule_batches} ${rule_table})
target_link_libraries(ncvet_rules PUBLIC ncvet_analyzer)
ncvet_precompiled(ncvet_rules)
ncvet_warnings(ncvet_rules)
