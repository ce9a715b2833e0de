# Run at every build: cmake -DGIT= -DSOURCE= -DVERSION= -DOUTPUT= -P version.cmake
# Writes OUTPUT from version.h.in, and touches it only if something changed.
set(HYSTERON_VERSION ${VERSION})
set(HYSTERON_GIT_COMMIT unknown)
set(HYSTERON_GIT_DIRTY false)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} rev-parse HEAD WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE commit RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed)
    set(HYSTERON_GIT_COMMIT ${commit})
    execute_process(COMMAND ${GIT} status --porcelain --untracked-files=no WORKING_DIRECTORY ${SOURCE}
                    OUTPUT_VARIABLE changes ERROR_QUIET)
    if(changes)
      set(HYSTERON_GIT_DIRTY true)
    endif()
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/version.h.in ${OUTPUT} @ONLY)
