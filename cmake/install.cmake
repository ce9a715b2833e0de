# cmake --install: the program with its assets, and what find_package(hysteron) gives to other programs.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(headers ${CMAKE_INSTALL_INCLUDEDIR}/hysteron)  # below it as in this tree: "sim/time/simulation.h"
set_target_properties(hysteron_laws PROPERTIES EXPORT_NAME laws)
install(TARGETS hysteron_laws EXPORT hysteron FILE_SET HEADERS DESTINATION ${headers})
set(HYSTERON_COMPONENTS laws)

if(NOT HYSTERON_ONLY_LAWS)
  install(TARGETS hysteron)
  install(DIRECTORY assets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/hysteron/assets)
  install(DIRECTORY sim render DESTINATION ${headers} FILES_MATCHING PATTERN "*.h" PATTERN "*.def")
  list(APPEND HYSTERON_COMPONENTS sim reference identification render)
  set(libraries base cgal sim reference identification render)
  if(HYSTERON_HAS_CUDA)
    list(APPEND libraries gpu)
  endif()
  set(targets)
  foreach(library ${libraries})
    set_target_properties(hysteron_${library} PROPERTIES EXPORT_NAME ${library})
    list(APPEND targets hysteron_${library})
  endforeach()
  install(TARGETS ${targets} EXPORT hysteron ARCHIVE INCLUDES DESTINATION ${headers})
endif()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/hysteron)
install(EXPORT hysteron NAMESPACE hysteron:: FILE hysteronTargets.cmake DESTINATION ${package})
configure_package_config_file(cmake/hysteronConfig.cmake.in ${PROJECT_BINARY_DIR}/hysteronConfig.cmake
                              INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hysteronConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hysteronConfig.cmake ${PROJECT_BINARY_DIR}/hysteronConfigVersion.cmake
        DESTINATION ${package})
