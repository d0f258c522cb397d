# Installs the modules and what find_package(graben) needs; included after every target is there.
include(CMakePackageConfigHelpers)

set(_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/graben")
get_property(_modules GLOBAL PROPERTY GRABEN_MODULES)
install(TARGETS ${_modules} EXPORT grabenTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(EXPORT grabenTargets NAMESPACE graben:: DESTINATION ${_package_dir})

# The parts of VTK that the modules link, privately or not: a dependent has to find them too.
set(GRABEN_VTK_COMPONENTS "")
foreach(_module ${_modules})
  get_target_property(_links ${_module} LINK_LIBRARIES)
  foreach(_link ${_links})
    if(_link MATCHES "^VTK::([A-Za-z0-9]+)$")
      list(APPEND GRABEN_VTK_COMPONENTS ${CMAKE_MATCH_1})
    endif()
  endforeach()
endforeach()
list(REMOVE_DUPLICATES GRABEN_VTK_COMPONENTS)
list(JOIN GRABEN_VTK_COMPONENTS " " GRABEN_VTK_COMPONENTS)

configure_package_config_file(
  "${CMAKE_CURRENT_LIST_DIR}/GrabenConfig.cmake.in" "${CMAKE_BINARY_DIR}/grabenConfig.cmake"
  INSTALL_DESTINATION ${_package_dir})
# Before 1.0 a minor version may break its users.
write_basic_package_version_file("${CMAKE_BINARY_DIR}/grabenConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/grabenConfig.cmake" "${CMAKE_BINARY_DIR}/grabenConfigVersion.cmake"
  DESTINATION ${_package_dir})
install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/graben)
