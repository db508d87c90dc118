# Language level, warnings, build types and the compiler cache.
include(CTest)

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

find_program(NCVET_CCACHE ccache)
if(NCVET_CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${NCVET_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_SOURCE_DIR}/cmake/cached.sh)
endif()

include(NcvetBatches)
include(NcvetProfile)

option(NCVET_SANITIZE "Build with address and undefined-behaviour sanitizer" OFF)
option(NCVET_FUZZ "Build the libFuzzer targets (clang only)" OFF)

if(NCVET_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(NCVET_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# g++ collects garbage whenever its memory has doubled: a twelfth of the time. A batch needs 0.9 GB without.
add_compile_options("$<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=1000000>")

function(ncvet_warnings target)
  # In a batch a local name may hide one of another file, which only g++ can leave out. Without
  # batches the same: what one preset takes all of them take.
  set(shadow $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion ${shadow} -Werror)
  if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    # clang counts changes of sign among the conversions, g++ does not: indexes of Eigen have one.
    target_compile_options(${target} PRIVATE -Wno-sign-conversion)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # g++ 12 warns of its own string concatenation (GCC bug 105329), and of LLVM's formatting of
    # whole numbers, which does not use the variable in question.
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-maybe-uninitialized
                           -Wno-stringop-overflow -Wno-array-bounds)
  endif()
endfunction()
