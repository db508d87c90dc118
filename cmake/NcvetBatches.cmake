# Compiles the sources of a target in batches: most of a small source's time goes into headers.
#
# A batch is a generated source that includes up to SIZE files of one folder by their paths from the
# top, so that a compiler cache serves clones at other places too. Names in unnamed namespaces must
# therefore be unique within a folder. The presets `debug` and `tidy` compile file by file, which
# keeps includes honest.
#
# Sources that see the header of the machine's state, which most edits of the core touch, are kept
# apart from those that do not: these need not be compiled again.
option(NCVET_BATCHES "Compile several sources at once" OFF)
set(NCVET_CORE_HEADER interp/state/state.h)

# ncvet_sees_core(OUT FILE): whether a file of the project, named from the top, includes the header
# of the state, itself or through others.
function(ncvet_sees_core out name)
  get_property(known GLOBAL PROPERTY ncvet_sees_core_${name})
  if("${known}" STREQUAL "")
    set(known FALSE)
    set_property(GLOBAL PROPERTY ncvet_sees_core_${name} FALSE)
    file(STRINGS ${CMAKE_SOURCE_DIR}/${name} lines REGEX "^#include \"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^#include \"([^\"]*)\".*" "\\1" header "${line}")
      if(header STREQUAL NCVET_CORE_HEADER)
        set(known TRUE)
      elseif(EXISTS ${CMAKE_SOURCE_DIR}/${header})
        ncvet_sees_core(known ${header})
      endif()
      if(known)
        break()
      endif()
    endforeach()
    set_property(GLOBAL PROPERTY ncvet_sees_core_${name} ${known})
  endif()
  set(${out} ${known} PARENT_SCOPE)
endfunction()

# ncvet_batched(OUT NAME SIZE SOURCES...): sets OUT to what is to be compiled.
function(ncvet_batched out name size)
  if(NOT NCVET_BATCHES)
    set(${out} ${ARGN} PARENT_SCOPE)
    return()
  endif()
  set(batches "")
  set(rooms "")
  foreach(source IN LISTS ARGN)
    file(RELATIVE_PATH path ${CMAKE_SOURCE_DIR} ${source})
    cmake_path(GET path PARENT_PATH folder)
    string(REPLACE "/" "_" room ${folder})
    ncvet_sees_core(sees ${path})
    if(NOT sees)
      string(APPEND room _apart)
    endif()
    list(APPEND rooms ${room})
    list(APPEND sources_${room} ${path})
  endforeach()
  list(REMOVE_DUPLICATES rooms)
  foreach(room IN LISTS rooms)
    set(sources ${sources_${room}})
    list(LENGTH sources left)
    # Batches of about the same length.
    math(EXPR parts "(${left} + ${size} - 1) / ${size}")
    foreach(part RANGE 1 ${parts})
      math(EXPR first "${left} * (${part} - 1) / ${parts}")
      math(EXPR length "${left} * ${part} / ${parts} - ${first}")
      list(SUBLIST sources ${first} ${length} members)
      set(text "")
      foreach(path IN LISTS members)
        string(APPEND text "#include \"${path}\"\n")
      endforeach()
      set(batch ${CMAKE_BINARY_DIR}/batches/${name}/${room}_${part}.cpp)
      file(CONFIGURE OUTPUT ${batch} CONTENT "${text}" @ONLY)
      list(APPEND batches ${batch})
    endforeach()
  endforeach()
  set(${out} ${batches} PARENT_SCOPE)
endfunction()
