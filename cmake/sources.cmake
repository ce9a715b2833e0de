# Functions that the libraries and tests of this tree call: for sources that are found by their folders, and for files that
# stand in binaries.

option(HYSTERON_UNITY "Compile sources of one folder together: OFF for work on one of them, and for clang-tidy" ON)

# hysteron_sources(TARGET PATTERN... [ACROSS_FOLDERS] [EXCEPT REGEX]): what the patterns match in this folder.  Up to eight
# sources of one folder are compiled as one, with ACROSS_FOLDERS also of neighbouring ones, where most have one or two
# sources: each unit takes g++ four seconds for the templates that all of them use.  More at a time would leave cores idle
# at the end, and an edit to one compiles them all.  Apart stay those with flags of their own or with
# SKIP_UNITY_BUILD_INCLUSION.
function(hysteron_sources target)
  cmake_parse_arguments(PARSE_ARGV 1 of "ACROSS_FOLDERS" "EXCEPT" "")
  file(GLOB sources CONFIGURE_DEPENDS ${of_UNPARSED_ARGUMENTS})
  if(of_EXCEPT)
    list(FILTER sources EXCLUDE REGEX "${of_EXCEPT}")
  endif()
  hysteron_flags(${target})
  target_sources(${target} PRIVATE ${sources})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${HYSTERON_UNITY} UNITY_BUILD_MODE GROUP)
  foreach(source ${sources})
    get_filename_component(folder ${source} DIRECTORY)
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${folder})
    if(of_ACROSS_FOLDERS)
      set(folder ${target})
    endif()
    string(MAKE_C_IDENTIFIER ${folder} folder)
    math(EXPR batch "0${${folder}} / 8")
    math(EXPR ${folder} "0${${folder}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
  endforeach()
endfunction()

# hysteron_embed(TARGET NAMESPACE HEADER FILE...): the files stand in the binary, as embedded_file() of the header.
function(hysteron_embed target namespace header)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed.cmake)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded.cpp)
  list(JOIN ARGN "|" files)
  add_custom_command(
    OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DFILES=${files} -DNAMESPACE=${namespace} -DHEADER=${header} -P ${script}
    DEPENDS ${ARGN} ${script}
    VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
