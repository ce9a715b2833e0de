# Flags and folders of headers of this tree's own sources.  Who links a library of it has none of them but what the library
# states as PUBLIC.

set(HYSTERON_ARCH native CACHE STRING "-march of the CPU code (native, x86-64-v3, ...; empty: compiler's default)")
set(HYSTERON_SANITIZE OFF CACHE STRING "Checked build: ON (address and undefined behaviour), thread (data races), OFF")
set_property(CACHE HYSTERON_SANITIZE PROPERTY STRINGS OFF ON thread)

add_library(hysteron_flags INTERFACE)
target_include_directories(hysteron_flags INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
# The sums' order is part of the contract: no contraction, no reassociation.  errno and traps are not used, and
# without them square roots and conditionals vectorise.
set(flags -Wall -Wextra -Werror=switch -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND flags -Wno-restrict)  # false alarms of g++ 12 on std::string
  # g++ would search its memory for garbage every few seconds, an eighth of its time.  With more memory it does so less
  # often, with the same result.
  list(APPEND flags --param=ggc-min-expand=400 --param=ggc-min-heapsize=1500000)
  if(CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False alarms on its own headers of vector instructions, tens of thousands of lines where there is AVX-512.
    list(APPEND flags -Wno-maybe-uninitialized -Wno-uninitialized)
  endif()
endif()
if(HYSTERON_ARCH)
  list(APPEND flags -march=${HYSTERON_ARCH})
endif()
if(HYSTERON_SANITIZE STREQUAL "thread")
  set(sanitizers thread)
elseif(HYSTERON_SANITIZE)
  set(sanitizers address,undefined)
endif()
if(HYSTERON_SANITIZE)
  # Lines for what a sanitizer says; with more g++ takes three times as long.
  list(APPEND flags -fsanitize=${sanitizers} -fno-omit-frame-pointer -g1 -O1)
  target_link_options(hysteron_flags INTERFACE -fsanitize=${sanitizers})
endif()
target_compile_options(hysteron_flags INTERFACE "$<$<COMPILE_LANGUAGE:CXX>:${flags}>")

# hysteron_flags(TARGET...): compiled with them.  hysteron_sources calls it.
function(hysteron_flags)
  foreach(target ${ARGN})
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:hysteron_flags>)
  endforeach()
endfunction()

# hysteron_optimise(TARGET LEVEL): a level of its own.  Checked builds keep theirs, which compile long enough, and builds
# for a debugger.
function(hysteron_optimise target level)
  if(NOT HYSTERON_SANITIZE)
    target_compile_options(${target} PRIVATE $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<NOT:$<CONFIG:Debug>>>:${level}>)
  endif()
endfunction()
