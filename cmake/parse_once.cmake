# A build from nothing mostly parses the same headers and instantiates the same templates of Eigen and the standard
# library over and over.  These two are called when the target has all its sources.

option(HYSTERON_UNITY "Compile sources of one folder together: OFF for work on one of them, and for clang-tidy" ON)

# hysteron_parse_once(TARGET HEADER...): these headers are parsed once for the whole target, with its own flags.  g++
# would search all of them for garbage every few seconds; with more memory it does so less often, with the same result.
function(hysteron_parse_once target)
  target_compile_options(${target} PRIVATE $<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-expand=400>
                                           $<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=1500000>)
  target_precompile_headers(${target} PRIVATE ${ARGN})
endfunction()

# hysteron_compile_together(TARGET FILES [APART FILE...]): up to so many sources of one folder are compiled as one.
# Apart stay those with flags of their own, and those named here: their private names are also a neighbour's.  More at a
# time leave cores idle at the end, and an edit to one compiles them all.
function(hysteron_compile_together target most)
  cmake_parse_arguments(PARSE_ARGV 2 together "" "" APART)
  if(NOT HYSTERON_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(TRANSFORM together_APART PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  foreach(source ${sources})
    get_filename_component(source ${source} ABSOLUTE)
    if(source IN_LIST together_APART)
      continue()
    endif()
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER ${folder} folder)
    math(EXPR batch "0${${folder}} / ${most}")
    math(EXPR ${folder} "0${${folder}} + 1")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${folder}_${batch})
  endforeach()
endfunction()
